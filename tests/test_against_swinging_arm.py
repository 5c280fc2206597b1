"""A slide and a slot with clearance between moving bodies, against an independent model of both."""

import math
from dataclasses import replace

import numpy as np
import pytest
from independent.swinging_arm import SwingingArm
from refused import refused

from exu_press import Scene, simulate
from exu_press.mechanism import Guide, shipped_mechanism

SLIDE = shipped_mechanism("inverted_slider_crank")
SLOT = replace(
    SLIDE,
    bodies=(SLIDE.body("crank"), SLIDE.body("arm")),
    joints=tuple(joint for joint in SLIDE.joints if joint.name != "crank_pin"),
    guides=(Guide("slot", body="crank", on="arm", at=(0.0, 0.05)),),
)
GUIDE = {
    "clearance": 1e-4,
    "lateral_stiffness": 2e6,
    "length": 0.04,
    "width": 0.02,
    "friction": "coulomb",
    "mu_kinetic": 0.15,
    "regularisation_velocity": 0.1,
}
DAMPING = {"damping": "step", "damping_max": 200.0, "damping_depth": 1e-5}


def run(mechanism, revolutions, **guide):
    return simulate(
        Scene(
            mechanism=mechanism,
            revolutions=revolutions,
            guide={**GUIDE, **guide},
            contact=DAMPING,
        )
    )


def independent(**block):
    arm = SLIDE.body("arm")
    centre = complex(*arm.centre_of_mass) - complex(0.03, -0.15)
    return SwingingArm(
        speed=8.0 * math.pi,
        crank=0.05,
        pivot=complex(0.03, -0.15),
        inertia=arm.inertia + arm.mass * abs(centre) ** 2,
        mass=arm.mass,
        centre=centre,
        clearance=GUIDE["clearance"],
        stiffness=GUIDE["lateral_stiffness"],
        damping=DAMPING["damping_max"],
        depth=DAMPING["damping_depth"],
        friction=GUIDE["mu_kinetic"],
        slow=GUIDE["regularisation_velocity"],
        lever=0.5 * GUIDE["width"],
        **block,
    )


BLOCK = {"block_inertia": SLIDE.body("block").inertia, "block_length": GUIDE["length"]}


@pytest.mark.validation(
    "independent",
    "arm that a crank swings, with a clearance of 0.1 mm where its pin slides",
    "the arm's angle, and the block's, own laws, SciPy's LSODA (`tests/independent/`)",
    "this package's",
)
@pytest.mark.parametrize(
    ("mechanism", "block"), [(SLOT, {}), (SLIDE, BLOCK)], ids=["pin in a slot", "block on a slide"]
)
def test_the_arm_swings_as_in_an_independent_model(mechanism, block, compare):
    result = run(mechanism, 0.1)
    expected = independent(**block).angles(result.time)
    play = GUIDE["clearance"] / 0.15
    ideal = mechanism.ideal_slider(result["crank_angle"], 1.0)[0]
    assert np.abs(ideal - expected).max() > 0.8 * play
    name = f"angle of the arm, {'block on a slide' if block else 'pin in a slot'}, over the play"
    ours = result["slider_position"]
    compare(name, expected, ours, error=None, rel=1e-3, scale=play, unit="rad")


@pytest.mark.parametrize("mechanism", [SLOT, pytest.param(SLIDE, marks=pytest.mark.long)])
def test_the_motion_tends_to_the_ideal_one_as_the_clearance_vanishes(mechanism):
    away = []
    for clearance in (1e-4, 1e-5):
        result = run(mechanism, 0.05, clearance=clearance)
        ideal = mechanism.ideal_slider(result["crank_angle"], 1.0)[0]
        away.append(np.abs(result["slider_position"] - ideal).max())
        weight = 9.81 * sum(body.mass for body in mechanism.bodies)
        shaking = result["shaking_force"] - np.array([0.0, weight])
        assert result["frame_force"] == pytest.approx(shaking, abs=1e-6 * np.abs(shaking).max())
        assert result.quantity("energy.residual").value < 1e-4
    assert away[1] < 0.2 * away[0]


def test_a_slot_with_oil_is_refused():
    oil = {**GUIDE, "viscosity": 0.1, "face_width": 0.02, "contact_gap": 1e-6}
    message = refused(Scene, mechanism=SLOT, guide=oil, contact=DAMPING)
    assert message.startswith("guide.viscosity: slots.slot holds a pin, which has no face")
