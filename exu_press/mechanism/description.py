"""What moves: a planar mechanism as data, before any Exudyn item is made of it."""

from collections.abc import Callable, Collection, Mapping
from dataclasses import dataclass, field

from exu_press.mechanism.kinematics import Array, Motion

__all__ = ["GROUND", "Body", "Guide", "Joint", "Mechanism", "Point", "Spring"]

GROUND = "ground"

Point = tuple[float, float]


@dataclass(frozen=True)
class Body:
    """A rigid body in the plane; its frame sits in its centre of mass."""

    name: str
    mass: float
    inertia: float


@dataclass(frozen=True)
class Joint:
    """A revolute or spherical joint: a journal (or ball) of one body in a bearing (or socket).

    Attributes:
        name: as in the result's channels.
        journal: body that carries the journal or ball.
        journal_point: its centre in that body's frame, m.
        bearing: body that carries the bearing or socket; the film turns with it.
        bearing_point: its centre in that body's frame, m.
        spherical: forces are recorded as 3-vectors.
        vertical_only: an ideal joint between two guided bodies holds y alone, not x twice.
    """

    name: str
    journal: str
    journal_point: Point
    bearing: str
    bearing_point: Point
    spherical: bool = False
    vertical_only: bool = False


@dataclass(frozen=True)
class Spring:
    """Linear stiffness and damping: N/m and N s/m, or N m/rad and N m s/rad."""

    stiffness: float
    damping: float


@dataclass(frozen=True)
class Guide:
    """A vertical guide: holds x and, unless other joints do, the angle.

    Attributes:
        body: what it guides.
        holds_angle: whether the angle too.
        lateral: what holds x, or None where the guide is ideal.
        tilting: what holds the angle, or None.
    """

    body: str
    holds_angle: bool = True
    lateral: Spring | None = None
    tilting: Spring | None = None


@dataclass(frozen=True)
class Mechanism:
    """Bodies, joints and guides, and how they move where every joint is ideal.

    Attributes:
        bodies: in the order of the result's body channels.
        joints: by what the scene says of them ideal or with clearance.
        guides: ideal or elastic.
        crank: name of the driven body.
        slider: name of the body whose motion is the result.
        slider_origin: y of the slider at slider position 0, m.
        motion: (n,) crank angles and a constant speed -> motion (x, y, angle) of every body.
        groups: names for several joints at once -> these joints.
    """

    bodies: tuple[Body, ...]
    joints: tuple[Joint, ...]
    guides: tuple[Guide, ...]
    crank: str
    slider: str
    slider_origin: float
    motion: Callable[[Array, float], Mapping[str, Motion]]
    groups: Mapping[str, tuple[str, ...]] = field(default_factory=dict)

    @property
    def sliding(self) -> frozenset[str]:
        """Names of the bodies that an ideal guide leaves nothing but their height."""
        return frozenset(
            guide.body for guide in self.guides if guide.holds_angle and guide.lateral is None
        )

    def pivoted(self, ideal: Collection[str]) -> dict[str, Joint]:
        """Return bodies on an ideal pivot of the frame -> that joint, whose journal is theirs.

        Args:
            ideal: names of the joints without clearance.
        """
        return {
            joint.journal: joint
            for joint in self.joints
            if joint.bearing == GROUND and joint.name in ideal
        }

    def ideal_slider(self, angle: Array, speed: float) -> tuple[Array, Array, Array]:
        """Return position (m), velocity and acceleration of the slider with ideal joints."""
        slider = self.motion(angle, speed)[self.slider]
        return (
            slider.position[:, 1] - self.slider_origin,
            slider.velocity[:, 1],
            slider.acceleration[:, 1],
        )
