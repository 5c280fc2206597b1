"""A sweep: every combination of keys' values, lists side by side, or a Latin hypercube."""

import dataclasses
import itertools
import math
from collections.abc import Mapping
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

__all__ = ["Sweep", "SweepTable", "grid", "paired_values", "sample"]

Points = tuple[dict[str, Any], ...]

MOST_RUNS = 100_000
"""Runs of one study."""


def grid(keys: Mapping[str, Key]) -> Points:
    """Return every combination; the last key runs fastest.

    >>> grid({"speed_rpm": Values((200, 300)), "crank_pin": Values(("dry",))})
    ({'speed_rpm': 200, 'crank_pin': 'dry'}, {'speed_rpm': 300, 'crank_pin': 'dry'})
    """
    values = _values(keys, "grid")
    _check_number(math.prod(len(key_values) for key_values in values.values()))
    return _points(values, itertools.product(*values.values()))


def paired_values(keys: Mapping[str, Key]) -> Points:
    """Return the first values of all keys, the second ones, and so on.

    >>> paired_values({"speed_rpm": Values((200, 300)), "crank_pin": Values(("dry", "ideal"))})
    ({'speed_rpm': 200, 'crank_pin': 'dry'}, {'speed_rpm': 300, 'crank_pin': 'ideal'})
    """
    values = _values(keys, "list")
    lengths = {name: len(key_values) for name, key_values in values.items()}
    if len(set(lengths.values())) > 1:
        text = ", ".join(f"{name} has {length}" for name, length in lengths.items())
        raise InputError(f'[keys]: {text}; allowed with way = "list" are lists of one length')
    _check_number(next(iter(lengths.values())))
    return _points(values, zip(*values.values(), strict=True))


def sample(keys: Mapping[str, Key], n: int, seed: int) -> Points:
    """Return a Latin hypercube of the keys' distributions, of n points, the same for one seed.

    Source: McKay, Beckman, Conover, Technometrics 21 (1979) 239-245; made by SciPy.
    """
    for name, variation in keys.items():
        if isinstance(variation, Values):
            raise InputError(
                f'keys.{name} = {variation.plain()!r:.200}: allowed with way = "sample" is '
                "{low = a, high = b} or {mean = m, deviation = s}"
            )
    _check_number(n)
    from scipy.stats import qmc

    shares = np.asarray(qmc.LatinHypercube(len(keys), rng=seed).random(n))
    columns = [
        variation.quantile(column)
        for variation, column in zip(keys.values(), shares.T, strict=True)
        if not isinstance(variation, Values)
    ]
    return tuple(
        dict(zip(keys, map(float, row), strict=True)) for row in zip(*columns, strict=True)
    )


def _values(keys: Mapping[str, Key], combination: str) -> dict[str, tuple[Any, ...]]:
    """Return the values of all keys; raise InputError for a range or a distribution."""
    values = {}
    for name, variation in keys.items():
        if not isinstance(variation, Values):
            raise InputError(
                f'keys.{name} = {variation.plain()}: allowed with way = "{combination}" is a list '
                'of values; [sweep] way = "sample" takes ranges and distributions'
            )
        values[name] = variation.values
    return values


def _points(values: Mapping[str, Any], combinations: Any) -> Points:
    return tuple(dict(zip(values, point, strict=True)) for point in combinations)


def _check_number(number: int) -> None:
    if number > MOST_RUNS:
        raise InputError(f"{number} runs; allowed are at most {MOST_RUNS}")


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
        if self.way == SAMPLE:
            assert self.sweep.n is not None
            assert self.sweep.seed is not None
            return sample(self.keys, self.sweep.n, self.sweep.seed)
        return (grid if self.way == GRID else paired_values)(self.keys)

    @cached_property
    def scenes(self) -> tuple[Scene, ...]:
        """The scenes of the runs."""
        return tuple(map(self.scene_at, self.points))

    def to_dict(self) -> dict[str, Any]:
        """Return the data that tell this sweep from others."""
        settings = {name: v for name, v in dataclasses.asdict(self.sweep).items() if v is not None}
        return {**super().to_dict(), "sweep": settings}
