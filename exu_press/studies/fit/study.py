"""The study file of a fit."""

import dataclasses
import os
from collections.abc import Mapping
from pathlib import Path
from types import MappingProxyType
from typing import Any

from exu_press.errors import InputError
from exu_press.quantities import quantity_of
from exu_press.schema.checks import Table, demand_known, key
from exu_press.studies.base import Range, Study
from exu_press.studies.base.evaluation import ranged
from exu_press.studies.fit.curve import Curve
from exu_press.studies.fit.measured import Measured, under_of

__all__ = ["EVOLUTION", "LEAST_SQUARES", "Fit", "Search"]

LEAST_SQUARES, EVOLUTION = "least_squares", "differential_evolution"


@dataclasses.dataclass(frozen=True)
class Search(Table):
    """The table [fit]."""

    table = "fit"

    method: str = key(
        LEAST_SQUARES,
        "of the search; differential evolution for numbers that are rough",
        choices=(LEAST_SQUARES, EVOLUTION),
    )
    starts: int = key(3, "of the least squares", at_least=1)
    generations: int = key(30, "of the differential evolution, at most", at_least=1)
    level: float = key(0.95, "of the intervals", above=0.5, at_most=0.999)
    seed: int = key(0, "of the starts", at_least=0)


@dataclasses.dataclass(frozen=True)
class Fit(Study):
    """A fit's file, complete.

    Attributes:
        measured: numbers.
        curve: curves.
        start: key -> value where one search begins; the middle of the ranges unless given.
        fit: how it is searched.

    Raises:
        InputError: not allowed, no measurement, or more keys than numbers.
    """

    tables = MappingProxyType({"fit": Search, "measured": Measured, "curve": Curve})

    measured: tuple[Measured, ...] = ()
    curve: tuple[Curve, ...] = ()
    start: Mapping[str, float] = dataclasses.field(default_factory=dict)
    fit: Search = Search()

    def __post_init__(self) -> None:
        super().__post_init__()
        names = ranged(self, "fit")
        unders = [*(m.under for m in self.measured), *(c.under for c in self.curve)]
        for under in unders:
            if both := set(under) & set(names):
                raise InputError(f"under {both.pop()}: is fitted; allowed are other keys")
        for one in self.measured:
            quantity_of(self.scene_at(one.under), one.quantity)
        if not self.measured and not self.curve:
            raise InputError("no measurement; allowed are [[measured]] and [[curve]]")
        numbers = len(self.measured) + sum(one.count - one.nuisances for one in self.curve)
        if numbers < len(names):
            raise InputError(
                f"more keys ({len(names)}) than measured numbers ({numbers:g}): allowed are as "
                "many numbers as keys at least; the cure is to leave out keys that are known"
            )
        self._check_start()

    @classmethod
    def located(cls, data: dict[str, Any], directory: Path) -> dict[str, Any]:
        """Return a file's tables with paths of curves counted from its directory."""
        curves = data.get("curve", [])
        if isinstance(curves, list):
            data["curve"] = [
                {**one, "file": os.path.join(directory, one["file"])}  # noqa: PTH118
                if isinstance(one, Mapping) and isinstance(one.get("file"), str)
                else one
                for one in curves
            ]
        return data

    def _check_start(self) -> None:
        given = {}
        for name, value in under_of("start", self.start).items():
            demand_known(f"start.{name}: does not vary", name, self.keys)
            each = self.keys[name]
            assert isinstance(each, Range)
            if not isinstance(value, int | float) or not each.low <= value <= each.high:
                raise InputError(
                    f"start.{name} = {value!r}: allowed is {each.low:g} to {each.high:g}"
                )
            given[name] = float(value)
        object.__setattr__(self, "start", given)

    def to_dict(self) -> dict[str, Any]:
        """Return the data that tell this fit from others; a curve's samples are among them."""
        curves = []
        for one in self.curve:
            table = {f.name: getattr(one, f.name) for f in dataclasses.fields(one)}
            read = table.pop("measured")
            if read is not None:
                table["samples"] = [read.at.tolist(), read.values.tolist(), read.unit]
            curves.append(table)
        return {**super().to_dict(), "curve": curves}
