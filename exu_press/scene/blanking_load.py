"""A blanking pulse."""

import math
from dataclasses import dataclass
from typing import Any, ClassVar

from exu_press.errors import InputError
from exu_press.laws.load_curve import REVOLUTION, LoadCurve, PulseClock, blanking_pulse
from exu_press.mechanism import Mechanism
from exu_press.scene.load import Load
from exu_press.schema.checks import key

__all__ = ["BlankingLoad"]

LOWEST = 180.0
"""deg, where a pulse ends unless another place is given."""


@dataclass(frozen=True)
class BlankingLoad(Load):
    """Triangular pulse, once a revolution (Eq. 36, A-14); a motor's crank keeps its times, too."""

    registered_name: ClassVar[str] = "blanking"
    over: ClassVar = "crank_angle_deg"
    closing: ClassVar = False
    required: ClassVar[tuple[str, ...]] = ("force",)
    force: float = key(None, "peak force", "N", at_least=0)
    rise: float = key(1e-3, "time from zero to the peak (2 tau)", "s", above=0)
    fall: float = key(5e-4, "time from the peak to zero (tau)", "s", above=0)
    end_angle_deg: float = key(
        LOWEST, "crank angle from the mechanism's zero at the end", "deg", above=0, at_most=360
    )
    start_angle_deg: float | None = key(
        None, "the same at the beginning, instead of end_angle_deg", "deg", at_least=0, at_most=360
    )

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.start_angle_deg is not None and self.end_angle_deg != LOWEST:
            raise InputError("start_angle_deg and end_angle_deg: allowed is one of the two")

    def curve(self, angular_speed: float) -> LoadCurve:
        """Return the force over the crank angle, rad, at a speed of the crank, rad/s."""
        times, forces = blanking_pulse(self.force, self.rise, self.fall)
        if self.start_angle_deg is not None:
            begin = math.radians(self.start_angle_deg)
        else:
            begin = math.radians(self.end_angle_deg) - angular_speed * times[-1]
        return LoadCurve([begin + angular_speed * time for time in times], forces, REVOLUTION)

    def check(self, mechanism: Mechanism, revolution: float) -> None:
        """Raise InputError for a pulse longer than a revolution, s."""
        if self.rise + self.fall > revolution:
            raise InputError(
                f"rise + fall = {self.rise + self.fall!r}: allowed is at most one revolution, "
                f"{revolution:g} s"
            )

    def law(self, angular_speed: float, fade: float | None, *, motor: bool) -> dict[str, Any]:
        """Return force over the time since the pulse's beginning, s, and its clock, or `curve`."""
        if not motor:
            return super().law(angular_speed, fade, motor=motor)
        curve = LoadCurve(*blanking_pulse(self.force, self.rise, self.fall))
        return {"over": "pulse", "curve": curve, "clock": self._clock}

    def _clock(self, now: float, speed: float) -> PulseClock:
        """Return when it begins at a crank whose speed varies; its angle and speed at the start."""
        begins = self.start_angle_deg
        angle = math.radians(self.end_angle_deg if begins is None else begins)
        lasts = self.rise + self.fall
        return PulseClock(lasts, angle, at_end=begins is None, now=now, speed=speed)
