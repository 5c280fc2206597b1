"""What a part's solid is: dimensions of a crank shaft or linkage, a STEP file, an OCC shape.

Each geometry has `key()`, everything that determines the solid as plain data (for the cache, no
NGSolve needed), and `build()`, which returns a fresh netgen.occ shape with named faces. A fresh
one, because meshing one shape object twice gives two different meshes.
"""

import hashlib
from collections.abc import Mapping
from dataclasses import asdict, dataclass, field, replace
from math import pi, sqrt
from pathlib import Path
from typing import Any, Protocol

from exu_press.errors import InputError

__all__ = ["Axis", "Box", "CrankShape", "Geometry", "LinkageShape", "OwnShape", "StepFile"]

Box = tuple[tuple[float, float, float], tuple[float, float, float]]


@dataclass(frozen=True)
class Axis:
    """An axis along z, or a ball's centre on it, whose cylinders or sphere a joint holds.

    Attributes:
        place: (x, y), m.
        sphere: whether it is a ball's or socket's.
        hole: whether a hole is meant rather than a shaft, where the solid has both.
        radius: m, where several have this axis.
        z: lowest and highest place along it, m, where several have this radius.
    """

    place: tuple[float, float]
    sphere: bool = False
    hole: bool = True
    radius: float | None = None
    z: tuple[float, float] | None = None


class Geometry(Protocol):
    """Anything that can be meshed."""

    def key(self) -> dict[str, Any]:
        """Return what determines the solid, as data that JSON can hold."""

    def build(self) -> Any:
        """Return a fresh netgen.occ shape whose interface faces carry names."""


@dataclass(frozen=True)
class CrankShape:
    """A crank shaft of coaxial cylinders along z; its axis is x = y = 0, the pin's centre z = 0.

    From -z to +z: seat a, journal A, web, pin, web, journal B, seat b, flange. Lengths in m. The
    webs are discs centred `web_offset` towards the pin (+y), which is `eccentricity` off the axis.
    """

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
        """Refuse what is not one solid with a whole pin and whole journals."""
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
        others = self.volume() - 2.0 * pi * self.web_thickness * self.web_radius**2
        return sqrt((volume - others) / (2.0 * pi * self.web_thickness))

    def key(self) -> dict[str, Any]:
        """Return the dimensions."""
        return {"shape": "crank", **asdict(self)}

    def build(self) -> Any:
        """Return the solid: faces "journal A", "pin", "journal B", "flange" and the bare rest."""
        from fe_models.shapes import crank_shaft

        return crank_shaft(self)


@dataclass(frozen=True)
class LinkageShape:
    """A linkage along x: two bosses with bores `length` apart, a shank between; symmetric in y, z.

    Big bore (the bearing of the crank pin) at x = -length/2, small bore at +length/2, bore axes
    along z. The shank runs from boss centre to boss centre, its half height (y) linear between big
    end, middle and small end. Pockets from both faces, `pocket_depth` deep and leaving `rim` above
    and below, make it an I-section between the bosses. Lengths in m.
    """

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
        """Refuse walls that are none and bores that meet."""
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

    def stretched(self, factor: float) -> "LinkageShape":
        """Return the shape with every width (z) times `factor`: so is its volume."""
        widths = ("big_width", "small_width", "shank_width", "pocket_depth")
        return replace(self, **{name: factor * getattr(self, name) for name in widths})

    def key(self) -> dict[str, Any]:
        """Return the dimensions."""
        return {"shape": "linkage", **asdict(self)}

    def build(self) -> Any:
        """Return the solid: faces "big bore", "small bore" and the bare rest."""
        from fe_models.shapes import linkage

        return linkage(self)


@dataclass(frozen=True)
class StepFile:
    """A solid from a STEP file, in m after `scale` (0.001 for a file in mm).

    Netgen reads face names that the file carries. `faces` names others: every face that lies wholly
    inside a box ((x, y, z) lowest, (x, y, z) highest; in m) takes its name. `axes` names cylinders
    along z and spheres by where their axis is.
    """

    path: Path
    scale: float = 1.0
    faces: Mapping[str, Box] = field(default_factory=dict)
    axes: Mapping[str, Axis] = field(default_factory=dict)

    def key(self) -> dict[str, Any]:
        """Return a digest of the file, the boxes and the axes."""
        return {
            "shape": "step",
            "digest": hashlib.sha256(self._bytes()).hexdigest(),
            "scale": self.scale,
            "faces": {name: [list(corner) for corner in box] for name, box in self.faces.items()},
            "axes": {name: asdict(axis) for name, axis in self.axes.items()},
        }

    def build(self) -> Any:
        """Return the solid, its faces named by the file, the boxes and the axes."""
        self._bytes()
        from fe_models.round_faces import name_round_faces
        from fe_models.shapes import from_step

        shape = from_step(self.path, self.scale, self.faces)
        name_round_faces(shape, self.axes, f"STEP file {self.path}")
        return shape

    def _bytes(self) -> bytes:
        """Return the file's content if it is a STEP file at all."""
        try:
            content = Path(self.path).read_bytes()
        except OSError as error:
            raise InputError(f"STEP file {self.path}: cannot be read ({error.strerror})") from error
        if not content.lstrip().startswith(b"ISO-10303-21"):
            raise InputError(
                f"STEP file {self.path}: is not one (a STEP file begins with ISO-10303-21)"
            )
        return content


class OwnShape:
    """A solid that a user made with netgen.occ, its interface faces named (face.name = ...)."""

    def __init__(self, shape: Any) -> None:
        """Keep the shape as text, so that every mesh starts from a fresh copy of it."""
        from fe_models.shapes import freeze

        self._frozen: tuple[str, tuple[str | None, ...]] = freeze(shape)

    def key(self) -> dict[str, Any]:
        """Return a digest of the boundary representation, and the faces' names in its order."""
        text, names = self._frozen
        return {
            "shape": "occ",
            "digest": hashlib.sha256(text.encode()).hexdigest(),
            "names": list(names),
        }

    def build(self) -> Any:
        """Return a fresh copy."""
        from fe_models.shapes import thaw

        return thaw(*self._frozen)


def _positive(shape: Any, exempt: tuple[str, ...] = ()) -> None:
    """Refuse dimensions that are not positive (exempt ones: not negative)."""
    for name, value in asdict(shape).items():
        if not (value > 0.0 or (name in exempt and value >= 0.0)):
            raise InputError(f"{type(shape).__name__}.{name} = {value!r}: must be positive, in m")
