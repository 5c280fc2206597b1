"""The study file of a fit."""

import dataclasses
import os
from collections.abc import Mapping
from pathlib import Path
from types import MappingProxyType
from typing import Any

from exu_press.errors import InputError
from exu_press.quantities import quantity_of
from exu_press.schema.checks import demand_known, key
from exu_press.schema.table import Table
from exu_press.studies.base import Range, Study
from exu_press.studies.base.evaluation import require_key_kinds
from exu_press.studies.fit.measured import Curve, MeasuredNumber, dotted_keys

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
        start: key -> value where one search begins; by default the middle of the ranges.

    Raises:
        InputError: not allowed, no measurement, or more keys than numbers.
    """

    tables = MappingProxyType({"fit": Search, "measured": MeasuredNumber, "curve": Curve})

    measured: tuple[MeasuredNumber, ...] = ()
    curve: tuple[Curve, ...] = ()
    start: Mapping[str, float] = dataclasses.field(default_factory=dict)
    fit: Search = Search()

    def __post_init__(self) -> None:
        super().__post_init__()
        names = require_key_kinds(self, "fit")
        unders = [*(m.under for m in self.measured), *(c.under for c in self.curve)]
        for under in unders:
            if both := set(under) & set(names):
                raise InputError(f"under {both.pop()}: is fitted; allowed are other keys")
        for entry in self.measured:
            quantity_of(self.scene_at(entry.under), entry.quantity)
        if not self.measured and not self.curve:
            raise InputError("no measurement; allowed are [[measured]] and [[curve]]")
        numbers = len(self.measured) + sum(curve.count - curve.nuisances for curve in self.curve)
        if numbers < len(names):
            raise InputError(
                f"more keys ({len(names)}) than measured numbers ({numbers:g}): allowed are as "
                "many numbers as keys at least; the cure is to leave out keys that are known"
            )
        self._check_start()

    @classmethod
    def locate_files(cls, data: dict[str, Any], directory: Path) -> dict[str, Any]:
        """Return a file's tables with paths of curves relative to its directory."""
        curves = data.get("curve", [])
        if isinstance(curves, list):
            data["curve"] = [
                {**curve, "file": os.path.join(directory, curve["file"])}  # noqa: PTH118
                if isinstance(curve, Mapping) and isinstance(curve.get("file"), str)
                else curve
                for curve in curves
            ]
        return data

    def _check_start(self) -> None:
        start = {}
        for name, value in dotted_keys("start", self.start).items():
            demand_known(f"start.{name}: does not vary", name, self.keys)
            varied = self.keys[name]
            assert isinstance(varied, Range)
            if not isinstance(value, int | float) or not varied.low <= value <= varied.high:
                raise InputError(
                    f"start.{name} = {value!r}: allowed is {varied.low:g} to {varied.high:g}"
                )
            start[name] = float(value)
        object.__setattr__(self, "start", start)

    def to_dict(self) -> dict[str, Any]:
        """Return the data that identify this fit; a curve's samples are among them."""
        curves = []
        for curve in self.curve:
            table = {f.name: getattr(curve, f.name) for f in dataclasses.fields(curve)}
            read = table.pop("measured")
            if read is not None:
                table["samples"] = [read.at.tolist(), read.values.tolist(), read.unit]
            curves.append(table)
        return {**super().to_dict(), "curve": curves}
