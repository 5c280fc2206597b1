"""Dimensions of a crank shaft and a linkage, and positions of faces on a solid.

Plain data, checked; `fe_models.geometry` makes solids of it.
"""

from dataclasses import asdict, dataclass, replace
from math import pi, sqrt
from typing import Any, Self

from fe_models.errors import InputError

__all__ = ["Axis", "Box", "CrankDimensions", "LinkageDimensions", "Patch", "Sides"]

Box = tuple[tuple[float, float, float], tuple[float, float, float]]


@dataclass(frozen=True)
class Axis:
    """An axis along z, or a ball's centre on it, whose cylinders or sphere a joint holds.

    Attributes:
        position: (x, y), m.
        sphere: whether it is a ball's or socket's.
        hole: whether it is a hole's rather than a shaft's, where the solid has both.
        radius: m; needed where several faces have this axis.
        z: lowest and highest z, m; needed where several faces have this radius.
    """

    position: tuple[float, float]
    sphere: bool = False
    hole: bool = True
    radius: float | None = None
    z: tuple[float, float] | None = None


@dataclass(frozen=True)
class Patch:
    """Faces with a name, or within a box.

    Attributes:
        name: in the STEP file; empty for faces in a box.
        box: lowest and highest corner, m; infinite where there is no limit.
    """

    name: str = ""
    box: Box | None = None


@dataclass(frozen=True)
class Sides:
    """The outermost plane faces on both sides of a solid, across a direction in the x-y plane."""

    across: tuple[float, float]


@dataclass(frozen=True)
class CrankDimensions:
    """Dimensions of a crank shaft, m; `fe_models.CrankShape` says which is which."""

    seat_a_length: float
    seat_a_radius: float
    journal_length: float
    journal_radius: float
    web_thickness: float
    web_radius: float
    pin_length: float
    seat_b_length: float
    seat_b_radius: float
    flange_length: float
    flange_radius: float
    web_offset: float = 0.015
    pin_radius: float = 0.07
    eccentricity: float = 0.03

    def __post_init__(self) -> None:
        """Refuse dimensions that do not make one solid with a whole pin and whole journals."""
        _positive(self, exempt=("web_offset", "eccentricity"))
        reach = self.eccentricity + self.pin_radius - self.web_offset
        if self.web_radius < max(reach, self.journal_radius + self.web_offset):
            raise InputError(
                f"crank: web_radius = {self.web_radius:g}: must cover the pin and the journals, "
                f"at least {max(reach, self.journal_radius + self.web_offset):g}"
            )

    def volume(self) -> float:
        """Return the volume [m^3], in closed form: the sections overlap nowhere."""
        discs = (
            (self.seat_a_length, self.seat_a_radius),
            (2.0 * self.journal_length, self.journal_radius),
            (2.0 * self.web_thickness, self.web_radius),
            (self.pin_length, self.pin_radius),
            (self.seat_b_length, self.seat_b_radius),
            (self.flange_length, self.flange_radius),
        )
        return pi * sum(length * radius * radius for length, radius in discs)

    def web_radius_for(self, volume: float) -> float:
        """Return the web radius [m] that gives the volume [m^3], all else as it is."""
        remaining_volume = self.volume() - 2.0 * pi * self.web_thickness * self.web_radius**2
        return sqrt((volume - remaining_volume) / (2.0 * pi * self.web_thickness))

    def key(self) -> dict[str, Any]:
        """Return the dimensions."""
        return {"shape": "crank", **asdict(self)}


@dataclass(frozen=True)
class LinkageDimensions:
    """Dimensions of a linkage, m; `fe_models.LinkageShape` says which is which."""

    big_outer_radius: float
    big_width: float
    small_outer_radius: float
    small_bore_radius: float
    small_width: float
    shank_half_height_big: float
    shank_half_height_middle: float
    shank_half_height_small: float
    shank_width: float
    pocket_depth: float = 0.0
    rim: float = 0.0
    big_bore_radius: float = 0.07
    length: float = 0.383

    def __post_init__(self) -> None:
        """Refuse walls without thickness and bores that meet."""
        _positive(self, exempt=("pocket_depth", "rim"))
        for end in ("big", "small"):
            outer, bore = getattr(self, f"{end}_outer_radius"), getattr(self, f"{end}_bore_radius")
            if outer <= bore:
                raise InputError(
                    f"linkage: {end}_outer_radius = {outer:g}: must exceed the bore's {bore:g}"
                )
        if self.big_bore_radius + self.small_bore_radius >= self.length:
            raise InputError(f"linkage: the bores meet, length = {self.length:g} is too short")

        if self.pocket_depth > 0.0 and self.rim <= 0.0:
            raise InputError("linkage: a pocket needs rim > 0 (m), the height left above and below")
        if 2.0 * self.pocket_depth >= self.shank_width:
            raise InputError(
                f"linkage: pocket_depth = {self.pocket_depth:g}: must stay below half the shank's "
                f"width, {0.5 * self.shank_width:g}"
            )

    def scale_widths(self, factor: float) -> Self:
        """Return the shape with every width (z) times `factor`: so is its volume."""
        widths = ("big_width", "small_width", "shank_width", "pocket_depth")
        return replace(self, **{name: factor * getattr(self, name) for name in widths})

    def key(self) -> dict[str, Any]:
        """Return the dimensions."""
        return {"shape": "linkage", **asdict(self)}


def _positive(shape: Any, exempt: tuple[str, ...] = ()) -> None:
    """Refuse dimensions that are not positive (exempt ones: not negative)."""
    for name, value in asdict(shape).items():
        if not (value > 0.0 or (name in exempt and value >= 0.0)):
            raise InputError(f"{type(shape).__name__}.{name} = {value!r}: must be positive, in m")
