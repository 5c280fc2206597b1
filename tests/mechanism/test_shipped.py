"""The mechanisms that come as files: what they are meant to show, and short runs of each."""

import math

import numpy as np
import pytest

from exu_press import Scene, simulate
from exu_press.mechanism import SHIPPED, shipped_mechanism

DEGREES = np.radians(np.arange(0.0, 360.0, 0.5))
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


@pytest.mark.parametrize("kind", ["dry", "lubricated"])
@pytest.mark.parametrize("name", SHIPPED)
def test_joints_with_clearance_stay_near_it(name, kind):
    result = run(name, kind)
    assert result.completed, result.info["reason"]
    ideal = shipped_mechanism(name).ideal_slider(result["crank_angle"], 1.0)[0]
    clearance = max(joint.clearance for joint in result.scene.joints.with_clearance.values())
    away = np.abs(result["slider_position"] - ideal).max()
    assert 1e-4 * clearance < away < 20.0 * clearance
    assert abs(result.quantity("energy.residual").value) < 1e-3
    assert result.quantity("energy.dissipated").value > 0.0


def test_balls_under_a_slide():
    """Two balls carry the ram, dry beside a lubricated pin."""
    joints = {"crank_pin": "lubricated", "balls": "dry"}
    result = simulate(Scene(mechanism="eccentric_press", joints=joints, revolutions=0.2))
    assert result.completed
    left, right = result["ball_left_force"][:, 1], result["ball_right_force"][:, 1]
    assert left == pytest.approx(right, abs=1e-6 * np.abs(left).max())
    lifted = 1347.0 * (result["slider_acceleration"] + 9.81)
    assert -(left + right)[1:] == pytest.approx(lifted[1:], abs=1e-4 * np.abs(lifted).max())


def test_the_drag_link_closes_at_an_even_speed_where_it_draws():
    """Over 90 deg of the crank within 9 %; of the stroke of twice the short arm."""
    position, velocity, _ = shipped_mechanism("drag_link").ideal_slider(DEGREES, 1.0)
    assert np.ptp(position) == pytest.approx(0.12, abs=1e-5)
    assert np.degrees(DEGREES[position.argmin()]) == pytest.approx(217.0, abs=0.5)
    drawing = -velocity[(np.degrees(DEGREES) >= 90.0) & (np.degrees(DEGREES) <= 180.0)]
    assert np.ptp(drawing) < 0.09 * drawing.mean()
    assert velocity.max() > 1.9 * drawing.max()


def test_the_four_bar_is_a_crank_rocker():
    """Its transmission angle, at the knuckle, between the limits of the law of cosines."""
    mechanism = shipped_mechanism("four_bar")
    places = {joint.name: np.array(joint.at) for joint in mechanism.joints}
    coupler = math.dist(places["crank_pin"], places["knuckle"])
    rocker, base, crank = math.dist(places["pivot"], places["knuckle"]), 0.35, 0.1
    limits = [
        math.degrees(math.acos((coupler**2 + rocker**2 - d**2) / (2 * coupler * rocker)))
        for d in (base - crank, base + crank)
    ]
    assert limits == pytest.approx([37.0, 77.0], abs=0.5)
    turned = mechanism.motion(DEGREES, 1.0)["rocker"].position[:, 2]
    assert np.ptp(turned) < math.pi


def test_the_six_bar_draws_slowly():
    """202 deg down; between half of the way and a tenth of it the speed varies by a third."""
    position, velocity, _ = shipped_mechanism("six_bar").ideal_slider(DEGREES, 1.0)
    top, bottom = position.argmax(), position.argmin()
    assert top == 0
    assert bottom / 2 == pytest.approx(202.0, abs=1.0)
    down = np.arange(len(DEGREES)) < bottom
    part = (position - position.min()) / np.ptp(position)
    drawing = -velocity[down & (part < 0.5) & (part > 0.1)]
    assert drawing.max() / drawing.min() == pytest.approx(1.36, abs=0.02)
    assert np.ptp(position) == pytest.approx(0.288, abs=5e-4)


def test_the_squeezer_has_the_test_sets_lengths():
    """Fork 20 mm of bodies 4 and 6, 40 mm of 5 and 7, 35 mm across body 3 to its pivot."""
    places = {j.name: np.array(j.at) for j in shipped_mechanism("andrews_squeezer").joints}
    assert math.dist(places["shaft"], places["crank_pin"]) == pytest.approx(0.007, abs=1e-8)
    assert math.dist(places["crank_pin"], places["fork_3"]) == pytest.approx(0.028, abs=1e-8)
    for upper in ("upper", "lower"):
        assert math.dist(places["fork_4"], places[upper]) == pytest.approx(0.02, abs=1e-8)
    assert math.dist(places["pivot_a5"], places["upper"]) == pytest.approx(0.04, abs=1e-8)
    assert math.dist(places["pivot_b"], places["fork_3"]) == pytest.approx(0.035, abs=1e-8)


def test_a_blanking_force_acts_in_the_outputs_direction():
    """On a rocker along x: the drive does its work."""
    name, force = "four_bar", 500.0
    pulse = {"kind": "blanking", "force": force, "rise": 5e-3, "fall": 5e-3, "end_angle_deg": 60.0}
    scene = Scene(mechanism=name, joints={}, revolutions=0.2, load={"blanking": pulse})
    result = simulate(scene)
    assert result.completed
    assert result["load_blanking_force"].max() == pytest.approx(force, rel=1e-3)
    free = simulate(scene.replace({"load.blanking.force": 0.0}))
    changed = result["energy_input"][-1] - free["energy_input"][-1]
    assert abs(changed) < 1e-3 * np.abs(result["energy_input"]).max(), "nothing else takes energy"
    assert np.abs(result["drive_torque"]).max() > 1.2 * np.abs(free["drive_torque"]).max()
    assert abs(result.quantity("energy.residual").value) < 1e-3
