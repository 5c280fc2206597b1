"""The recorders in their order, and the channels that they declare."""

from collections.abc import Callable, Iterator
from importlib import import_module
from typing import Any

from exu_press.result.channel import (
    NO_BRAKE,
    NO_CLUTCH,
    OWN,
    UNBALANCED,
    Declaration,
    guide_channel,
)
from exu_press.scene import Scene, mechanism_of
from exu_press.scene.joint import has_even_gap, oil_of

__all__ = ["declared_channels", "expected_channels", "recorders"]


def _always(scene: Scene) -> bool:
    """Return True: every run has it."""
    return True


RECORDERS: dict[str, Callable[[Scene], object]] = {
    "slider": _always,
    "ideal_joints": _always,
    "joints": lambda scene: scene.joints.with_clearance,
    "loads": lambda scene: scene.load,
    "gears_and_springs": lambda scene: mechanism_of(scene).gears or mechanism_of(scene).springs,
    "guideways": lambda scene: any(guide.guideway for guide in mechanism_of(scene).guides),
    "equilibrium": _always,
    "guides": _always,
    "forces": _always,
    "flexible": lambda scene: scene.bodies,
    "stress": lambda scene: scene.bodies,
    "drive": _always,
    "energy": _always,
}
"""Module of `exu_press.result` -> whether a scene has what it records. Each has `record(run)`,
which may read channels of preceding ones, and CHANNELS that it declares."""


def recorders(scene: Scene | None = None) -> Iterator[Any]:
    """Yield the modules that record the runs of a scene, or of any scene."""
    for name, records in RECORDERS.items():
        if scene is None or records(scene):
            yield import_module(f"exu_press.result.{name}")


def declared_channels(scene: Scene | None = None) -> list[Declaration]:
    """Return every channel that the runs of a scene, or of any, may have."""
    return [
        declared for recorder in recorders(scene) for declared in getattr(recorder, "CHANNELS", ())
    ]


def _loads(scene: Scene) -> list[str]:
    """Return the names of the loads that act."""
    if not scene.load:
        return []
    return list(scene.applied_loads)


def _wearing(scene: Scene) -> list[str]:
    """Return the names of the joints whose wear is asked for."""
    if scene.wear is None:
        return []
    return list(scene.wearing["joints"])


def expected_channels(scene: Scene, *, own_items: bool) -> dict[str, tuple[str, bool]]:
    """Return the channels of a scene's runs -> their columns, and whether every run has them."""
    mechanism = mechanism_of(scene)
    joints = [joint.name for joint in mechanism.joints]
    spherical = {joint.name for joint in mechanism.joints if joint.spherical}
    owners = {
        "": [""],
        "joint": joints,
        "loose": [name for name in joints if scene.joints[name].kind != "ideal"],
        "warm": [name for name in joints if oil_of(scene.joints[name]) is not None],
        "uneven": [name for name in joints if not has_even_gap(scene.joints[name])],
        "wearing": _wearing(scene),
        "guide": [guide_channel(mechanism, guide.name) for guide in mechanism.guides],
        "gear": [gear.name for gear in mechanism.gears],
        "spring": [spring.name for spring in mechanism.springs],
        "load": _loads(scene),
        "body": [body.name for body in mechanism.bodies],
        "pivoted": joints,
        "bent": joints,
    }
    clutch = None if scene.drive is None else scene.drive.clutch
    missing = {
        OWN: own_items,
        UNBALANCED: not mechanism.counterweight,
        NO_CLUTCH: clutch is None,
        NO_BRAKE: clutch is None or clutch.brake is None,
    }
    return {
        declared.name_of(owner): (
            declared.axis_of(owner, spherical=owner in spherical),
            declared.always,
        )
        for declared in declared_channels(scene)
        for owner in owners[declared.owner]
        if not missing.get(declared.unless, False)
    }
