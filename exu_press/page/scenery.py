"""The mechanism as the page draws it: outlines of bodies, guides, pivots, joints, dead centres."""

from typing import Any

from exu_press.mechanism import Joint, Mechanism
from exu_press.mechanism.parts import GROUND
from exu_press.mechanism.pitch_circles import pitch_circles
from exu_press.mechanism.shapes import FrontView
from exu_press.mechanism.spring_motion import spring_ends
from exu_press.mechanism.springs import HALF_WIDTH, SpringBetween
from exu_press.numerics.arrays import Array
from exu_press.plots.busiest import busiest
from exu_press.plots.words import joint_in_words
from exu_press.result import Result
from exu_press.scene import mechanism_of

__all__ = ["MAGNIFIED", "scenery"]

MAGNIFIED = 2
"""Joints that are magnified side by side; each can be any joint with clearance."""


def scenery(result: Result) -> dict[str, Any]:
    """Return everything that is drawn of a run's mechanism, lengths in m, poses aside."""
    mechanism = mechanism_of(result.scene)
    front = FrontView(mechanism)
    bodies = [
        {
            "name": name,
            "label": _label(name),
            "outline": _round_points(shape.outline),
            "slots": [_round_points(slot) for slot in shape.slots],
            "colour": shape.colour,
            "layer": front.layer(name),
        }
        for name, shape in front.shapes.items()
    ]
    return {
        "name": mechanism.name,
        "unit": front.unit,
        "box": [*front.low.tolist(), *front.high.tolist()],
        "bodies": bodies,
        "joints": [_joint(result, mechanism, joint) for joint in mechanism.joints],
        "magnified": _joints_to_magnify(result),
        "rails": [_round_points(rail) for rail in front.rails()],
        "wheels": [_round_points(outline) for outline in pitch_circles(mechanism)],
        "springs": [_spring(mechanism, spring, front.unit) for spring in mechanism.springs],
        "pivots": [[*map(float, joint.at)] for joint in mechanism.joints if joint.on_frame],
        "ends": [
            {
                "label": mark.label,
                "at": [*map(float, mark.position)],
                "aside": [*map(float, mark.direction)],
                "above": mark.is_above,
            }
            for mark in front.dead_centres()
        ],
        "revolution": 60.0 / result.scene.speed_rpm,
    }


def _label(body: str) -> str:
    """Return a body's name as it stands beside it; "" where the other side has it."""
    if body.endswith("_left"):
        return ""
    label = joint_in_words(body.removesuffix("_right"))
    return label[:1].lower() + label[1:]


def _joint(result: Result, mechanism: Mechanism, joint: Joint) -> dict[str, Any]:
    """Return a joint's place and properties; the force of an ideal one may not be determined."""
    record = result.joints.get(joint.name)
    (body, point), (bearing, bearing_point) = mechanism.ends(joint)
    if body == GROUND:
        body, point = bearing, bearing_point
    return {
        "name": joint.name,
        "label": joint_in_words(joint.name),
        "body": [mechanism_body.name for mechanism_body in mechanism.bodies].index(body),
        "turns": joint.journal != GROUND,
        "at": [*map(float, point)],
        "kind": result.scene.joints[joint.name].kind,
        "ball": joint.spherical,
        "clearance": 0.0 if record is None else float(record.clearance),
    }


def _spring(mechanism: Mechanism, spring: SpringBetween, size: float) -> dict[str, Any]:
    """Return a spring's ends, by the index of their body, -1 of the frame, and its picture.

    Points of the picture are a share of the length and a distance across, m.
    """
    names = [body.name for body in mechanism.bodies]
    return {
        "name": spring.name,
        "ends": [
            {"body": -1 if body == GROUND else names.index(body), "at": [*map(float, point)]}
            for body, point in spring_ends(mechanism, spring)
        ],
        "symbol": [[share, across * HALF_WIDTH * size] for share, across in spring.symbol],
    }


def _joints_to_magnify(result: Result) -> list[str]:
    """Return the joints that are magnified first: those with the largest forces."""
    loose = sorted(result.clearance_joints, key=lambda name: (result.joints[name].spherical, name))
    return list(busiest([result], loose, "eccentricity", MAGNIFIED)[0])


def _round_points(points: Array) -> list[list[float]]:
    """Return points to a hundredth of a millimetre."""
    return [[round(float(x), 5), round(float(y), 5)] for x, y in points]
