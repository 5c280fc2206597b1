"""The joints for anybody's Exudyn system: two bodies, two points, and the laws between them."""

from collections.abc import Sequence

import exudyn as exu

from exu_press.errors import InputError
from exu_press.joints.overlay import overlay_of
from exu_press.joints.pairs import DryPair, FilmPair, Pair
from exu_press.joints.planar import PlanarEnd, PlanarJoint
from exu_press.laws.contact import NormalContact
from exu_press.laws.film import FilmLaw, film_scale
from exu_press.laws.friction import Friction, LuGre, no_friction

__all__ = ["add_dry_revolute", "add_dry_spherical", "add_lubricated_revolute"]

BodyPoint = tuple[int, Sequence[float]]


def add_dry_revolute(
    mbs: exu.MainSystem,
    journal: BodyPoint,
    bearing: BodyPoint,
    *,
    radius: float,
    clearance: float,
    contact: NormalContact,
    friction: Friction | LuGre,
) -> PlanarJoint:
    """Put a dry revolute joint with clearance between two bodies (spec 2, Eqs. 7-11, 23-33).

    Args:
        mbs: system, not yet assembled.
        journal: object number of the body that carries the journal, and its centre there, m.
        bearing: the same of the bearing.
        radius: radius of the journal, m.
        clearance: radius of the bearing minus that of the journal, m.
        contact: normal contact law.
        friction: friction law.

    Returns:
        The joint, whose `state` tells what it does in a state of the two bodies.
    """
    return _add(mbs, journal, bearing, [DryPair(contact, friction, radius, clearance)])


def add_dry_spherical(
    mbs: exu.MainSystem,
    ball: BodyPoint,
    socket: BodyPoint,
    *,
    radius: float,
    clearance: float,
    contact: NormalContact,
    friction: Friction | LuGre,
) -> PlanarJoint:
    """Put a dry spherical joint with clearance between two bodies (spec 4, Eqs. 12-22).

    Between planar bodies ball and socket touch in the plane, like a journal and its bearing.

    Args:
        mbs: system, not yet assembled.
        ball: object number of the body that carries the ball, and its centre there, m.
        socket: the same of the socket.
        radius: radius of the ball, m.
        clearance: radius of the socket minus that of the ball, m.
        contact: normal contact law.
        friction: friction law.
    """
    return _add(mbs, ball, socket, [DryPair(contact, friction, radius, clearance)])


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
) -> PlanarJoint:
    """Put a lubricated revolute joint between two bodies (spec 3, Eqs. 34-35 corrected).

    With a contact law, film and contact act in parallel: pass a film law that goes on beyond an
    eccentricity ratio of 1 (`exu_press.laws.film.with_asperities`) with the same onset.

    Args:
        mbs: system, not yet assembled.
        journal: object number of the body that carries the journal, and its centre there, m.
        bearing: the same of the bearing.
        radius: radius of the journal, m.
        clearance: radius of the bearing minus that of the journal, m.
        length: length of the bearing, m.
        viscosity: dynamic viscosity, Pa s.
        law: film law.
        contact: normal contact law of the asperities and what is below them.
        friction: friction law of the contact.
        asperity_onset: gap at which the surfaces begin to touch, m.
    """
    scale = film_scale(viscosity, length, radius, clearance)
    pairs: list[Pair] = [FilmPair(law, scale, clearance)]
    if contact is not None:
        friction = no_friction() if friction is None else friction
        pairs.append(DryPair(contact, friction, radius, clearance - asperity_onset))
    return _add(mbs, journal, bearing, pairs)


def _add(
    mbs: exu.MainSystem, journal: BodyPoint, bearing: BodyPoint, pairs: Sequence[Pair]
) -> PlanarJoint:
    overlay = overlay_of(mbs)
    joint = PlanarJoint(_end(mbs, journal), _end(mbs, bearing), pairs)
    overlay.add(joint)
    return joint


def _end(mbs: exu.MainSystem, body_point: BodyPoint) -> PlanarEnd:
    """Return the planar end of a body's point."""
    body, point = body_point
    item = mbs.GetObject(body)
    along, across = float(point[0]), float(point[1])
    if item["objectType"] == "Ground":
        x, y, _ = (float(value) for value in item["referencePosition"])
        return PlanarEnd(overlay_of(mbs).index_of(None), (x, y, 0.0), (along, across))
    if item["objectType"] != "RigidBody2D":
        raise InputError(
            f"body {body} is a {item['objectType']}: allowed are RigidBody2D and Ground"
        )
    node = int(item["nodeNumber"])
    x, y, angle = (float(value) for value in mbs.GetNodeParameter(node, "referenceCoordinates"))
    return PlanarEnd(overlay_of(mbs).index_of(node), (x, y, angle), (along, across))
