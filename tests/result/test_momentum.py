"""Shaking force and what the frame carries: three ways to the same forces."""

import functools

import numpy as np
import pytest
from coarse_parts import COARSE

from exu_press import Scene, simulate
from exu_press.model.settings import scales
from exu_press.scene import mechanism_of

GRAVITY = 9.81
VARIANTS = [
    {"joints": {}},
    {"joints": {"crank_pin": "dry", "balls": "dry"}},
    {"joints": {"crank_pin": "lubricated", "balls": "dry"}},
    {"joints": {"crank_pin": "lubricated", "balls": "dry"}, "guide": {"lateral_stiffness": 1e9}},
    {"joints": {}, "guide": {"clearance": 5e-5, "friction": "coulomb", "width": 0.2}},
    {"joints": {"crank_pin": "lubricated", "balls": "dry"}, "press": {"counterweight": False}},
    {"joints": {"shaft": "lubricated", "pivots": "dry", "slide_pin": "dry"}},
    {"mechanism": "slider_crank", "joints": {"crank_pin": "lubricated"}},
    {"mechanism": "slider_crank", "joints": {"shaft": "dry", "wrist_pin": "lubricated"}},
]
BLANKING = {"kind": "blanking", "force": 1e4, "end_angle_deg": 30.0, "offset": [0.05, 0.0]}


def run(**scene):
    result = simulate(Scene.from_dict({"revolutions": 0.05, **scene}))
    assert result.completed, result.info["reason"]
    return result


def weight(result):
    return GRAVITY * sum(body.mass for body in mechanism_of(result.scene).bodies)


@functools.cache
def ideal(**press):
    return run(joints={}, revolutions=0.5, solver={"step": 1e-4}, press=press)


FEW = VARIANTS[3:5] + VARIANTS[6::2]
"""Every kind of joint and guide."""


@pytest.mark.parametrize(
    "variant",
    [pytest.param(v, marks=[pytest.mark.long] * (v not in FEW), id=str(v)) for v in VARIANTS],
)
def test_frame_carries_inertia_weight_and_load(variant):
    """Forces of guides and pivots against the bodies' accelerations, to Newton's tolerance."""
    result = run(**variant, load={"blanking": BLANKING})
    expected = result["shaking_force"].copy()
    expected[:, 1] += result["load_blanking_force"] - weight(result)
    error = np.abs(result["frame_force"] - expected).max()
    assert error < 0.2 * result.scene.solver.tolerance * scales(result.scene).force


def test_frame_of_the_flexible_press():
    """Modes have no momentum; the crank's centre of mass moves as its frame tilts (150 N)."""
    result = run(bodies=COARSE, revolutions=0.005)
    expected = result["shaking_force"].copy()
    expected[:, 1] -= weight(result)
    assert np.abs(result["frame_force"] - expected).max() < 1e-4 * weight(result)


@pytest.mark.parametrize("press", [{}, {"counterweight": False}], ids=str)
def test_shaking_force_of_the_ideal_press_in_closed_form(press):
    """Minus sum m a of the ideal kinematics, and with it the force on the frame."""
    result = ideal(**press)
    mechanism = mechanism_of(result.scene)
    motion = mechanism.motion(result["crank_angle"], result.scene.angular_speed)
    expected = -sum(body.mass * motion[body.name].acceleration[:, :2] for body in mechanism.bodies)
    scale = np.abs(expected).max()
    assert scale > 1e4
    assert np.abs(result["shaking_force"] - expected)[40:].max() < 1e-4 * scale
    on_frame = expected - [0.0, weight(result)]
    assert np.abs(result["frame_force"] - on_frame)[40:].max() < 1e-4 * scale


def test_without_counterweight_is_what_the_press_without_it_does():
    """The counterweight hangs on the evenly turning shaft; the rest does not feel it."""
    full, bare = ideal(), ideal(counterweight=False)
    assert "shaking_force_without_counterweight" not in bare
    alone = full.quantity("shaking.without_counterweight.vertical").value
    assert alone == pytest.approx(bare.quantity("shaking.vertical").value, rel=1e-6)
    apart = full["shaking_force_without_counterweight"] - bare["shaking_force"]
    assert np.abs(apart[40:]).max() < 1e-6 * np.abs(bare["shaking_force"]).max()
    assert np.abs(full["slider_position"] - bare["slider_position"]).max() < 1e-12
