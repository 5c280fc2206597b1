"""Mechanisms: bodies, joints, guides and their closed-form ideal motion."""

import numpy as np

from exu_press.errors import InputError
from exu_press.mechanism.description import GROUND, Body, Guide, Joint, Mechanism, Point, Spring
from exu_press.mechanism.kinematics import AssemblyError, Motion
from exu_press.mechanism.press import GROUPS, press
from exu_press.mechanism.slider_crank import slider_crank
from exu_press.scene import Scene

__all__ = [
    "GROUND",
    "Body",
    "Guide",
    "Joint",
    "Mechanism",
    "Motion",
    "Point",
    "Spring",
    "checked_assembly",
    "mechanism_of",
]


def mechanism_of(scene: Scene) -> Mechanism:
    """Return the mechanism of a scene."""
    if scene.press is not None:
        kinds = {scene.joints[name].kind for name in GROUPS["balls"]} if scene.joints else set()
        return press(scene.press, scene.guide, ideal_balls=kinds <= {"ideal"})
    assert scene.slider_crank is not None
    return slider_crank(scene.slider_crank, scene.guide)


def checked_assembly(scene: Scene) -> Mechanism:
    """Return the mechanism; InputError where it cannot be assembled at every crank angle."""
    degrees = np.arange(0.0, 360.0, 0.5)
    try:
        mechanism = mechanism_of(scene)
        mechanism.motion(np.radians(degrees), 1.0)
    except AssemblyError as error:
        angle = 180.0 if error.index is None else degrees[error.index]
        raise InputError(f"{error} m at crank angle {angle:g} deg") from None
    return mechanism
