"""Geared presses in runs: torque of the gear, force per point, and what no run can tell."""

import dataclasses

import numpy as np
import pytest

from exu_press import InputError, Scene, simulate
from exu_press.mechanism import GROUND, Body, Gear, Joint
from exu_press.quantities.summary import summary
from exu_press.scene import mechanism_of

OFF_CENTRE = {
    "press": {"kind": "table", "time": [0.0, 1e3], "force": [6e5, 6e5], "offset": [0.1, 0.0]}
}


def two_point(**changes):
    keys = {"joints": {}, "speed_rpm": 2.0, "revolutions": 0.02, "start_angle_deg": 150.0}
    return Scene(mechanism="two_point_press", **{**keys, "load": OFF_CENTRE, **changes})


def moment_about(result, body, joint, sign):
    """Return the moment of a pin's force about the shaft of its crank, (n,), N m."""
    shaft = {"crank": (-0.3, 0.8), "second_crank": (0.3, 0.8)}[body]
    index = result.bodies.index(body)
    angle = result["body_position"][:, index, 2]
    arm = 0.05 * np.column_stack([-np.sin(angle), np.cos(angle)])
    assert result["body_position"][0, index, :2] == pytest.approx(shaft, abs=1e-9)
    force = sign * result[f"{joint}_force"]
    return arm[:, 0] * force[:, 1] - arm[:, 1] * force[:, 0]


@pytest.fixture(scope="module")
def elastic():
    result = simulate(two_point(guide={"lateral_stiffness": 1e9, "length": 1e-3}))
    assert result.completed, result.info["reason"]
    return result


def test_the_points_share_an_off_centre_load_by_the_lever_rule(elastic):
    """Slowly, in a guide that hardly resists a tilt: 2/3 and 1/3 of the load, less half the weight.

    The rods lean by up to 4 deg.
    """
    middle = len(elastic.time) // 2
    up = {s: elastic[f"wrist_pin_{s}_force"][middle:, 1].mean() for s in ("left", "right")}
    weight = 1500.0 * 9.81
    assert -up["right"] == pytest.approx(-(6e5 * 2 / 3 - weight / 2), rel=2e-3)
    assert -up["left"] == pytest.approx(-(6e5 / 3 - weight / 2), rel=2e-3)


def test_torques_balance_on_both_shafts(elastic):
    """Drive, gear and pin: the gear turns one shaft forwards and holds the other one back."""
    gear = elastic["gear_pair_torque"]
    index = {body: elastic.bodies.index(body) for body in ("crank", "second_crank")}
    omega = 2.0 * np.pi / 30.0
    assert elastic["crank_speed"] == pytest.approx(omega, rel=1e-9)
    second = moment_about(elastic, "second_crank", "crank_pin_right", 1.0) + gear
    first = moment_about(elastic, "crank", "crank_pin_left", 1.0) + elastic["drive_torque"] + gear
    scale = np.abs(gear).max()
    assert scale > 1e3
    assert second == pytest.approx(0.0, abs=1e-6 * scale)
    assert first == pytest.approx(0.0, abs=1e-6 * scale)
    angles = [elastic["body_position"][:, index[body], 2] for body in index]
    assert sum(angles) == pytest.approx(0.0, abs=1e-9)


def test_an_ideal_drawing_has_no_force_per_point_and_says_why():
    result = simulate(two_point())
    for name in (
        "joints.wrist_pin_left.peak_force",
        "joints.crank_pin_right.peak_force",
        "gears.pair.peak_torque",
        "guides.slide.peak_moment",
    ):
        assert result.quantity(name).value is None
    assert result.quantity("drive.peak_torque").value > 0.0
    (reason,) = (text for text in summary(result)["warnings"] if "not determined" in text)
    assert "wrist_pin_left" in reason
    assert "[guide]" in reason


def test_friction_of_an_undetermined_force_is_refused(tmp_path):
    """Of a file with its name, as it may be one of several."""
    file = tmp_path / "scene.toml"
    two_point(guide={"friction": "coulomb", "mu_kinetic": 0.1}).save(file)
    with pytest.raises(InputError, match=r"scene\.toml: guide\.friction: the force of guides\.sl"):
        simulate(Scene.load(file))


def test_a_gear_on_a_flexible_body_is_refused():
    with pytest.raises(InputError, match=r"gears\.pair: bodies\.second_crank is flexible"):
        two_point(bodies={"second_crank": {"flexible": "any.step", "density": 7850.0}})


def test_a_crank_may_drive_by_a_gear_alone():
    """Against its wheel, and with the torque that the wheel would need."""
    direct = Scene(mechanism="slider_crank", joints={}, revolutions=0.1, start_angle_deg=30.0)
    drawn = mechanism_of(direct)
    geared = dataclasses.replace(
        drawn,
        bodies=(*drawn.bodies, Body("motor", 5.0, 0.1, (-1.0, 0.0))),
        joints=(*drawn.joints, Joint("motor_shaft", (-1.0, 0.0), "motor", GROUND)),
        gears=(Gear("pair", "crank", -1.0, "motor"),),
        crank="motor",
    )
    runs = [simulate(direct), simulate(direct.replace({"mechanism": geared, "joints": {}}))]
    for name in ("slider_position", "drive_torque"):
        ends = [run[name][-1] for run in runs]
        assert ends[1] == pytest.approx(ends[0], rel=1e-4)
