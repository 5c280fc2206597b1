"""The laws that a scene asks for; parameters outside a law's range are refused by name."""

import math
from collections.abc import Callable

from exu_press.errors import InputError, prefixed
from exu_press.laws.catalogue import FILM_LAWS
from exu_press.laws.contact import (
    DAMPING_LAWS,
    NormalContact,
    Stiffness,
    cylindrical,
    hertz,
    hertz_stiffness,
)
from exu_press.laws.film.asperities import with_asperities
from exu_press.laws.film.ball import BallFilm, ball
from exu_press.laws.film.contract import FilmLaw, film_scale
from exu_press.laws.friction import Friction as FrictionLaw
from exu_press.laws.friction import LuGre, coulomb, lugre_steady, no_friction, stribeck
from exu_press.scene.joint import DryJoint, LubricatedJoint
from exu_press.scene.tables import (
    OF_FRICTION,
    Contact,
    ElasticGuide,
    Film,
    Friction,
    asperity_onset,
)

__all__ = [
    "ball_film",
    "contact_law",
    "film_law",
    "film_scale_of",
    "friction_law",
    "guide_contact_law",
    "guide_friction_law",
    "slowest_impact",
]


def contact_law(
    joint: DryJoint | LubricatedJoint, *, revolute: bool, crank_speed: float
) -> NormalContact:
    """Return the normal contact of a joint that has one; only a revolute one can be cylindrical.

    Args:
        joint: complete, as a scene has it.
        revolute: whether the joint is a journal in a bearing.
        crank_speed: rad/s.
    """
    table, clearance, radius = joint.contact, joint.clearance, joint.radius
    assert table is not None
    if table.shape == "cylindrical" and revolute:
        length = joint.film.length if isinstance(joint, LubricatedJoint) else None
        length = length if table.length is None else table.length
        assert length is not None
        stiffness = cylindrical(table.modulus, length, clearance)
    elif table.stiffness is None:  # 1 / R = 1 / radius - 1 / (radius + clearance)
        curvature_radius = radius * (radius + clearance) / clearance
        stiffness = hertz(hertz_stiffness(curvature_radius, table.modulus), table.exponent)
    else:
        stiffness = hertz(table.stiffness, table.exponent)
    return _damped(table, stiffness, slowest_impact(table, clearance, crank_speed))


def slowest_impact(table: Contact, clearance: float, crank_speed: float) -> float:
    """Return the speed, m/s, as which contacts that begin slower are damped.

    Unless given, the speed of a journal that follows a load around its bearing as the crank (rad/s)
    turns: above that of the penetration of a lasting contact, and below that of impacts.
    """
    return table.slowest_impact or crank_speed * clearance


def _damped(table: Contact, stiffness: Stiffness, slowest: float) -> NormalContact:
    """Return the normal contact with an elastic part and the damping of [contact]."""
    parameters: dict[str, float]
    if table.damping == "step":
        assert table.damping_max is not None and table.damping_depth is not None
        parameters = {"damping_max": table.damping_max, "damping_depth": table.damping_depth}
    else:
        parameters = {"restitution": table.restitution, "slowest_impact": slowest}
    law = DAMPING_LAWS[table.damping]
    with prefixed("contact."):
        return law(stiffness, tension=table.tension, **parameters)


def friction_law(table: Friction) -> FrictionLaw | LuGre:
    """Return the friction law of a joint; a bristle belongs to one joint alone."""
    coefficients = (table.mu_static, table.mu_kinetic)
    curve = (table.stribeck_velocity, table.stribeck_exponent)
    soft = table.regularisation_velocity
    laws: dict[str, Callable[[], FrictionLaw | LuGre]] = {
        "none": no_friction,
        "coulomb": lambda: coulomb(table.mu_kinetic, soft),
        "stribeck": lambda: stribeck(*coefficients, *curve, soft, table.sigma_2),
        "lugre_steady": lambda: lugre_steady(*coefficients, table.sigma_2, *curve, soft),
        "lugre": lambda: LuGre(*coefficients, table.sigma_0, table.sigma_1, table.sigma_2, *curve),
    }
    with prefixed("friction."):
        return laws[table.law]()


def guide_contact_law(
    contact: Contact, stiffness: float, clearance: float, crank_speed: float
) -> NormalContact:
    """Return the normal contact of a guided body's end with its guideways.

    Args:
        contact: [contact] of the scene, whose damping it has.
        stiffness: of the end, N/m; the force is linear in the penetration.
        clearance: on each side, m.
        crank_speed: rad/s.
    """
    slowest = slowest_impact(contact, clearance, crank_speed)
    return _damped(contact, hertz(stiffness, 1.0), slowest)


def guide_friction_law(guide: ElasticGuide, friction: Friction | None) -> FrictionLaw | LuGre:
    """Return the friction law of the guides; keys that [guide] lacks are those of [friction]."""
    friction = friction or Friction()
    keys = Friction.uses["law"][guide.friction]
    own = {key: getattr(guide, key) for key in keys if key in OF_FRICTION}
    other = {key: getattr(friction, key) for key in keys if key not in OF_FRICTION}
    return friction_law(Friction(law=guide.friction, **own, **other))


def film_law(table: Film, radius: float, clearance: float) -> FilmLaw:
    """Return a joint's film law, going on beyond contact where that is asked for.

    Args:
        table: film of the joint.
        radius: radius of the journal or ball, m.
        clearance: radial clearance, m.
    """
    if table.length is None:
        return ball_film(table, clearance).law
    ratio = table.length / (2.0 * radius)
    with prefixed("film."):
        law = FILM_LAWS[table.law].factory(ratio)
    onset = _onset_ratio(table, clearance)
    return law if onset is None else with_asperities(law, onset)


def ball_film(table: Film, clearance: float) -> BallFilm:
    """Return the film of a ball in its socket; arguments as those of `film_law`."""
    onset = _onset_ratio(table, clearance)
    with prefixed("film."):
        return ball(math.radians(table.socket_angle_deg), onset)


def film_scale_of(joint: LubricatedJoint) -> float:
    """Return the scale P of a joint's film, N s; a ball is as long as its radius."""
    length = joint.radius if joint.film.length is None else joint.film.length
    return film_scale(joint.film.cold_viscosity, length, joint.radius, joint.clearance)


def _onset_ratio(table: Film, clearance: float) -> float | None:
    """Return the gap at which asperities touch, over the clearance; None for a film alone."""
    onset = asperity_onset(table)
    if onset is not None and onset >= clearance:
        raise InputError(
            f"film.roughness * film.asperity_onset = {onset:g}: allowed is a number < "
            f"clearance = {clearance:g}"
        )
    return None if onset is None else onset / clearance
