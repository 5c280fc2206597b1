"""What a scene makes of a drawn mechanism: kinds of joints, guides, parts left out."""

import math

import numpy as np
import pytest

from exu_press import Scene
from exu_press.mechanism import GROUND
from exu_press.scene import mechanism_of

IDEAL = {"joints": {}}
SLIDING = {"slide", "plunger_left", "plunger_right", "slider", "counterweight"}


def press(**scene):
    return mechanism_of(Scene.from_dict({"mechanism": "press", **scene}))


def test_stiffness_and_damping_as_documented():
    """Lateral k; tilting k L^2 / 12; damping 2 D sqrt(k m) of the guided body, unless given."""
    table = {"lateral_stiffness": 3e8, "length": 0.6, "damping_ratio": 0.1}
    mechanism = press(guide=table)
    assert {guide.body for guide in mechanism.guides} == SLIDING
    assert not any(guide.lateral or guide.tilting for guide in press().guides)
    bodies = {body.name: body for body in mechanism.bodies}
    for guide in mechanism.guides:
        body = bodies[guide.body]
        assert guide.lateral.stiffness == 3e8
        assert guide.tilting.stiffness == pytest.approx(3e8 * 0.6**2 / 12)
        assert guide.lateral.damping == pytest.approx(0.2 * math.sqrt(3e8 * body.mass))
        assert guide.tilting.damping == pytest.approx(
            0.2 * math.sqrt(guide.tilting.stiffness * body.inertia)
        )
    given = {"lateral_stiffness": 1e9, "tilting_stiffness": 1e6, "tilting_damping": 7.0}
    for guide in press(guide=given).guides:
        assert (guide.tilting.stiffness, guide.tilting.damping) == (1e6, 7.0)


def test_inertia_of_a_steel_cube_unless_given():
    """m a^2 / 6 with a^3 = m / 7850; a plunger keeps its rod's inertia."""
    bodies = {
        body.name: body
        for body in press(guide={"lateral_stiffness": 1e9}, press={"slide_inertia": 0.5}).bodies
    }
    assert bodies["slide"].inertia == 0.5
    side = (1347.0 / 7850.0) ** (1 / 3)
    assert bodies["slider"].inertia == pytest.approx(1347.0 * side**2 / 6)
    assert bodies["plunger_left"].inertia == pytest.approx(155.3 * 0.55**2 / 12)


def test_without_counterweight_its_bodies_joints_and_guide_are_gone():
    full, bare = press(**IDEAL), press(**IDEAL, press={"counterweight": False})
    names = {body.name for body in full.bodies} - {body.name for body in bare.bodies}
    joints = {joint.name for joint in full.joints} - {joint.name for joint in bare.joints}
    assert names == {"counter_linkage", "counterweight"}
    assert joints == {"counter_pin", "counterweight_pin"}
    assert len(full.guides) - len(bare.guides) == 1
    used = {body for joint in bare.joints for body in (joint.journal, joint.bearing)} - {GROUND}
    assert used == {body.name for body in bare.bodies} == set(bare.motion(np.zeros(1), 1.0))
