"""Guideways with clearance: contacts of both ends of a body, and a film between them."""

from typing import Any

import numpy as np

from exu_press.joints.add import (
    add_guideway_contact,
    add_guideway_film,
    add_moving_guideway_contact,
)
from exu_press.joints.joint import ClearanceJoint
from exu_press.laws.contact import hertz
from exu_press.laws.friction import no_friction
from exu_press.mechanism import Body, Guide, Guideway
from exu_press.model.system import System

__all__ = ["add_guideways"]


def add_guideways(system: System, guide: Guide, guideway: Guideway) -> tuple[ClearanceJoint, ...]:
    """Add the contacts of both ends of a body with its guideways, and the film if there is one."""
    scene = system.scene
    table = scene.guides[guide.name]
    contact, oil = table.contact, table.oil
    assert contact is not None
    body = system.mechanism.body(guide.body)
    along = np.array(guide.direction)
    middle = np.array(system.mechanism.guided_point(guide))
    points = (middle + 0.5 * side * guideway.length * along for side in (-1.0, 1.0))
    guided, _ = system.in_guide(guide)
    ends = [system.end(guided, body.local((float(x), float(y)))) for x, y in points]
    onset = 0.0 if oil is None else oil.contact_gap
    elastic = hertz(guideway.stiffness, 1.0)
    laws: dict[str, Any] = {
        "contact": contact.normal_contact(elastic, guideway.clearance, scene.angular_speed),
        "friction": no_friction() if table.rubbing is None else table.rubbing.friction(),
        "clearance": guideway.clearance - onset,
        "half_width": guideway.half_width,
    }
    on, at, direction = None, body.centre_of_mass, guide.direction
    if guide.is_rail:
        contacts = [
            add_guideway_contact(system.mbs, end, middle=at, direction=direction, **laws)
            for end in ends
        ]
    else:
        contacts = [
            _add_moving(system, guide, end, **laws) for end in (ends[:1] if guide.is_slot else ends)
        ]
    if oil is None:
        return tuple(contacts)
    if not guide.is_rail:
        base = system.mechanism.body(guide.on)
        on, at = system.bodies[system.in_guide(guide)[1]], base.local(at)
        direction = Body("", 0.0, angle=base.angle).local(direction)
    film = add_guideway_film(
        system.mbs,
        *ends,
        middle=at,
        direction=direction,
        on=on,
        clearance=guideway.clearance,
        length=guideway.length,
        face_width=oil.face_width,
        viscosity=oil.viscosity,
        asperity_onset=onset,
        half_width=guideway.half_width,
    )
    return (*contacts, film)


def _add_moving(system: System, guide: Guide, end: Any, **laws: Any) -> ClearanceJoint:
    """Add the contact of a point with the walls of a moving guide, or of a slot."""
    _, on = system.in_guide(guide)
    line, angle = system.mechanism.line_of(guide)
    return add_moving_guideway_contact(
        system.mbs,
        end,
        system.end(on, line),
        across=angle + system.frame_angle(on),
        radius=guide.radius,
        **laws,
    )
