"""The recorders of a run in their order, and the channels that they declare."""

from collections.abc import Iterator
from importlib import import_module
from typing import Any

from exu_press.result.channel import guide_channel
from exu_press.result.declared import NO_BRAKE, NO_CLUTCH, OWN, UNBALANCED, Declared
from exu_press.scene import Scene, mechanism_of
from exu_press.scene.applied import applied_loads
from exu_press.scene.joint import oil_of
from exu_press.scene.wearing import wearing_joints

__all__ = ["all_declared", "expected", "recorders"]

RECORDERS = (
    "slider",
    "ideal_joints",
    "joints",
    "loads",
    "guideways",
    "equilibrium",
    "guides",
    "forces",
    "flexible",
    "stress",
    "drive",
    "energy",
)
"""Modules of `exu_press.result` with `record(run)`, and with CHANNELS that they declare. Each reads
what those before it have recorded."""

OF_FLEXIBLE_BODIES = ("flexible", "stress")


def recorders(*, flexible: bool) -> Iterator[Any]:
    """Yield the modules that record a run, with or without flexible bodies."""
    for name in RECORDERS:
        if flexible or name not in OF_FLEXIBLE_BODIES:
            yield import_module(f"exu_press.result.{name}")


def all_declared(*, flexible: bool = True) -> list[Declared]:
    """Return every channel that a run, with or without flexible bodies, may have."""
    return [
        declared
        for recorder in recorders(flexible=flexible)
        for declared in getattr(recorder, "CHANNELS", ())
    ]


def expected(scene: Scene, *, own_items: bool) -> dict[str, tuple[str, bool]]:
    """Return the channels that a scene's runs may have -> their columns, and whether all have them.

    Args:
        scene: complete.
        own_items: whether the model has items of the user's own.
    """
    mechanism = mechanism_of(scene)
    joints = [joint.name for joint in mechanism.joints]
    spherical = {joint.name for joint in mechanism.joints if joint.spherical}
    places = {
        "": [""],
        "joint": joints,
        "loose": [name for name in joints if scene.joints[name].kind != "ideal"],
        "warm": [name for name in joints if oil_of(scene.joints[name]) is not None],
        "worn": [name for name in joints if scene.joints[name].worn is not None],
        "wearing": list(wearing_joints(scene)),
        "guide": [guide_channel(mechanism, guide.body) for guide in mechanism.guides],
        "load": list(applied_loads(scene)),
        "body": [body.name for body in mechanism.bodies],
        "faced": joints,
    }
    motor = scene.drive
    missing = {
        OWN: own_items,
        UNBALANCED: not mechanism.counterweight,
        NO_CLUTCH: motor is None or motor.clutch_torque is None,
        NO_BRAKE: motor is None or motor.brake_torque is None,
    }
    return {
        channel.at(place): (channel.axis_at(place, spherical=place in spherical), channel.always)
        for channel in all_declared(flexible=bool(scene.bodies))
        for place in places[channel.of]
        if not missing.get(channel.unless, False)
    }
