"""The symmetric two-point knuckle press of the paper (section 2, Fig. 1, Table 2)."""

import math

from exu_press.mechanism.description import GROUND, Body, Joint, Mechanism
from exu_press.mechanism.guides import free_to_tilt, guide_of
from exu_press.mechanism.kinematics import (
    Array,
    AssemblyError,
    Motion,
    along,
    dyad,
    fixed,
    guided,
    rod,
    rotating,
    sliding,
    turning,
)
from exu_press.scene.tables import ElasticGuide, Press

__all__ = ["press"]

SIDES = {"right": 1, "left": -1}

GROUPS = {
    "balls": ("ball_left", "ball_right"),
    "knuckles": ("knuckle_6_left", "knuckle_6_right", "knuckle_7_left", "knuckle_7_right"),
    "pivots": ("pivot_left", "pivot_right"),
    "plunger_pins": ("plunger_pin_left", "plunger_pin_right"),
    "slide_joints": ("slide_joint_left", "slide_joint_right"),
}


def press(
    size: Press, elastic: ElasticGuide | None = None, *, ideal_balls: bool = True
) -> Mechanism:
    """Return the press; the linkage carries the bearing of the crank pin, the slider the sockets.

    With ideal balls and ideal guides the two balls hold the slider's angle, otherwise its guide
    does (A-9).
    """
    offset, half_plunger = size.crank_mass_offset, size.plunger_length / 2
    if size.link_5_length <= size.pivot_distance:
        short = f"press.link_5_length = {size.link_5_length:g}: needs > {size.pivot_distance:g}"
        raise AssemblyError(short)
    bottom = -size.crank_radius - size.linkage_length
    drop = math.sqrt(size.link_5_length**2 - size.pivot_distance**2)
    pivot_y = bottom - drop + size.link_6_length  # knuckle stretched at bottom dead centre
    slider_bottom = bottom - drop - size.link_7_length - size.plunger_length

    def motion(angle: Array, speed: float) -> dict[str, Motion]:
        pin = rotating(angle, speed, size.crank_radius)
        slide = guided("press.linkage_length", pin, size.linkage_length, 0.0, -1)
        bodies = {
            "crank": turning(angle, speed, offset),
            "linkage": along(rod(pin, slide), size.linkage_mass_offset),
            "slide": sliding(slide),
        }
        if size.counterweight:
            counter_pin = rotating(angle, speed, -size.counter_eccentricity)
            counterweight = guided(
                "press.counter_linkage_length", counter_pin, size.counter_linkage_length, 0.0, +1
            )
            bodies["counter_linkage"] = rod(counter_pin, counterweight)
            bodies["counterweight"] = sliding(counterweight)
        for side, sign in SIDES.items():
            pivot = fixed(sign * size.pivot_distance, pivot_y, len(angle))
            knuckle = dyad(
                "press.link_5_length, link_6_length",
                slide,
                size.link_5_length,
                pivot,
                size.link_6_length,
                -sign,
            )
            foot = guided(
                "press.link_7_length",
                knuckle,
                size.link_7_length,
                sign * size.pivot_distance,
                -1,
            )
            bodies[f"link_5_{side}"] = rod(slide, knuckle)
            bodies[f"link_6_{side}"] = rod(pivot, knuckle)
            bodies[f"link_7_{side}"] = rod(knuckle, foot)
            bodies[f"plunger_{side}"] = sliding(foot.shifted((0.0, -half_plunger)))
        ball = foot.shifted((-sign * size.pivot_distance, -size.plunger_length))
        bodies["slider"] = sliding(ball)
        return bodies

    shift = size.linkage_mass_offset
    rod_inertia = size.linkage_mass * size.linkage_length**2 / 12
    bodies = [
        Body("crank", size.crank_mass, size.crank_mass * size.crank_radius**2 / 12),
        Body("linkage", size.linkage_mass, size.linkage_inertia or rod_inertia),
        free_to_tilt(_held("slide", size.slide_mass), elastic),
    ]
    crank_tip, linkage_end = (0.0, size.crank_radius - offset), size.linkage_length / 2
    joints = [
        Joint("shaft", "crank", (0.0, -offset), GROUND, (0.0, 0.0)),
        Joint("crank_pin", "crank", crank_tip, "linkage", (-linkage_end - shift, 0.0)),
        Joint("slide_pin", "linkage", (linkage_end - shift, 0.0), "slide", (0.0, 0.0)),
    ]
    guides = [guide_of(bodies[-1], elastic)]
    for side, sign in SIDES.items():
        x = sign * size.pivot_distance
        end_5, end_6, end_7 = size.link_5_length / 2, size.link_6_length / 2, size.link_7_length / 2
        link_5, link_6, link_7 = f"link_5_{side}", f"link_6_{side}", f"link_7_{side}"
        plunger = f"plunger_{side}"
        bodies += [
            _rod(link_5, size.link_5_mass, size.link_5_length),
            _rod(link_6, size.link_6_mass, size.link_6_length),
            _rod(link_7, size.link_7_mass, size.link_7_length),
            _rod(plunger, size.plunger_mass, size.plunger_length),
        ]
        guides.append(guide_of(bodies[-1], elastic))
        joints += [
            Joint(f"slide_joint_{side}", link_5, (-end_5, 0.0), "slide", (0.0, 0.0)),
            Joint(f"pivot_{side}", link_6, (-end_6, 0.0), GROUND, (x, pivot_y)),
            Joint(f"knuckle_6_{side}", link_6, (end_6, 0.0), link_5, (end_5, 0.0)),
            Joint(f"knuckle_7_{side}", link_7, (-end_7, 0.0), link_5, (end_5, 0.0)),
            Joint(f"plunger_pin_{side}", link_7, (end_7, 0.0), plunger, (0.0, half_plunger)),
            Joint(
                f"ball_{side}",
                plunger,
                (0.0, -half_plunger),
                "slider",
                (x, 0.0),
                spherical=True,
                vertical_only=elastic is None,
            ),
        ]
    slider = _rod("slider", size.slider_mass, 2 * size.pivot_distance)
    bodies.append(free_to_tilt(slider, elastic))
    guides.append(guide_of(bodies[-1], elastic, holds_angle=not ideal_balls))
    if size.counterweight:
        counter_end = size.counter_linkage_length / 2
        counter_tip = (0.0, -size.counter_eccentricity - offset)
        bodies += [
            _rod("counter_linkage", size.counter_linkage_mass, size.counter_linkage_length),
            free_to_tilt(_held("counterweight", size.counterweight_mass), elastic),
        ]
        joints += [
            Joint("counter_pin", "crank", counter_tip, "counter_linkage", (-counter_end, 0.0)),
            Joint(
                "counterweight_pin",
                "counter_linkage",
                (counter_end, 0.0),
                "counterweight",
                (0.0, 0.0),
            ),
        ]
        guides.append(guide_of(bodies[-1], elastic))
    return Mechanism(
        bodies=tuple(bodies),
        joints=tuple(joints),
        guides=tuple(guides),
        crank="crank",
        slider="slider",
        slider_origin=slider_bottom - size.bottom_dead_centre,
        motion=motion,
        groups=GROUPS,
    )


def _rod(name: str, mass: float, length: float) -> Body:
    """Return a uniform rod (A-6)."""
    return Body(name, mass, mass * length**2 / 12)


def _held(name: str, mass: float) -> Body:
    """Return a body whose angle an ideal guide holds, so that its inertia does not matter."""
    return Body(name, mass, mass)
