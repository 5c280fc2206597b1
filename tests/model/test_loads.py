"""Loads against virtual work: what they put in the drive takes out, on any body and point.

With ideal joints and a crank at constant speed a load F at a point with velocity v changes the
drive's torque by -F v / omega and nothing else.
"""

import numpy as np
import pytest
from pressed import FORMING

from exu_press import Scene, simulate
from exu_press.scene import mechanism_of

IDEAL = {"joints": {}, "revolutions": 0.5, "solver": {"tolerance": 1e-5}}
LOADS = {
    "over time": {"kind": "table", "time": [0.02, 0.05, 0.1], "force": [0.0, 2e4, -1e4]},
    "over the crank angle": {
        "kind": "table",
        "crank_angle_deg": [30, 90, 150],
        "force": [0, 5e4, 2e4],
    },
    "a spring over the height": {
        "kind": "table",
        "height": [0.0, 0.005, 0.015],
        "force": [2e5, 4e4, 0],
        "acts": "both",
    },
    "a forming force": {
        "kind": "table",
        "height": [0.0, 0.001, 0.005, 0.015],
        "force": [2e5, 3e5, 4e4, 0],
    },
    "on a link, off its middle": {
        "kind": "blanking",
        "force": 1e5,
        "rise": 0.02,
        "fall": 0.03,
        "end_angle_deg": 160.0,
        "body": "link_5_right",
        "offset": [0.05, 0.02],
        "direction": [1.0, 2.0],
    },
}


@pytest.fixture(scope="module")
def free():
    return simulate(Scene(**IDEAL))


@pytest.mark.parametrize("name", LOADS)
def test_the_drive_takes_out_what_a_load_puts_in(name, free):
    scene = Scene(**IDEAL, load={"one": LOADS[name]})
    result = simulate(scene)
    assert result.completed and free.completed
    load, speed = scene.applied_loads["one"], scene.angular_speed
    angle = speed * result.time
    motion = mechanism_of(scene).motion(angle, speed)
    position, velocity, _ = mechanism_of(scene).ideal_slider(angle, speed)
    force = load.force(
        result.time, (angle, result["crank_speed"]), (position - position.min(), velocity)
    )
    power = force * (
        motion[load.body].point_motion(load.point).velocity[:, :2] @ np.array(load.direction)
    )
    without = np.interp(result.time, free.time, free["drive_torque"])
    changed = result["drive_torque"] - without
    expected = -power / speed
    assert np.abs(expected).max() > 100.0
    assert np.abs(changed - expected).max() < 1e-4 * np.abs(expected).max()
    # velocities may be 1e-5 of the largest off, and a force fades over 1e-3 of it
    close = 1e-4 if load.fade is None else 2e-3
    assert result["load_one_force"] == pytest.approx(force, abs=close * np.abs(force).max())
    assert result.quantity("energy.residual").value < 5e-4
    assert ("load_one_moment" in result) == (name == "on a link, off its middle")
    degrees = LOADS[name].get("crank_angle_deg", [])
    for corner in LOADS[name].get("time", np.array(degrees) / 360.0 * 0.25):
        assert np.abs(result.time - corner).min() < 1e-9, "steps end on the corners"


def work_of(load):
    """Return the work of forming on the whole way down, J."""
    return float(np.trapezoid(load["force"], load["height"]))


OILED = {"crank_pin": "lubricated", "balls": "dry"}


@pytest.mark.parametrize("joints", [{}, pytest.param(OILED, marks=pytest.mark.long)], ids=str)
def test_a_forming_force_takes_out_its_area_and_gives_nothing_back(joints):
    film = {"film": {"at_contact": "mixed"}} if joints else {}
    scene = Scene(
        mechanism="eccentric_press",
        speed_rpm=60.0,
        start_angle_deg=60.0,
        revolutions=0.68,
        joints=joints,
        load={"draw": FORMING},
        solver={"tolerance": 3e-3},
        **film,
    )
    result = simulate(scene)
    assert result.completed
    force, done = result["load_draw_force"], result["load_draw_work"]
    assert done[-1] == pytest.approx(-work_of(FORMING), rel=1e-3 if not joints else 3e-2)
    quadrature = 1e-6 * abs(done[-1])  # of the step in which the slider turns round
    assert (np.diff(done) <= quadrature).all(), "it never pushes"
    assert (force[result["slider_velocity"] >= 0.0] == 0.0).all()
    assert force.max() == pytest.approx(260e3, rel=1e-3)
    assert result.quantity("energy.residual").value < 1e-3
    if not joints:
        spring = simulate(scene.replace({"load.draw.acts": "both"}))
        assert abs(spring["load_draw_work"][-1]) < 0.01 * work_of(FORMING)
