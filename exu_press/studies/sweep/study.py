"""A sweep: every combination of keys' values, lists side by side, or a Latin hypercube."""

import dataclasses
from functools import cached_property
from types import MappingProxyType
from typing import Any

from exu_press.errors import InputError
from exu_press.scene import Scene
from exu_press.schema.checks import Table, key
from exu_press.studies.base import Study
from exu_press.studies.sweep.points import Points, grid, listed, sample

__all__ = ["Sweep", "Way"]

GRID, LIST, SAMPLE = "grid", "list", "sample"


@dataclasses.dataclass(frozen=True)
class Way(Table):
    """The table [sweep].

    Raises:
        InputError: not allowed, or n or seed without a sample.
    """

    table = "sweep"

    way: str = key(GRID, "how the keys' values go together", choices=(GRID, LIST, SAMPLE))
    n: int | None = key(None, "runs of a sample", at_least=1)
    seed: int | None = key(None, "of a sample's random numbers", at_least=0)

    def __post_init__(self) -> None:
        """Check that n and seed are given where they are used, and there alone."""
        super().__post_init__()
        for name in ("n", "seed"):
            if (getattr(self, name) is None) == (self.way == SAMPLE):
                told = "is needed" if self.way == SAMPLE else "is not used"
                raise InputError(
                    f'sweep.{name}: {told} with way = "{self.way}"; allowed are way = "{SAMPLE}" '
                    f'with n and seed, "{GRID}" and "{LIST}" without'
                )


@dataclasses.dataclass(frozen=True)
class Sweep(Study):
    """A sweep's file, complete: every scene of it has been validated.

    Attributes:
        sweep: how the keys' values go together; every combination unless told.
    """

    tables = MappingProxyType({"sweep": Way})

    sweep: Way = Way()

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
        return (grid if self.way == GRID else listed)(self.keys)

    @cached_property
    def scenes(self) -> tuple[Scene, ...]:
        """The scenes of the runs."""
        return tuple(map(self.scene_at, self.points))

    def to_dict(self) -> dict[str, Any]:
        """Return the data that tell this sweep from others."""
        given = {name: v for name, v in dataclasses.asdict(self.sweep).items() if v is not None}
        return {**super().to_dict(), "sweep": given}
