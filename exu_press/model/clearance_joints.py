"""The joints of a system with clearance."""

from typing import TYPE_CHECKING, Any

from exu_press.joints.add import add_dry_spherical, add_lubricated_spherical, add_revolute
from exu_press.joints.interface import DryInterface, FilmInterface, InterfaceLaw
from exu_press.joints.joint import ClearanceJoint
from exu_press.laws.friction import no_friction
from exu_press.mechanism import Joint
from exu_press.model.system import System
from exu_press.scene import LubricatedJoint, Scene
from exu_press.scene.film import BallFilm
from exu_press.scene.joint import CustomJoint, TouchingJoint, unworn
from exu_press.scene.joint import Joint as SceneJoint

if TYPE_CHECKING:
    from exu_press.joints.worn import WornSurfaces

__all__ = ["add_clearance_joint", "interfaces_of"]


def add_clearance_joint(system: System, joint: Joint, kind: SceneJoint) -> ClearanceJoint:
    """Add a joint with clearance."""
    journal, bearing = (system.end(*end, joint) for end in system.mechanism.ends(joint))
    if not joint.spherical or not isinstance(kind, TouchingJoint):
        worn = _worn_surfaces(system, joint, kind)
        interfaces = interfaces_of(kind, system.scene)
        turned = system.frame_angle(joint.bearing)
        return add_revolute(
            system.mbs, journal, bearing, interfaces, worn=worn, bearing_turned=turned
        )
    speed = system.scene.angular_speed
    surfaces: dict[str, Any] = {
        "radius": kind.radius,
        "clearance": kind.clearance,
        "contact": kind.normal_contact(speed),
        "friction": no_friction() if kind.friction is None else kind.friction.friction(),
    }
    if not isinstance(kind, LubricatedJoint):
        return add_dry_spherical(system.mbs, journal, bearing, **surfaces)
    assert isinstance(kind.film, BallFilm)
    return add_lubricated_spherical(
        system.mbs,
        journal,
        bearing,
        viscosity=kind.film.cold_viscosity,
        film=kind.film.ball_film(kind.clearance),
        asperity_onset=kind.onset or 0.0,
        **surfaces,
    )


def interfaces_of(kind: SceneJoint, scene: Scene) -> list[InterfaceLaw]:
    """Return the interface laws of a joint with clearance, in its plane."""
    if isinstance(kind, CustomJoint):
        return list(kind.interfaces())
    assert isinstance(kind, TouchingJoint)
    kind = unworn(kind)
    interfaces: list[InterfaceLaw] = []
    if isinstance(kind, LubricatedJoint):
        interfaces.append(_film_interface(kind))
    contact = kind.normal_contact(scene.angular_speed)
    if contact is not None:
        friction = no_friction() if kind.friction is None else kind.friction.friction()
        reach = kind.clearance - (kind.onset or 0.0)
        interfaces.append(DryInterface(contact, friction, kind.radius, reach))
    return interfaces


def _film_interface(kind: LubricatedJoint) -> FilmInterface:
    """Return the interface of a film; one with grooves has its table, unless it is inclined."""
    law, sizes = kind.film_law(), (kind.film_scale, kind.clearance)
    if not kind.film.law.is_oriented:
        return FilmInterface(law, *sizes)
    from exu_press.joints.oriented import (
        GroovedInterface,
        PressurizedInterface,
        TiltedInterface,
    )
    from exu_press.laws.film.grooved_table import GroovedFilm
    from exu_press.laws.film.pressurized import PressurizedFilm
    from exu_press.laws.film.tilted import TiltedFilm
    from exu_press.model.film_tables import film_table, supply_table

    if isinstance(law, TiltedFilm):
        return TiltedInterface(law, *sizes)
    assert isinstance(law, GroovedFilm)
    law.set_table(film_table(law.bearing))
    if not isinstance(law, PressurizedFilm):
        return GroovedInterface(law, *sizes)
    assert kind.film.length is not None
    law.set_supply_table(supply_table(law.bearing))
    force = kind.film.law.supply_pressure * kind.film.length * kind.radius
    return PressurizedInterface(law, *sizes, force)


def _worn_surfaces(system: System, joint: Joint, kind: SceneJoint) -> "WornSurfaces | None":
    """Return the wear of a joint's surfaces beyond an even clearance, or None."""
    profiles = None if kind.worn is None else kind.worn.profiles()
    if profiles is None:
        return None
    from exu_press.joints.worn import WornSurfaces

    angles = map(system.frame_angle, (joint.journal, joint.bearing))
    return WornSurfaces(*profiles, *angles)
