"""The mechanisms that come as files: what they are meant to show, and short runs of each."""

import math

import numpy as np
import pytest

from exu_press import Scene, simulate
from exu_press.mechanism import SHIPPED, shipped_mechanism

SMALL = {"radius": 0.001, "clearance": 1e-6}
PINS = {"radius": 0.02, "clearance": 2e-5}
JOINTS = {
    "andrews_squeezer": {"crank_pin": SMALL, "upper": SMALL},
    "cycloidal_press": {"rod_pin": PINS},
    "crank_shaper": {"crank_pin": PINS, "rod_pin": PINS},
    "drag_link": {"wrist_pin": PINS},
    "elliptic_trammel": {"crank_pin": PINS},
    "scotch_yoke": {"shaft": PINS},
    "eccentric_press": {"crank_pin": {}, "wrist_pin": {}},
    "four_bar": {"crank_pin": PINS, "knuckle": PINS, "pivot": PINS},
    "inverted_slider_crank": {"crank_pin": PINS},
    "oldham": {"driven_shaft": PINS},
    "oscillating_cylinder": {"crank_pin": PINS},
    "six_bar": {"crank_pin": PINS, "coupler_pin": PINS, "pivot": PINS, "rod_pins": PINS},
    "two_point_press": {"crank_pins": PINS, "wrist_pins": PINS},
    "whitworth": {"crank_pin": PINS, "pivot": PINS},
}
SIZES = {"andrews_squeezer": (2e-3, 0.4), "eccentric_press": None}
SIZES |= dict.fromkeys(("cycloidal_press", "drag_link", "six_bar", "two_point_press"), (0.04, 0.1))
"""Length of a joint, and viscosity, of those that are no bars; the eccentric press has its own."""


def run(name, kind, **given):
    joints = {joint: {"kind": kind, **keys} for joint, keys in JOINTS[name].items()}
    if kind == "ideal":
        joints = dict.fromkeys(joints, kind)
    laws, size = {}, SIZES.get(name, (0.02, 0.1))
    if size and kind == "dry":
        laws = {"contact": {"length": size[0]}}
    elif size and kind == "lubricated":
        laws = {"film": {"length": size[0], "viscosity": size[1]}}
    short = 0.1 if kind == "ideal" else 0.03
    scene = Scene(mechanism=name, joints=joints, revolutions=short, **laws, **given)
    return simulate(scene)


def test_every_file_is_tried():
    assert set(SHIPPED) == set(JOINTS)


@pytest.mark.parametrize("name", SHIPPED)
def test_ideal_joints_follow_the_ideal_motion(name):
    result = run(name, "ideal")
    assert result.completed, result.info["reason"]
    mechanism = shipped_mechanism(name)
    position, velocity, _ = mechanism.ideal_slider(result["crank_angle"], 8.0 * math.pi)
    assert result["slider_position"] == pytest.approx(position, abs=1e-7 * mechanism.size)
    scale = np.abs(velocity).max()
    assert result["slider_velocity"] == pytest.approx(velocity, abs=1e-4 * scale)


@pytest.mark.parametrize(
    ("name", "kind"),
    [
        pytest.param(name, kind, marks=[pytest.mark.long] * (number % 2 == (kind == "dry")))
        for number, name in enumerate(SHIPPED)
        for kind in ("dry", "lubricated")
    ],
)
def test_joints_with_clearance_stay_near_it(name, kind):
    result = run(name, kind)
    assert result.completed, result.info["reason"]
    ideal = shipped_mechanism(name).ideal_slider(result["crank_angle"], 1.0)[0]
    clearance = max(joint.clearance for joint in result.scene.joints.with_clearance.values())
    away = np.abs(result["slider_position"] - ideal).max()
    assert 1e-4 * clearance < away < 20.0 * clearance
    assert abs(result.quantity("energy.residual").value) < 1e-3
    assert result.quantity("energy.dissipated").value > 0.0


def test_the_squeezer_has_the_test_sets_lengths():
    """Fork 20 mm of bodies 4 and 6, 40 mm of 5 and 7, 35 mm across body 3 to its pivot."""
    places = {j.name: np.array(j.at) for j in shipped_mechanism("andrews_squeezer").joints}
    assert math.dist(places["shaft"], places["crank_pin"]) == pytest.approx(0.007, abs=1e-8)
    assert math.dist(places["crank_pin"], places["fork_3"]) == pytest.approx(0.028, abs=1e-8)
    for upper in ("upper", "lower"):
        assert math.dist(places["fork_4"], places[upper]) == pytest.approx(0.02, abs=1e-8)
    assert math.dist(places["pivot_a5"], places["upper"]) == pytest.approx(0.04, abs=1e-8)
    assert math.dist(places["pivot_b"], places["fork_3"]) == pytest.approx(0.035, abs=1e-8)
