"""What one load is: a blanking pulse, or a table of forces."""

import math
from dataclasses import dataclass
from itertools import pairwise
from typing import Any, ClassVar, Literal

from exu_press.checks import Table, key
from exu_press.errors import InputError
from exu_press.laws.load_curve import REVOLUTION, LoadCurve, PulseClock, blanking_pulse
from exu_press.scene.bodies import Face, patch_given

__all__ = ["COLUMNS", "LOAD_KINDS", "BlankingLoad", "Load", "TableLoad"]

COLUMNS = ("time", "crank_angle_deg", "height")
"""What a table's forces are given over."""

LOWEST = 180.0
"""deg, where a pulse ends unless another place is given."""


@dataclass(frozen=True)
class _Placed(Table):
    """Where a load acts; its direction stays in the frame however the body turns.

    A flexible body needs to know which of its faces carry the load: those of a joint, or others. A
    point beside the middle of these moves with their mean motion.
    """

    body: str | None = key(None, "body that it acts on; the mechanism's output unless given")
    offset: tuple[float, float] | None = key(
        None,
        "place of the force, from the body's centre of mass, as drawn; 0 unless given",
        "m",
        numbers=2,
    )
    joint: str | None = key(None, "joint of the body, whose centre it acts at; instead of offset")
    face: tuple[Face, ...] | None = key(
        None, "face of a flexible body, in whose middle it acts: its name, or {x, y, z}", also=tuple
    )
    direction: tuple[float, float] | None = key(
        None, "direction of a positive force; the output's unless given", numbers=2
    )

    def __post_init__(self) -> None:
        """Check the keys, that the direction is one, and that there is one place."""
        given: Any = self.face
        if given is not None:
            object.__setattr__(self, "face", patch_given("face", given))
        super().__post_init__()
        if self.joint is not None:
            for name in ("offset", "face"):
                if getattr(self, name) is not None:
                    raise InputError(f"joint and {name}: allowed is one of the two")
        if self.direction is not None and math.hypot(*self.direction) == 0.0:
            raise InputError("direction = [0, 0]: allowed is a direction, such as [0, 1]")


@dataclass(frozen=True)
class BlankingLoad(_Placed):
    """Triangular pulse, once a revolution (Eq. 36, A-14); a motor's crank keeps its times, too."""

    kind: ClassVar[Literal["blanking"]] = "blanking"
    force: float | None = key(None, "peak force", "N", at_least=0)
    rise: float = key(1e-3, "time from zero to the peak (2 tau)", "s", above=0)
    fall: float = key(5e-4, "time from the peak to zero (tau)", "s", above=0)
    end_angle_deg: float = key(
        LOWEST, "crank angle from the mechanism's zero at the end", "deg", above=0, at_most=360
    )
    start_angle_deg: float | None = key(
        None, "the same at the beginning, instead of end_angle_deg", "deg", at_least=0, at_most=360
    )

    def __post_init__(self) -> None:
        """Check the keys; there is a force, and one place."""
        super().__post_init__()
        if self.force is None:
            raise InputError("force: missing; allowed is a number >= 0 (peak force, N)")
        if self.start_angle_deg is not None and self.end_angle_deg != LOWEST:
            raise InputError("start_angle_deg and end_angle_deg: allowed is one of the two")

    @property
    def over(self) -> str:
        """What the curve is given over."""
        return "crank_angle_deg"

    @property
    def closing(self) -> bool:
        """Whether it acts while the output closes only."""
        return False

    def curve(self, angular_speed: float) -> LoadCurve:
        """Return the force over the crank angle, rad, at a speed of the crank, rad/s."""
        assert self.force is not None
        times, forces = blanking_pulse(self.force, self.rise, self.fall)
        if self.start_angle_deg is not None:
            begin = math.radians(self.start_angle_deg)
        else:
            begin = math.radians(self.end_angle_deg) - angular_speed * times[-1]
        return LoadCurve([begin + angular_speed * time for time in times], forces, REVOLUTION)

    def timed(self) -> LoadCurve:
        """Return the force over the time since the pulse's beginning, s."""
        assert self.force is not None
        return LoadCurve(*blanking_pulse(self.force, self.rise, self.fall))

    def clock(self, now: float, speed: float) -> PulseClock:
        """Return when it begins at a crank whose speed varies; its angle and speed at the start."""
        begins = self.start_angle_deg
        angle = math.radians(self.end_angle_deg if begins is None else begins)
        lasts = self.rise + self.fall
        return PulseClock(lasts, angle, at_end=begins is None, now=now, speed=speed)


@dataclass(frozen=True)
class TableLoad(_Placed):
    """Forces over time, crank angle or the output's height, straight lines between them.

    The height counts from the ideal bottom dead centre. Over the crank angle forces repeat every
    revolution, from the last point to the first; otherwise the first and the last force go on
    beyond the table. A forming force acts while the output closes. It fades as the output comes to
    rest, over a thousandth of the ideal motion's largest speed.
    """

    kind: ClassVar[Literal["table"]] = "table"
    time: tuple[float, ...] | None = key(None, "of the forces, from the start", "s", numbers=0)
    crank_angle_deg: tuple[float, ...] | None = key(
        None, "of the forces, from the mechanism's zero", "deg", numbers=0
    )
    height: tuple[float, ...] | None = key(
        None, "of the output above bottom dead centre", "m", numbers=0
    )
    force: tuple[float, ...] | None = key(None, "positive in the direction", "N", numbers=0)
    factor: float = key(1.0, "times the table's forces")
    acts: str | None = key(
        None,
        "while the output closes or both ways; over height 'closing' unless given, else 'both'",
        choices=("closing", "both"),
    )

    def __post_init__(self) -> None:
        """Check the keys; one column of increasing places, and a force at each."""
        super().__post_init__()
        given = [name for name in COLUMNS if getattr(self, name) is not None]
        if len(given) != 1 or self.force is None:
            shown = ", ".join([*given, *(["force"] if self.force is not None else [])]) or "nothing"
            raise InputError(
                f"{shown} given: allowed is file, a CSV, or one of {', '.join(COLUMNS)} with force"
            )
        places = getattr(self, given[0])
        if len(places) < 2 or len(places) != len(self.force):
            raise InputError(
                f"{given[0]}, force: {len(places)} and {len(self.force)} values; allowed are at "
                "least two, as many of both"
            )
        for before, after in pairwise(places):
            if not after > before:
                raise InputError(f"{given[0]} = {after!r} after {before!r}: allowed is increasing")
        if given[0] == "crank_angle_deg":
            turn = places[-1] - places[0]
            if turn > 360.0 or (turn == 360.0 and self.force[0] != self.force[-1]):
                raise InputError(
                    f"crank_angle_deg from {places[0]!r} to {places[-1]!r}: allowed is less than a "
                    "revolution, or a whole one that ends with the force with which it begins"
                )

    @property
    def over(self) -> str:
        """What the curve is given over."""
        return next(name for name in COLUMNS if getattr(self, name) is not None)

    @property
    def closing(self) -> bool:
        """Whether it acts while the output closes only."""
        return (self.acts or ("closing" if self.over == "height" else "both")) == "closing"

    def curve(self, angular_speed: float) -> LoadCurve:
        """Return the force over time, s, crank angle, rad, or height, m."""
        assert self.force is not None
        places, forces = getattr(self, self.over), [self.factor * force for force in self.force]
        if self.over != "crank_angle_deg":
            return LoadCurve(places, forces)
        if places[-1] - places[0] == 360.0:
            places, forces = places[:-1], forces[:-1]
        return LoadCurve([math.radians(place) for place in places], forces, REVOLUTION)


Load = BlankingLoad | TableLoad
LOAD_KINDS: dict[str, type[Load]] = {kind.kind: kind for kind in (BlankingLoad, TableLoad)}
