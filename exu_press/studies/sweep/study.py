"""A sweep: every combination of keys' values, lists side by side, or a Latin hypercube."""

import dataclasses
import itertools
import math
from collections.abc import Iterable, Mapping, Sequence
from functools import cached_property
from types import MappingProxyType
from typing import Any

import numpy as np

from exu_press.errors import InputError
from exu_press.scene import Scene
from exu_press.schema.checks import key
from exu_press.schema.table import Table
from exu_press.studies.base import Study
from exu_press.studies.base.keys import Key, Values

__all__ = ["Sweep", "SweepTable", "points_of"]

Points = tuple[dict[str, Any], ...]

MOST_RUNS = 100_000
"""Runs of one study."""


GRID, LIST, SAMPLE = "grid", "list", "sample"


@dataclasses.dataclass(frozen=True)
class SweepTable(Table):
    """The table [sweep]."""

    table = "sweep"

    way: str = key(GRID, "how the keys' values go together", choices=(GRID, LIST, SAMPLE))
    n: int | None = key(None, "runs of a sample", at_least=1)
    seed: int | None = key(None, "of a sample's random numbers", at_least=0)

    def __post_init__(self) -> None:
        super().__post_init__()
        for name in ("n", "seed"):
            if (getattr(self, name) is None) == (self.way == SAMPLE):
                need = "is needed" if self.way == SAMPLE else "is not used"
                raise InputError(
                    f'sweep.{name}: {need} with way = "{self.way}"; allowed are way = "{SAMPLE}" '
                    f'with n and seed, "{GRID}" and "{LIST}" without'
                )


def points_of(keys: Mapping[str, Key], table: SweepTable) -> Points:
    """Return the keys' values in each run.

    A grid has every combination, in which the last key runs fastest; a list the first values of all
    keys, the second ones, and so on; a sample is a Latin hypercube of the keys' distributions, the
    same for one seed.

    Source: McKay, Beckman, Conover, Technometrics 21 (1979) 239-245; made by SciPy.

    >>> keys = {"speed_rpm": Values((200, 300)), "crank_pin": Values(("dry",))}
    >>> points_of(keys, SweepTable())
    ({'speed_rpm': 200, 'crank_pin': 'dry'}, {'speed_rpm': 300, 'crank_pin': 'dry'})

    Raises:
        InputError: a key varies otherwise than its way takes, lists differ in length, or there are
            more than MOST_RUNS runs.
    """
    is_sample = table.way == SAMPLE
    forms = 'a list of values; [sweep] way = "sample" takes ranges and distributions'
    if is_sample:
        forms = "{low = a, high = b} or {mean = m, deviation = s}"
    for name, variation in keys.items():
        if isinstance(variation, Values) is is_sample:
            raise InputError(
                f'keys.{name} = {variation.plain()!r:.200}: allowed with way = "{table.way}" is '
                f"{forms}"
            )
    values = [variation.values for variation in keys.values() if isinstance(variation, Values)]
    lengths = list(map(len, values))
    if table.way == LIST and len(set(lengths)) > 1:
        text = ", ".join(f"{n} has {length}" for n, length in zip(keys, lengths, strict=True))
        raise InputError(f'[keys]: {text}; allowed with way = "list" are lists of one length')
    number = table.n or (math.prod(lengths) if table.way == GRID else lengths[0])
    if number > MOST_RUNS:
        raise InputError(f"{number} runs; allowed are at most {MOST_RUNS}")
    combinations: Iterable[Sequence[Any]] = zip(*values, strict=True)
    if table.way == GRID:
        combinations = itertools.product(*values)
    elif is_sample:
        from scipy.stats import qmc

        shares = np.asarray(qmc.LatinHypercube(len(keys), rng=table.seed).random(number))
        columns = [
            variation.quantile(column)
            for variation, column in zip(keys.values(), shares.T, strict=True)
            if not isinstance(variation, Values)
        ]
        combinations = np.column_stack(columns).tolist()
    return tuple(dict(zip(keys, point, strict=True)) for point in combinations)


@dataclasses.dataclass(frozen=True)
class Sweep(Study):
    """A sweep's file, complete: every scene of it has been validated.

    Attributes:
        sweep: how the keys' values go together; every combination by default.
    """

    tables = MappingProxyType({"sweep": SweepTable})

    sweep: SweepTable = SweepTable()

    def check_keys(self) -> None:
        """Check every scene, before anything runs."""
        self.scenes  # noqa: B018

    @property
    def way(self) -> str:
        """Return one of grid, list and sample."""
        return self.sweep.way

    @cached_property
    def points(self) -> Points:
        """Varied keys and their values, one mapping a run, in the study's order."""
        return points_of(self.keys, self.sweep)

    @cached_property
    def scenes(self) -> tuple[Scene, ...]:
        """The scenes of the runs."""
        return tuple(map(self.scene_at, self.points))

    def to_dict(self) -> dict[str, Any]:
        """Return the data that tell this sweep from others."""
        settings = {name: v for name, v in dataclasses.asdict(self.sweep).items() if v is not None}
        return {**super().to_dict(), "sweep": settings}
