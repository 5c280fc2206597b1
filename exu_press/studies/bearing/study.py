"""A bearing study: one joint of a scene under loads and at speeds."""

import math
from dataclasses import dataclass

from exu_press.errors import InputError
from exu_press.schema.checks import key
from exu_press.studies.base.command import SceneStudy

__all__ = ["BearingStudy"]


@dataclass(frozen=True)
class BearingStudy(SceneStudy):
    """One joint of a scene under loads and at speeds."""

    joint: str = key("", "name of the joint")
    loads: tuple[float, ...] = ()
    speeds: tuple[float, ...] = ()
    direction: float = key(-90.0, "of the loads, from the drawing's x axis", "deg")

    def __post_init__(self) -> None:
        for load in self.loads:
            if not 0.0 < load < math.inf:
                text = f"load = {load:g}: allowed is a number > 0 (N)"
                raise InputError(f"{text}; direction turns it")

    def load_vector(self, load: float) -> tuple[float, float]:
        """Return a load's components, N, exact along the axes."""
        angle = math.radians(self.direction)
        x, y = (
            0.0 if abs(share) < 1e-15 else share for share in (math.cos(angle), math.sin(angle))
        )
        return load * x, load * y
