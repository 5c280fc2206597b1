"""What a sweep is to do: one scene, and which of its keys vary how."""

import dataclasses
from collections.abc import Mapping
from functools import cached_property
from pathlib import Path
from typing import Any

from exu_press.checks import Table, key, table_from
from exu_press.errors import InputError
from exu_press.scene import Scene, load_scene
from exu_press.studies.sweep.points import Points, flat, grid, listed, sample
from exu_press.toml import read_toml

__all__ = ["Study", "load_study"]

WAYS = {"grid": grid, "list": listed, "sample": sample}


@dataclasses.dataclass(frozen=True)
class Study(Table):
    """A study file, complete: every scene of it has been validated.

    Attributes:
        scene: what is common to all runs; a Scene or its mapping.
        save_runs: whether every run keeps its run.nc.
        errors: whether every figure has its error, by companion runs: twice the work.
        time_limit: of one run, s.
        grid: key -> values, every combination.
        list: key -> values, side by side.
        sample: key -> [low, high], with n and seed: a Latin hypercube. One of the three is given.

    Raises:
        InputError: not allowed, or not allowed in the scene of one of the runs.
    """

    scene: Scene
    save_runs: bool = key(False, "keep a run.nc for every run")
    errors: bool = key(False, "find the error of every figure")
    time_limit: float | None = key(None, "for one run", "s", above=0)
    grid: Mapping[str, Any] | None = None
    list: Mapping[str, Any] | None = None
    sample: Mapping[str, Any] | None = None

    def __post_init__(self) -> None:
        """Check the keys, and every scene."""
        super().__post_init__()
        given = [way for way in WAYS if getattr(self, way) is not None]
        if len(given) != 1:
            told = " and ".join(f"[{way}]" for way in given) or "none"
            raise InputError(f"{told} given; allowed is one of [grid], [list], [sample]")
        table = getattr(self, given[0])
        for name, value in (("scene", self.scene), (given[0], table)):
            if not isinstance(value, (Mapping, Scene)):
                raise InputError(f"{name} = {value!r}: allowed is a table")
        if not isinstance(self.scene, Scene):
            object.__setattr__(self, "scene", Scene.from_dict(self.scene))
        object.__setattr__(self, given[0], flat(table))
        self.scenes  # noqa: B018  every one is checked now, before anything runs

    @property
    def way(self) -> str:
        """Which of grid, list and sample is given."""
        return next(way for way in WAYS if getattr(self, way) is not None)

    @cached_property
    def points(self) -> Points:
        """What varies, key -> value, one a run, in the study's order."""
        return WAYS[self.way](getattr(self, self.way))

    @cached_property
    def scenes(self) -> tuple[Scene, ...]:
        """The scenes of the runs."""
        return tuple(map(self._scene, self.points))

    @property
    def keys(self) -> tuple[str, ...]:
        """What varies."""
        return tuple(self.points[0])

    def to_dict(self) -> dict[str, Any]:
        """Return what makes this study another one than others; a time limit does not."""
        return {
            "scene": self.scene.to_dict(),
            "save_runs": self.save_runs,
            "errors": self.errors,
            self.way: dict(getattr(self, self.way)),
        }

    def _scene(self, point: Mapping[str, Any]) -> Scene:
        try:
            return self.scene.replace(dict(point))
        except InputError as error:
            where = ", ".join(f"{name} = {value!r}" for name, value in point.items())
            raise InputError(f"run with {where}: {error}") from None


def load_study(path: str | Path) -> Study:
    """Return the study of a TOML file; a scene's path counts from the study's directory.

    Raises:
        InputError: the file cannot be read or parsed, or the study or one of its scenes is not
            allowed.
    """
    path = Path(path)
    data = read_toml(path)
    if "scene" not in data:
        raise InputError(f'{path}: no scene; allowed is scene = "FILE.toml" or a [scene] table')
    if isinstance(data["scene"], str):
        data["scene"] = load_scene(path.parent / data["scene"])
    try:
        return table_from(Study, "", data)
    except InputError as error:
        raise InputError(f"{path}: {error}") from None
