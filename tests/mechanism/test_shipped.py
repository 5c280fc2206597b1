"""The shipped mechanisms: published sizes and speeds, and short runs of each file."""

import math
from itertools import cycle

import numpy as np
import pytest

from exu_press import InputError, Scene, simulate
from exu_press.mechanism import SHIPPED, shipped_mechanism
from exu_press.scene import mechanism_of

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


@pytest.mark.parametrize(("name", "kind"), [*zip(SHIPPED, cycle(("dry", "lubricated")))])
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


IDEAL = Scene.from_dict({"mechanism": "press", "joints": {}})
PRESS = mechanism_of(IDEAL)


def test_peak_velocities_and_bottom_dead_centre_are_the_papers():
    """0.441, 0.37 and 0.92 m/s at 240, 200 and 500 rpm; 470 mm at 180 deg, the lowest point."""
    angle = np.radians(np.arange(0.0, 360.0, 0.5))
    for speed_rpm, peak, digit in ((240.0, 0.441, 5e-4), (200.0, 0.37, 5e-3), (500.0, 0.92, 5e-3)):
        position, velocity, _ = PRESS.ideal_slider(angle, speed_rpm * math.pi / 30)
        assert np.abs(velocity).max() == pytest.approx(peak, abs=digit)
    assert position.argmin() == 360
    assert position.min() == pytest.approx(0.47, abs=1e-12)


def test_link_lengths_of_table_2():
    """Both joints of a link sit at its ends, so that closed joints mean a constant length."""
    lengths = {"linkage": 0.383, "counter_linkage": 0.275}
    for side in ("left", "right"):
        for link, length in (("link_5", 0.23), ("link_6", 0.24), ("link_7", 0.164)):
            lengths[f"{link}_{side}"] = length
    for body, length in lengths.items():
        ends = np.array(PRESS.points(body))
        assert ends[:, 1] == pytest.approx(0.0, abs=1e-15)
        assert np.abs(ends[:, 0]) == pytest.approx(length / 2, abs=1e-15)
        assert np.ptp(ends[:, 0]) == pytest.approx(length, abs=1e-15)


def test_masses_of_table_2():
    """Links per side (A-7), slide 60 kg (A-4)."""
    masses = {"crank": 217.6, "linkage": 184.5, "slide": 60.0, "slider": 1347.0}
    masses |= {"counter_linkage": 22.58, "counterweight": 1847.2}
    for side in ("left", "right"):
        masses |= {f"link_5_{side}": 22.72, f"link_6_{side}": 24.13}
        masses |= {f"link_7_{side}": 15.5, f"plunger_{side}": 155.3}
    assert {body.name: body.mass for body in PRESS.bodies} == masses


def test_links_are_uniform_rods():
    """A-6: inertia m l^2 / 12 about the middle."""
    inertia = {body.name: body.inertia for body in PRESS.bodies}
    assert inertia["linkage"] == pytest.approx(184.5 * 0.383**2 / 12)
    assert inertia["link_6_left"] == pytest.approx(24.13 * 0.24**2 / 12)


def test_links_out_of_all_proportion_are_refused():
    """Relative to their length the linkage does not move: already the drawing is singular."""
    with pytest.raises(InputError, match="no two connected links lie in one line"):
        Scene(press={"link_5_length": 23000.0})
