"""One load: a blanking pulse, a table of forces, a sheet or a spring."""

import dataclasses
import math
from abc import ABC, abstractmethod
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, ClassVar, Literal, Self

import numpy as np

from exu_press.errors import InputError
from exu_press.laws.load_curve import REVOLUTION, LoadCurve, PulseClock, blanking_pulse
from exu_press.laws.sheet import SHAPE, Sheet, shear_force
from exu_press.mechanism import Mechanism
from exu_press.scene.bodies import Face, patch_given
from exu_press.schema.checks import check_columns, check_increasing, key
from exu_press.schema.kinds import CustomKind
from exu_press.schema.table import Table

__all__ = [
    "COLUMNS",
    "LOAD_KINDS",
    "BlankingLoad",
    "CustomLoad",
    "Load",
    "SheetLoad",
    "SpringLoad",
    "TableLoad",
    "UnresolvedLoad",
]

COLUMNS = ("time", "crank_angle_deg", "height")
"""Variables that a table's forces may be given over."""

LOWEST = 180.0
"""deg, where a pulse ends unless another place is given."""


@dataclass(frozen=True)
class _Placed(Table, ABC):
    """The place of a load; its direction stays in the frame however the body turns.

    `over` is the variable of its curve; `closing` says whether it depends on the way that the
    output goes.

    A flexible body needs to know which of its faces carry the load: those of a joint, or others. A
    point beside the middle of these moves with their mean motion.
    """

    exclusive_with: ClassVar[Mapping[str, str]] = {"offset": "joint", "face": "joint"}
    over: ClassVar[Any] = ""
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
        given: Any = self.face
        if given is not None:
            object.__setattr__(self, "face", patch_given("face", given))
        super().__post_init__()
        if self.direction is not None and math.hypot(*self.direction) == 0.0:
            raise InputError("direction = [0, 0]: allowed is a direction, such as [0, 1]")

    def check(self, mechanism: Mechanism, revolution: float) -> None:
        """Raise InputError where it does not suit a mechanism and the time of a revolution, s."""

    def law(self, angular_speed: float, fade: float | None, *, motor: bool) -> dict[str, Any]:
        """Return what an `AppliedLoad` has by its kind.

        Args:
            angular_speed: of the crank, rad/s.
            fade: speed of the output from which a forming force acts in full, m/s, or None.
            motor: whether the crank's speed varies.
        """
        return {"over": self.over, "curve": self.curve(angular_speed)}

    @abstractmethod
    def curve(self, angular_speed: float) -> LoadCurve:
        """Return the force over its variable at a speed of the crank, rad/s."""


@dataclass(frozen=True)
class BlankingLoad(_Placed):
    """Triangular pulse, once a revolution (Eq. 36, A-14); a motor's crank keeps its times, too."""

    kind: ClassVar[Literal["blanking"]] = "blanking"
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
        super().__post_init__()
        given = [name for name in COLUMNS if getattr(self, name) is not None]
        if len(given) != 1 or self.force is None:
            shown = ", ".join([*given, *(["force"] if self.force is not None else [])]) or "nothing"
            raise InputError(
                f"{shown} given: allowed is file, a CSV, or one of {', '.join(COLUMNS)} with force"
            )
        places = getattr(self, given[0])
        check_columns((given[0], "force"), places, self.force)
        check_increasing(given[0], places)
        if given[0] == "crank_angle_deg":
            turn = places[-1] - places[0]
            if turn > 360.0 or (turn == 360.0 and self.force[0] != self.force[-1]):
                raise InputError(
                    f"crank_angle_deg from {places[0]!r} to {places[-1]!r}: allowed is less than a "
                    "revolution, or a whole one that ends with the force with which it begins"
                )

    @property
    def over(self) -> str:
        """The variable of the curve."""
        return next(name for name in COLUMNS if getattr(self, name) is not None)

    @property
    def closing(self) -> bool:
        """Return whether it acts while the output closes only."""
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


@dataclass(frozen=True)
class SheetLoad(_Placed):
    """A sheet that is cut once a stroke: the output's place decides, not the clock.

    A sheet of its own lies on the die for every stroke. Its fracture ends a step.
    """

    kind: ClassVar[Literal["sheet"]] = "sheet"
    over: ClassVar = "penetration"
    closing: ClassVar = True
    required: ClassVar[tuple[str, ...]] = (
        *("height", "thickness", "shear_strength", "cut_length", "penetration", "crack_time"),
    )
    height: float = key(None, "of the sheet's upper face above bottom dead centre", "m", above=0)
    thickness: float = key(None, "of the sheet", "m", above=0)
    shear_strength: float = key(
        None, "of the sheet, about 0.8 of its tensile strength", "Pa", above=0
    )
    cut_length: float = key(None, "of the line that is cut", "m", above=0)
    penetration: float = key(
        None, "of the punch at fracture over the thickness", above=0, at_most=1
    )
    crack_time: float = key(None, "from fracture to no force", "s", above=0)
    stripping: float = key(0.0, "force on the way up over the largest force", at_least=0, at_most=1)
    over_fracture: tuple[float, ...] = key(
        SHAPE[0], "penetrations of the curve over that at fracture, from 0 to 1", numbers=0
    )
    over_peak: tuple[float, ...] = key(
        SHAPE[1], "forces of the curve over shear_strength cut_length thickness", numbers=0
    )

    def __post_init__(self) -> None:
        super().__post_init__()
        check_columns(("over_fracture", "over_peak"), self.over_fracture, self.over_peak)
        if (self.over_fracture[0], self.over_fracture[-1], self.over_peak[0]) != (0.0, 1.0, 0.0):
            raise InputError(
                f"over_fracture from {self.over_fracture[0]!r} to {self.over_fracture[-1]!r}, "
                f"over_peak from {self.over_peak[0]!r}: allowed is from 0 to 1, and from 0"
            )
        check_increasing("over_fracture", self.over_fracture)
        if not min(self.over_peak[1:]) > 0.0:
            raise InputError(
                f"over_peak = {min(self.over_peak[1:])!r}: allowed is > 0 after the first"
            )

    def curve(self, angular_speed: float) -> LoadCurve:
        """Return the force over the penetration up to fracture, m."""
        peak = shear_force(self.shear_strength, self.cut_length, self.thickness)
        depth = self.penetration * self.thickness
        return LoadCurve(
            [depth * x for x in self.over_fracture], [peak * y for y in self.over_peak]
        )

    def check(self, mechanism: Mechanism, revolution: float) -> None:
        """Raise InputError unless the output leaves the sheet, and cuts it through."""
        _check_height(self.height, mechanism)
        depth = self.thickness * self.penetration
        if depth >= self.height:
            raise InputError(
                f"thickness = {self.thickness!r}: it fractures {depth:.4g} m deep, and the output "
                f"goes {self.height!r} m into it; allowed is a larger height, or a thinner sheet"
            )

    def law(self, angular_speed: float, fade: float | None, *, motor: bool) -> dict[str, Any]:
        """Return the sheet as well, and the height of its upper face."""
        assert fade is not None
        curve = self.curve(angular_speed)
        stripping = self.stripping * curve.peak
        sheet = Sheet(curve, self.thickness, self.crack_time, stripping, fade)
        return {"over": self.over, "curve": curve, "sheet": sheet, "top": self.height}


@dataclass(frozen=True)
class SpringLoad(_Placed):
    """A gas spring, cushion or buffer: force over its travel, with damping.

    The force is F(x) (1 + d dx/dt), as long as that pushes.
    """

    kind: ClassVar[Literal["spring"]] = "spring"
    over: ClassVar = "height"
    closing: ClassVar = False
    required: ClassVar[tuple[str, ...]] = ("height", "travel", "force")
    height: float = key(
        None, "of the output above bottom dead centre where it meets the spring", "m", above=0
    )
    travel: tuple[float, ...] = key(None, "of the forces, from 0", "m", numbers=0)
    force: tuple[float, ...] = key(None, "over the travel, from 0", "N", numbers=0)
    damping: float = key(0.0, "d, of the force per speed over the force", "s/m", at_least=0)

    def __post_init__(self) -> None:
        super().__post_init__()
        check_columns(("travel", "force"), self.travel, self.force)
        if self.travel[0] != 0.0 or self.force[0] != 0.0 or min(self.force) < 0.0:
            raise InputError(
                f"travel from {self.travel[0]!r}, force from {self.force[0]!r}: allowed is from 0 "
                "and 0, and pushing; let a preload rise over a short travel, as its seat gives way"
            )
        check_increasing("travel", self.travel)

    def check(self, mechanism: Mechanism, revolution: float) -> None:
        """Raise InputError unless the output leaves the spring, and its travel is long enough."""
        _check_height(self.height, mechanism)
        if self.travel[-1] < self.height:
            raise InputError(
                f"travel to {self.travel[-1]!r}: the output compresses it by {self.height!r} m; "
                "allowed is a travel as long as that"
            )

    def law(self, angular_speed: float, fade: float | None, *, motor: bool) -> dict[str, Any]:
        """Return the damping as well."""
        return super().law(angular_speed, fade, motor=motor) | {"damping": self.damping}

    def curve(self, angular_speed: float) -> LoadCurve:
        """Return the force over the output's height, m."""
        places = [self.height - x for x in reversed(self.travel)]
        return LoadCurve(places, tuple(reversed(self.force)))


@dataclass(frozen=True)
class CustomLoad(CustomKind, _Placed, ABC):
    """Base of a load kind of your own; `kind = "my_module:MyClass"` names it in a scene.

    The derived dataclass declares its keys by `exu_press.schema.checks.key`, and `over`, one of
    "time" (s), "crank_angle_deg" (its curve is over rad) and "height" (m), as class variables.
    """

    over: ClassVar[str] = "height"
    closing: ClassVar[bool] = False

    @abstractmethod
    def curve(self, angular_speed: float) -> LoadCurve:
        """Return the force, N, at a speed of the crank, rad/s."""


@dataclass(frozen=True)
class UnresolvedLoad(CustomLoad):
    """A load of a result whose kind is code that is not loaded: it is shown, and not built.

    Attributes:
        name: of the kind.
        keys: as the result has them.
    """

    resolved: ClassVar[bool] = False
    over: ClassVar[str] = "time"
    name: str = ""
    keys: Mapping[str, Any] = dataclasses.field(default_factory=dict, hash=False)

    @classmethod
    def of(cls, name: str, keys: Mapping[str, Any]) -> Self:
        """Return the load of a kind and its keys."""
        placed = {k: v for k, v in keys.items() if k in _Placed.__dataclass_fields__}
        return cls(**placed, name=name, keys=keys)

    @property
    def kind(self) -> str:
        """Name of the class, as the result has it."""
        return self.name

    def curve(self, angular_speed: float) -> LoadCurve:
        """Return forces that are no numbers: they are unknown."""
        return LoadCurve([0.0, 1.0], [math.nan, math.nan])


def _check_height(height: float, mechanism: Mechanism) -> None:
    """Check that the output leaves a sheet or spring."""
    angle = np.linspace(0.0, 2.0 * math.pi, 721)
    stroke = float(mechanism.ideal_slider(angle, 1.0)[0].max()) - mechanism.bottom
    if height >= stroke:
        raise InputError(
            f"height = {height!r}: the output rises {stroke:.4g} m above bottom dead centre and "
            "never leaves it; allowed is less than that"
        )


Load = BlankingLoad | TableLoad | SheetLoad | SpringLoad | CustomLoad
LOAD_KINDS: dict[str, type[Load]] = {
    kind.kind: kind for kind in (BlankingLoad, TableLoad, SheetLoad, SpringLoad)
}
