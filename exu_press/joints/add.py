"""The joints for anybody's Exudyn system: two bodies, two points, and the laws between them."""

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import exudyn as exu
import numpy as np
from exudyn.itemInterface import SensorUserFunction

from exu_press.errors import InputError
from exu_press.joints.ends import BodyEnd, BodyPoint, spatial_end
from exu_press.joints.guideway import GuidewayContact, SpatialGuidewayContact
from exu_press.joints.guideway_film import GuidewayFilm
from exu_press.joints.interface import DryInterface, FilmInterface, InterfaceLaw
from exu_press.joints.joint import ClearanceJoint
from exu_press.joints.moving_guideway import MovingGuidewayContact
from exu_press.joints.planar import PlanarJoint, in_plane, planar_end
from exu_press.joints.spatial import SpatialRevolute
from exu_press.joints.spherical import SpatialSpherical
from exu_press.joints.spherical_film import SphericalFilm
from exu_press.joints.user_force import user_force_of
from exu_press.laws.contact import NormalContact
from exu_press.laws.film.asperities import pad_with_asperities
from exu_press.laws.film.ball import BallFilm
from exu_press.laws.film.contract import FilmLaw, film_scale
from exu_press.laws.film.plane_pad import plane_pad
from exu_press.laws.friction import Friction, LuGre, no_friction
from exu_press.laws.parameters import positive

if TYPE_CHECKING:
    from exu_press.joints.worn import WornSurfaces

__all__ = [
    "add_dry_revolute",
    "add_dry_spherical",
    "add_guideway_contact",
    "add_guideway_film",
    "add_joint_sensor",
    "add_lubricated_revolute",
    "add_lubricated_spherical",
    "add_moving_guideway_contact",
    "add_revolute",
]


def add_dry_revolute(
    mbs: exu.MainSystem,
    journal: BodyPoint,
    bearing: BodyPoint,
    *,
    radius: float,
    clearance: float,
    contact: NormalContact,
    friction: Friction | LuGre,
    axis: Sequence[float] = (0, 0, 1),
) -> ClearanceJoint:
    """Put a dry revolute joint with clearance between two bodies (Eqs. 7-11, 23-33).

    Args:
        mbs: system, not yet assembled.
        journal: body that carries the journal, and its centre in that body.
        bearing: the same of the bearing; the film turns with it.
        radius: radius of the journal, m.
        clearance: radius of the bearing minus that of the journal, m.
        contact: normal contact law.
        friction: friction law.
        axis: of the bearing, in its body's frame.

    Returns:
        The joint; `add_joint_sensor` records it.

    Raises:
        InputError: a body or its node is of a kind that joints cannot hold on to (the message lists
            those they can), the axis of a joint between planar bodies is not theirs, radius and
            clearance are not 0 < clearance < radius, a law is given by its name, or the system is
            assembled already.
    """
    _check(mbs, contact=contact, friction=friction, radius=radius, clearance=clearance)
    interfaces = _touching(contact, friction, radius, clearance)
    return add_revolute(mbs, journal, bearing, interfaces, axis=axis)


def add_dry_spherical(
    mbs: exu.MainSystem,
    ball: BodyPoint,
    socket: BodyPoint,
    *,
    radius: float,
    clearance: float,
    contact: NormalContact,
    friction: Friction | LuGre,
) -> ClearanceJoint:
    """Put a dry spherical joint with clearance between two bodies (Eqs. 12-22).

    Between planar bodies ball and socket touch in the plane, like a journal and its bearing.

    Args:
        mbs: system, not yet assembled.
        ball: body that carries the ball, and its centre in that body.
        socket: the same of the socket.
        radius: radius of the ball, m.
        clearance: radius of the socket minus that of the ball, m.
        contact: normal contact law.
        friction: friction law.

    Returns:
        The joint; `add_joint_sensor` records it.

    Raises:
        InputError: as `add_dry_revolute`.
    """
    _check(mbs, contact=contact, friction=friction, radius=radius, clearance=clearance)
    if in_plane(mbs, ball) and in_plane(mbs, socket):
        return add_revolute(mbs, ball, socket, _touching(contact, friction, radius, clearance))
    ends = spatial_end(mbs, ball), spatial_end(mbs, socket)
    return _add_joint(mbs, SpatialSpherical(*ends, contact, friction, radius, clearance))


def add_lubricated_revolute(
    mbs: exu.MainSystem,
    journal: BodyPoint,
    bearing: BodyPoint,
    *,
    radius: float,
    clearance: float,
    length: float,
    viscosity: float,
    law: FilmLaw,
    contact: NormalContact | None = None,
    friction: Friction | LuGre | None = None,
    asperity_onset: float = 0.0,
    axis: Sequence[float] = (0, 0, 1),
) -> ClearanceJoint:
    """Put a lubricated revolute joint between two bodies (Eqs. 34-35 corrected).

    With a contact law, film and contact act in parallel: pass a film law that goes on beyond an
    eccentricity ratio of 1 (`exu_press.laws.film.with_asperities`) with the same onset.

    Args:
        mbs: system, not yet assembled.
        journal: body that carries the journal, and its centre in that body.
        bearing: the same of the bearing; the film turns with it.
        radius: radius of the journal, m.
        clearance: radius of the bearing minus that of the journal, m.
        length: length of the bearing, m.
        viscosity: dynamic viscosity, Pa s.
        law: film law.
        contact: normal contact law of asperities and bodies.
        friction: friction law of the contact.
        asperity_onset: gap at which the surfaces begin to touch, m.
        axis: of the bearing, in its body's frame.

    Returns:
        The joint; `add_joint_sensor` records it.

    Raises:
        InputError: as `add_dry_revolute`, or a length, radius, clearance or viscosity not positive.
    """
    _check(mbs, radius=radius, clearance=clearance, law=law, **_given_laws(contact, friction))
    film = FilmInterface(law, film_scale(viscosity, length, radius, clearance), clearance)
    touching = _touching(contact, friction, radius, clearance - asperity_onset)
    return add_revolute(mbs, journal, bearing, [film, *touching], axis=axis)


def add_lubricated_spherical(
    mbs: exu.MainSystem,
    ball: BodyPoint,
    socket: BodyPoint,
    *,
    radius: float,
    clearance: float,
    viscosity: float,
    film: BallFilm,
    contact: NormalContact | None = None,
    friction: Friction | LuGre | None = None,
    asperity_onset: float = 0.0,
) -> ClearanceJoint:
    """Put a lubricated spherical joint between two bodies.

    With a contact law, film and contact act in parallel: pass a film with the ratio of the same
    onset to the clearance. Between planar bodies the ball moves in the plane.

    Args:
        mbs: system, not yet assembled.
        ball: body that carries the ball, and its centre in that body.
        socket: the same of the socket.
        radius: radius of the ball, m.
        clearance: radius of the socket minus that of the ball, m.
        viscosity: dynamic viscosity, Pa s.
        film: of the socket's caps (`exu_press.laws.film.ball`).
        contact: normal contact law of asperities and bodies.
        friction: friction law of the contact.
        asperity_onset: gap at which the surfaces begin to touch, m.

    Returns:
        The joint; `add_joint_sensor` records it.

    Raises:
        InputError: as `add_dry_revolute`, or a radius, clearance or viscosity not positive.
    """
    _check(mbs, radius=radius, clearance=clearance, film=film, **_given_laws(contact, friction))
    scale = film_scale(viscosity, radius, radius, clearance)
    if in_plane(mbs, ball) and in_plane(mbs, socket):
        between = FilmInterface(film.law, scale, clearance)
        touching = _touching(contact, friction, radius, clearance - asperity_onset)
        return add_revolute(mbs, ball, socket, [between, *touching])
    joint = SpatialSpherical(
        spatial_end(mbs, ball),
        spatial_end(mbs, socket),
        contact,
        friction or no_friction(),
        radius,
        clearance,
        SphericalFilm(film, scale, clearance),
        asperity_onset,
    )
    return _add_joint(mbs, joint)


def add_guideway_contact(
    mbs: exu.MainSystem,
    body: BodyPoint,
    *,
    middle: Sequence[float],
    direction: Sequence[float],
    clearance: float,
    contact: NormalContact,
    friction: Friction | LuGre,
    half_width: float = 0.0,
) -> ClearanceJoint:
    """Put one end of a body into a straight guideway of the frame: touching and rubbing.

    A guided body has two such ends, which keep it upright.

    Args:
        mbs: system, not yet assembled.
        body: that lies between them, and the point of it that touches, in its frame (m).
        middle: a point in the middle of the guideway, m.
        direction: of the guideway.
        clearance: on each side of the point, m.
        contact: normal contact law.
        friction: friction law.
        half_width: of the body: friction acts so far beside the point, m.

    Returns:
        The contact; `add_joint_sensor` records it, with the force on the body.

    Raises:
        InputError: the body is of a kind that joints cannot hold on to, direction or clearance are
            none, a law is given by its name, or the system is assembled already.
    """
    _check_laws(mbs, contact=contact, friction=friction)
    x, y = _along_guideway(direction, clearance, half_width)
    across = y, -x
    interface = DryInterface(contact, friction, half_width, clearance)
    centre = float(middle[0]), float(middle[1])
    if in_plane(mbs, body):
        return _add_joint(mbs, GuidewayContact(planar_end(mbs, body), centre, across, interface))
    return _add_joint(
        mbs, SpatialGuidewayContact(spatial_end(mbs, body), centre, across, interface)
    )


def add_moving_guideway_contact(
    mbs: exu.MainSystem,
    body: BodyPoint,
    line: BodyPoint,
    *,
    across: float,
    clearance: float,
    contact: NormalContact,
    friction: Friction | LuGre,
    half_width: float = 0.0,
    radius: float | None = None,
) -> ClearanceJoint:
    """Put a point of a planar body between the walls of another one: a guideway or a slot.

    Args:
        mbs: system, not yet assembled.
        body: that lies between the walls, and the point of it that touches, in its frame (m).
        line: body with the walls, and a point in their middle, or the centre of a circular slot.
        across: angle of the walls' normal in that body's frame, rad.
        clearance: on each side of the point, m.
        contact: normal contact law.
        friction: friction law.
        half_width: of the body, or radius of a pin: friction acts so far beside the point, m.
        radius: of a circular slot, m; None: straight walls.

    Returns:
        The contact; `add_joint_sensor` records it, with the force on the body.

    Raises:
        InputError: a body is not planar, clearance or radius are none, a law is given by its name,
            or the system is assembled already.
    """
    _check_laws(mbs, contact=contact, friction=friction)
    _along_guideway((1.0, 0.0), clearance, half_width)
    if radius is not None:
        positive(radius=radius)
    if not (in_plane(mbs, body) and in_plane(mbs, line)):
        raise InputError("a moving guideway holds planar bodies alone")
    ends = planar_end(mbs, body), planar_end(mbs, line)
    interface = DryInterface(contact, friction, half_width, clearance)
    return _add_joint(mbs, MovingGuidewayContact(*ends, across, interface, radius))


def add_guideway_film(
    mbs: exu.MainSystem,
    rear: BodyPoint,
    front: BodyPoint,
    *,
    middle: Sequence[float],
    direction: Sequence[float],
    clearance: float,
    length: float,
    face_width: float,
    viscosity: float,
    asperity_onset: float,
    half_width: float = 0.0,
    on: int | None = None,
) -> ClearanceJoint:
    """Fill the gaps between a body and a straight guideway, of the frame or a body, with oil.

    Contacts of both ends act in parallel: `add_guideway_contact`, or on a body
    `add_moving_guideway_contact`, with the clearance less the asperities' onset.

    Args:
        mbs: system, not yet assembled.
        rear: body that lies in the guideway, and the point of its end that lies behind, in its
            frame (m).
        front: the same body and its other end.
        middle: a point in the middle of the guideway, m.
        direction: of the guideway, from rear to front.
        clearance: on each side of both points, m.
        length: of the pads, from rear to front, m.
        face_width: of the pads, normal to the plane, m.
        viscosity: dynamic viscosity, Pa s.
        asperity_onset: gap at which the surfaces begin to touch, m, below the clearance.
        half_width: of the body: shear acts so far beside its middle, m.
        on: number of the body with the guideway, in whose frame are middle and direction; None: the
            frame.

    Returns:
        The film, a joint as others; `add_joint_sensor` records it.

    Raises:
        InputError: the body is of a kind that joints cannot hold on to, a size or the viscosity is
            not positive, the pads' ratio is outside their law's range, the onset is not below the
            clearance, or the system is assembled already.
    """
    _check_laws(mbs)
    along = _along_guideway(direction, clearance, half_width)
    positive(viscosity=viscosity)
    if not 0.0 < asperity_onset < clearance:
        raise InputError(
            f"asperity_onset = {asperity_onset:g}: allowed is a number > 0 and below the "
            f"clearance, {clearance:g} m"
        )
    point = [float(middle[0]), float(middle[1]), 0.0]
    film = GuidewayFilm(
        spatial_end(mbs, rear),
        spatial_end(mbs, front),
        BodyEnd("Ground", 0, np.zeros(0), np.array(point))
        if on is None
        else spatial_end(mbs, (on, point)),
        along,
        law=pad_with_asperities(plane_pad(length, face_width), asperity_onset),
        viscosity=viscosity,
        clearance=clearance,
        contact_onset=clearance - asperity_onset,
        length=length,
        half_width=half_width,
    )
    return _add_joint(mbs, film)


def _along_guideway(
    direction: Sequence[float], clearance: float, half_width: float
) -> tuple[float, float]:
    """Return a guideway's direction, a unit vector; raise InputError for wrong sizes."""
    length = math.hypot(direction[0], direction[1])
    if not 0.0 < length < math.inf:
        raise InputError(f"direction = {tuple(direction)}: allowed is a direction, such as (0, 1)")
    if not 0.0 < clearance < math.inf or not 0.0 <= half_width < math.inf:
        raise InputError(
            f"clearance = {clearance:g}, half_width = {half_width:g}: allowed are numbers > 0 and "
            ">= 0 (m)"
        )
    return direction[0] / length, direction[1] / length


def add_joint_sensor(mbs: exu.MainSystem, joint: ClearanceJoint) -> int:
    """Record a joint at every step; return the sensor's number for mbs.GetSensorStoredData.

    Columns behind the time: eccentricity (m) and force on the journal (N), each with two components
    between planar bodies and three otherwise; the moments on journal and bearing (N m, one each, or
    three each for a spherical joint in space); the gap (m: the film's least thickness, or minus the
    penetration); the dissipated power (W).
    """
    user_force = user_force_of(mbs)

    def values(mbs: Any, t: float, sensors: Any, factors: Any, configuration: Any) -> list[float]:
        state = user_force.state(joint)
        vectors = [*state.eccentricity, *state.force, *state.moments]
        return [*vectors, state.gap, state.dissipated_power]

    user_function: Any = values
    return int(
        mbs.AddSensor(SensorUserFunction(storeInternal=True, sensorUserFunction=user_function))
    )


def _touching(
    contact: NormalContact | None, friction: Friction | LuGre | None, radius: float, reach: float
) -> list[InterfaceLaw]:
    """Return the interface of surfaces that touch at an eccentricity, m; none without contact."""
    if contact is None:
        return []
    return [DryInterface(contact, friction or no_friction(), radius, reach)]


def _given_laws(contact: Any, friction: Any) -> dict[str, Any]:
    laws = {"friction": friction, "contact": contact}
    return {name: law for name, law in laws.items() if law is not None}


def _add_joint(mbs: exu.MainSystem, joint: ClearanceJoint) -> ClearanceJoint:
    user_force_of(mbs).add(joint)
    return joint


def _check(mbs: exu.MainSystem, *, radius: float, clearance: float, **laws: Any) -> None:
    """Raise InputError unless a joint can be made."""
    _check_laws(mbs, **laws)
    if not 0.0 < radius < math.inf:
        raise InputError(f"radius = {radius:g}: allowed is a number > 0 (m)")
    if not 0.0 < clearance < radius:
        raise InputError(
            f"clearance = {clearance:g}: allowed is a number > 0 and below the radius, {radius:g} m"
        )


def _check_laws(mbs: exu.MainSystem, **laws: Any) -> None:
    """Raise InputError for an assembled system and for laws that are none."""
    if mbs.systemIsConsistent:
        raise InputError("the system is assembled: allowed is to add joints before mbs.Assemble()")
    for name, law in laws.items():
        if law is None or isinstance(law, str | int | float):
            raise InputError(
                f"{name} = {law!r}: allowed is a law, as the functions in exu_press.laws return, "
                "not its name or a number"
            )


def add_revolute(
    mbs: exu.MainSystem,
    journal: BodyPoint,
    bearing: BodyPoint,
    interfaces: Sequence[InterfaceLaw],
    *,
    axis: Sequence[float] = (0, 0, 1),
    worn: "WornSurfaces | None" = None,
    bearing_turned: float = 0.0,
) -> ClearanceJoint:
    """Put a revolute joint of interface laws between two bodies: your own, or several in parallel.

    Planar bodies have a joint of their own, ten times faster.

    Args:
        mbs: system, not yet assembled.
        journal: body that carries the journal, and its centre in that body.
        bearing: the same of the bearing.
        interfaces: acting in parallel; the first one has the joint's clearance.
        axis: of the bearing, in its body's frame.
        worn: depths worn off the surfaces of planar bodies beyond the mean, which is in the
            clearance of the interfaces.
        bearing_turned: angle of the frame in which grooves have their angles, in that of the
            bearing's body, rad.

    Returns:
        The joint; `add_joint_sensor` records it.

    Raises:
        InputError: as `add_dry_revolute`, or a joint that is worn or has grooves is not between
            planar bodies, or is both.
    """
    _check_laws(mbs)
    if in_plane(mbs, journal) and in_plane(mbs, bearing):
        if tuple(axis) != (0, 0, 1):
            raise InputError(f"axis = {tuple(axis)}: allowed between planar bodies is (0, 0, 1)")
        ends = planar_end(mbs, journal), planar_end(mbs, bearing)
        if any(interface.is_oriented for interface in interfaces):
            from exu_press.joints.oriented import OrientedJoint

            if worn is not None:
                raise InputError("worn: allowed is a bearing without grooves (film.law)")
            return _add_joint(mbs, OrientedJoint(*ends, interfaces, bearing_turned))
        if worn is None:
            return _add_joint(mbs, PlanarJoint(*ends, interfaces))
        from exu_press.joints.worn import WornJoint

        return _add_joint(mbs, WornJoint(*ends, interfaces, worn))
    if worn is not None:
        raise InputError("worn: allowed is a joint between planar bodies")
    if any(interface.is_oriented for interface in interfaces):
        raise InputError("film.law = 'grooved': allowed is a joint between rigid bodies")
    in_space = spatial_end(mbs, journal), spatial_end(mbs, bearing)
    return _add_joint(mbs, SpatialRevolute(*in_space, axis, interfaces))
