"""[drive]: a motor with its flywheel against closed forms and a model of one coordinate."""

import math
import re

import numpy as np
import pytest
from pressed import FORMING
from schedules import LIGHT, OneCoordinate, kloss
from scipy.integrate import solve_ivp

from exu_press import Scene, simulate
from exu_press.scene import mechanism_of

MOTOR = {"rated_torque": 300.0, "slip": 0.1, "no_load_speed_rpm": 250.0, "inertia": 12.0}


@pytest.mark.validation(
    "closed form",
    "run-up of an induction motor with a flywheel",
    "M. Kloss, Archiv für Elektrotechnik 5 (1916) 59-87, integrated",
    "equation",
)
def test_a_free_flywheel_runs_up_as_kloss_says(compare):
    """I dw/dt = T(s): s^2 / 2 + s_b^2 ln s falls by 2 T_b s_b t / (I w_0); from 60 rpm.

    Rod and slider weigh nothing to speak of; the breakdown torque is passed at 229 rpm.
    """
    motor = {"rated_torque": 100.0, "slip": 0.05, "no_load_speed_rpm": 300.0, "inertia": 9.0}
    scene = Scene(
        mechanism="slider_crank",
        joints={},
        speed_rpm=60.0,
        revolutions=2.0,
        settle=0.0,
        gravity=0.0,
        slider_crank={**LIGHT, "crank_inertia": 1.0},
        drive=motor,
        solver={"tolerance": 5e-5},
    )
    result = simulate(scene)
    fastest, breakdown = 10 * math.pi, 0.05 * (2.5 + math.sqrt(2.5**2 - 1.0))
    slip = 1.0 - result["crank_speed"] / fastest
    gone = slip**2 / 2 + breakdown**2 * np.log(slip)
    expected = gone[0] - 2 * 250.0 * breakdown * result.time / (10.0 * fastest)
    begun = 2 * math.pi
    assert slip[0] == pytest.approx(1.0 - begun / fastest) and slip[-1] < 0.5 * breakdown
    scale = np.ptp(gone)
    name = "slip: s^2 / 2 + s_b^2 ln s, over its change"
    compare(name, expected, gone, error=None, rel=1e-4, scale=scale)
    assert result["crank_torque"] == pytest.approx(0.1 * result["drive_torque"], rel=1e-3)
    assert result.quantity("energy.input").value == pytest.approx(
        0.5 * 10.0 * (result["crank_speed"][-1] ** 2 - begun**2), rel=1e-4
    )
    assert result.quantity("energy.residual").value < 1e-4
    assert result["drive_torque"].max() == pytest.approx(250.0, rel=1e-3)


def reduced_slider_crank(scene, end):
    """Return crank angle and speed of a slider-crank of one coordinate, by LSODA.

    J(a) a_tt + J'(a) a_t^2 / 2 = T(a_t) - V'(a): kinetic energy J a_t^2 / 2 of flywheel, crank, rod
    and slider, potential V of rod and slider.
    """
    motor, free = scene.drive.torque, scene.drive.torque.no_load_speed_rpm * math.pi / 30
    crank = OneCoordinate(scene, scene.drive.inertia).crank

    def rates(_time, state):
        a, speed = state
        j, own = crank(a, speed)
        return [speed, (kloss(motor, speed, free) + own) / j]

    start = [0.0, scene.angular_speed]
    return solve_ivp(rates, (0.0, end), start, "LSODA", rtol=1e-10, atol=1e-10, dense_output=True)


def test_the_speed_fluctuates_as_a_model_of_one_coordinate_says():
    keys = {"drive": MOTOR, "solver": {"tolerance": 3e-5}, "settle": 0.0}
    scene = Scene(mechanism="slider_crank", joints={}, **keys)
    result = simulate(scene)
    assert result.completed
    angle, speed = reduced_slider_crank(scene, result.time[-1]).sol(result.time)
    assert np.ptp(speed) > 0.02 * speed.mean()
    assert np.abs(result["crank_speed"] - speed).max() < 1e-5 * speed.mean()
    assert np.abs(result["crank_angle"] - angle).max() < 1e-4
    whole = 2 * np.pi * math.floor(angle[-1] / (2 * np.pi))
    begin = np.interp(angle[-1] - whole, angle, result.time)
    last = speed[result.time >= begin]
    mean = whole / (result.time[-1] - begin)
    assert result.quantity("drive.mean_speed_rpm").value == pytest.approx(
        mean * 30 / math.pi, rel=1e-5
    )
    assert result.quantity("drive.fluctuation").value == pytest.approx(
        np.ptp(last) / mean, rel=1e-3
    )
    assert result.quantity("energy.residual").value < 1e-4


def test_a_motor_that_lags_over_one_revolution_has_a_mean_speed():
    """The crank turns less than a revolution in the time of a nominal one."""
    weak = {"rated_torque": 40.0, "no_load_speed_rpm": 200.0, "inertia": 5.0}
    scene = Scene(mechanism="slider_crank", joints={}, gravity=0.0, drive=weak, revolutions=1.0)
    result = simulate(scene)
    turned = result["crank_angle"][-1]
    assert 1.5 * math.pi < turned < 2.0 * math.pi * 0.999
    mean = turned / result.time[-1]
    speed = result.quantity("drive.mean_speed_rpm").value
    assert speed == pytest.approx(mean * 30 / math.pi, rel=1e-4)
    assert result.quantity("drive.fluctuation").value == pytest.approx(
        np.ptp(result["crank_speed"]) / mean, rel=1e-4
    )
    assert result.quantity("drive.mean_power").value is None


def test_a_press_that_stalls_says_so_and_keeps_what_it_did():
    """It names the torque of virtual work at the table's force there."""
    keys = {"mechanism": "eccentric_press", "speed_rpm": 60.0, "joints": {}}
    motor = {"rated_torque": 50.0, "inertia": 5.0}
    result = simulate(Scene(**keys, drive=motor, load={"draw": FORMING}))
    assert result.info["status"] == "stalled" and not result.completed
    mechanism, angle = mechanism_of(result.scene), result["crank_angle"][-1:]
    (position,), (per_angle,), _ = mechanism.ideal_slider(angle, 1.0)
    force = np.interp(position - mechanism.bottom, FORMING["height"], FORMING["force"])
    reason = result.info["reason"]
    assert f"crank angle {np.degrees(angle[0]):.2f} deg" in reason
    told = re.search(r"want ([0-9.]+) N m there, and the motor has ([0-9.]+) N m", reason)
    ram = mechanism.body("ram").mass * result.scene.gravity
    assert float(told[1]) == pytest.approx((ram - force) * per_angle, rel=0.05)  # rod's weight
    assert float(told[2]) == pytest.approx(result["drive_torque"][-1], rel=1e-3)
    assert result.time[-1] == result.info["end_time"] > 0.1
    assert result.quantity("energy.residual").value < 1e-3


def test_a_motor_by_its_table():
    table = {"table_speed_rpm": [0.0, 60.0], "table_torque": [900.0, 0.0], "inertia": 300.0}
    scene = Scene(mechanism="eccentric_press", speed_rpm=50.0, joints={}, drive=table)
    result = simulate(scene)
    assert result.completed
    expected = 900.0 * (1.0 - result["crank_speed"] / (2.0 * math.pi))
    assert result["drive_torque"] == pytest.approx(expected, rel=1e-9)
    assert result.quantity("energy.residual").value < 1e-3


def test_a_pulse_keeps_its_times_where_the_crank_slows_down():
    """Rise, fall and impulse are those of the scene; its place follows the crank's angle."""
    load = {"kind": "blanking", "force": 1e4, "rise": 0.03, "fall": 0.015, "end_angle_deg": 150.0}
    weak = {"rated_torque": 40.0, "no_load_speed_rpm": 200.0, "inertia": 5.0}
    scene = Scene(joints={}, drive=weak, revolutions=2.5, load={"blanking": load})
    result = simulate(scene)
    assert result.completed
    force, degrees = result["load_blanking_force"], np.degrees(result["crank_angle"])
    assert result["crank_speed"][-1] < 0.9 * scene.angular_speed
    impulse = np.trapezoid(force, result.time)
    assert impulse == pytest.approx(2 * 0.5 * 1e4 * 0.045, rel=1e-3)
    assert force.max() == pytest.approx(1e4, rel=1e-3)
    acting = np.flatnonzero(force > 0.0)
    pulses = np.split(acting, np.flatnonzero(np.diff(acting) > 1) + 1)
    assert len(pulses) == 2
    for turn, pulse in enumerate(pulses):
        begin, end = pulse[0] - 1, pulse[-1] + 1
        peak = begin + int(force[begin:end].argmax())
        assert result.time[end] - result.time[begin] == pytest.approx(0.045, abs=2e-3)  # to a step
        assert result.time[peak] - result.time[begin] == pytest.approx(0.03, abs=2e-3)
        # foreseen from the speed at the beginning
        assert degrees[end] - 360.0 * turn == pytest.approx(150.0, abs=3.0)
    assert result.quantity("energy.residual").value < 1e-3


def test_a_flexible_crank_has_its_flywheel():
    pytest.importorskip("ngsolve")
    scene = Scene(
        joints={},
        bodies={"crank": {"flexible": "crank", "modes": 4, "mesh_size": 0.05}},
        drive={"rated_torque": 400.0, "inertia": 20.0},
        revolutions=0.1,
    )
    result = simulate(scene)
    rigid = simulate(scene.replace({"bodies": {}}))
    assert result.quantity("energy.residual").value < 1e-2
    assert result["crank_speed"][-1] == pytest.approx(rigid["crank_speed"][-1], rel=2e-3)
