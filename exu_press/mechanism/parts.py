"""Bodies, joints, guides and output of a mechanism, in the coordinates of one assembled drawing."""

import math
from collections.abc import Iterable
from dataclasses import dataclass

__all__ = [
    "DRIVE",
    "FLYWHEEL",
    "FRAME",
    "GROUND",
    "PRECISION",
    "ROD",
    "Body",
    "Guide",
    "Guideway",
    "Joint",
    "Output",
    "Point",
    "Spring",
    "distinct_points",
    "steel_cube",
]

DRIVE = "drive"
FLYWHEEL = "flywheel"
"""Name of the disc that turns a flexible crank."""

GROUND = "frame"

STEEL_DENSITY = 7850.0
"""kg/m^3, for the size of a body of unknown shape."""

ROD = math.nan
"""Inertia of a body that is a uniform rod between its two joints; `Mechanism` fills it in."""

PRECISION = 1e-6
"""Precision of a drawing, over its size: closer points coincide, and redundant constraints agree to
this."""

Point = tuple[float, float]


@dataclass(frozen=True)
class Body:
    """A rigid body in the plane; its frame sits in its centre of mass.

    Attributes:
        name: as in the result's channels.
        mass: kg.
        inertia: about the centre of mass, kg m^2; `ROD` for m l^2 / 12 of a uniform rod.
        centre_of_mass: in the drawing, m.
        angle: of the body's frame in the drawing, rad.
    """

    name: str
    mass: float
    inertia: float = ROD
    centre_of_mass: Point = (0.0, 0.0)
    angle: float = 0.0

    def local(self, point: Point) -> Point:
        """Return a point of the drawing in the body's frame, m."""
        x, y = point[0] - self.centre_of_mass[0], point[1] - self.centre_of_mass[1]
        c, s = math.cos(self.angle), math.sin(self.angle)
        return c * x + s * y, c * y - s * x


FRAME = Body(GROUND, 0.0)
"""The frame, whose coordinates are those of the drawing."""


@dataclass(frozen=True)
class Joint:
    """A revolute or spherical joint: a journal (or ball) of one body in a bearing (or socket).

    Attributes:
        name: as in the result's channels.
        at: its centre in the drawing, m.
        journal: body that carries the journal or ball.
        bearing: body that carries the bearing or socket; the film turns with it.
        shape: "revolute" or "spherical", whose forces are recorded as 3-vectors.
    """

    name: str
    at: Point
    journal: str
    bearing: str
    shape: str = "revolute"

    @property
    def spherical(self) -> bool:
        """Whether it is a ball in a socket."""
        return self.shape == "spherical"

    @property
    def bodies(self) -> frozenset[str]:
        """Names of both bodies."""
        return frozenset((self.journal, self.bearing))

    @property
    def on_frame(self) -> bool:
        """Whether one of its bodies is the frame."""
        return GROUND in self.bodies


@dataclass(frozen=True)
class Spring:
    """Linear stiffness and damping: N/m and N s/m, or N m/rad and N m s/rad."""

    stiffness: float
    damping: float


@dataclass(frozen=True)
class Guideway:
    """Guideways with clearance, which a body touches with its two ends.

    Attributes:
        clearance: on each side, m.
        length: of the body, from end to end, m; its centre of mass lies in the middle. 0 of a pin.
        half_width: of the body, m.
        stiffness: of the contact of each end, N/m.
    """

    clearance: float
    length: float
    half_width: float
    stiffness: float


@dataclass(frozen=True)
class Guide:
    """A prismatic joint or a slot: a body moves along a line of another one.

    In a prismatic joint it turns with that body alone. A slot holds a pin, which can turn in it.

    Attributes:
        name: as in messages and channels.
        direction: of the line in the drawing; `Mechanism` makes it a unit vector.
        body: that it guides; by default that of its name.
        on: body along which it moves, or the frame.
        at: centre of the pin of a slot in the drawing, m; None: a prismatic joint.
        centre: of a circular slot, m; `Mechanism` makes the direction its tangent.
        length: along which a slot extends, m; None: as far as its pin goes.
        middle: of this length; the pin's centre in the drawing unless given.
        lateral: spring across the guide, or None where the guide is ideal.
        tilting: spring of its angle, or None.
        guideway: with clearance, or None.
    """

    name: str
    direction: Point = (0.0, 1.0)
    body: str = ""
    on: str = GROUND
    at: Point | None = None
    centre: Point | None = None
    length: float | None = None
    middle: Point | None = None
    lateral: Spring | None = None
    tilting: Spring | None = None
    guideway: Guideway | None = None

    def __post_init__(self) -> None:
        """Name the body."""
        object.__setattr__(self, "body", self.body or self.name)

    @property
    def key(self) -> str:
        """Its table in a mechanism file."""
        return f"{'slots' if self.is_slot else 'guides'}.{self.name}"

    def disc_of(self, body: str) -> str:
        """Return the name of the disc by which it guides a flexible body."""
        return f"{body} in {self.key}"

    @property
    def is_slot(self) -> bool:
        """Whether it holds a pin, which turns in it."""
        return self.at is not None

    @property
    def is_rail(self) -> bool:
        """Whether it is a guide of the frame that holds a body upright."""
        return self.on_frame and not self.is_slot

    @property
    def bodies(self) -> frozenset[str]:
        """Names of both bodies."""
        return frozenset((self.body, self.on))

    @property
    def on_frame(self) -> bool:
        """Whether it stands still."""
        return self.on == GROUND

    @property
    def holds_across(self) -> bool:
        """Whether it holds the body rigidly along its normal."""
        return self.lateral is None and self.guideway is None

    @property
    def holds_angle(self) -> bool:
        """Whether it holds the body's angle rigidly."""
        return not self.is_slot and self.tilting is None and self.guideway is None

    @property
    def normal(self) -> Point:
        """Unit normal of the guide in the drawing, to the right of its direction."""
        return self.direction[1], -self.direction[0]

    @property
    def radius(self) -> float | None:
        """Radius of a circular slot, m; None: the line is straight."""
        return None if self.at is None or self.centre is None else math.dist(self.at, self.centre)

    @property
    def middle_along(self) -> float:
        """Position of a slot's middle along it from the pin of the drawing, m."""
        if self.at is None or self.middle is None:
            return 0.0
        begin = self.at if self.centre is None else self.centre
        offset = self.middle[0] - begin[0], self.middle[1] - begin[1]
        along = offset[0] * self.direction[0] + offset[1] * self.direction[1]
        across = offset[0] * self.normal[0] + offset[1] * self.normal[1]
        if self.centre is None:
            return along
        return math.dist(self.at, self.centre) * math.atan2(along, across)


@dataclass(frozen=True)
class Output:
    """The body whose motion the slider's channels record, and its direction.

    Attributes:
        body: its centre of mass is meant.
        direction: in which the position counts; `Mechanism` makes it a unit vector.
        origin: where the position is zero, in the drawing, m.
        rotation: whether its angle from the drawing counts instead, counter-clockwise.
    """

    body: str
    direction: Point = (0.0, 1.0)
    origin: Point = (0.0, 0.0)
    rotation: bool = False

    @property
    def unit(self) -> str:
        """SI unit of its position."""
        return "rad" if self.rotation else "m"

    @property
    def normal(self) -> Point:
        """Unit vector to the right of the direction."""
        return self.direction[1], -self.direction[0]


def distinct_points(points: Iterable[Point], size: float) -> list[Point]:
    """Return the points of a drawing of some size, m, without coincident ones."""
    distinct: list[Point] = []
    for point in points:
        if all(math.dist(point, known) > PRECISION * size for known in distinct):
            distinct.append(point)
    return distinct


def steel_cube(mass: float) -> float:
    """Return the inertia of a steel cube about its centre, m (m / rho)^(2/3) / 6, kg m^2."""
    side: float = (mass / STEEL_DENSITY) ** (1 / 3)
    return mass * side**2 / 6
