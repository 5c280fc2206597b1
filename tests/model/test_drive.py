"""[drive]: a motor with its flywheel against closed forms and a model of one coordinate."""

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from exu_press import InputError, Scene, simulate
from exu_press.scene import Motor

MOTOR = {"rated_torque": 300.0, "slip": 0.1, "no_load_speed_rpm": 250.0, "inertia": 12.0}


def test_a_free_flywheel_runs_up_exponentially():
    """I dw/dt = d (w_0 - w), from 240 to 300 rpm; rod and slider weigh nothing to speak of."""
    motor = {"rated_torque": 100.0, "slip": 0.05, "no_load_speed_rpm": 300.0, "inertia": 9.0}
    light = {"rod_mass": 1e-6, "slider_mass": 1e-6, "rod_inertia": 1e-8, "crank_inertia": 1.0}
    scene = Scene(mechanism="slider_crank", joints={}, gravity=0.0, slider_crank=light, drive=motor)
    result = simulate(scene)
    start, end = 8 * math.pi, 10 * math.pi
    rate = 100.0 / (0.05 * end) / 10.0
    expected = end - (end - start) * np.exp(-rate * result.time)
    assert expected[-1] > 0.99 * end
    assert np.abs(result["crank_speed"] - expected).max() < 1e-5 * end
    turned = end * result.time - (end - start) * (1.0 - np.exp(-rate * result.time)) / rate
    assert np.abs(result["crank_angle"] - turned).max() < 1e-5 * turned[-1]
    torque = 10.0 * rate * (end - expected)
    assert np.abs(result["drive_torque"] - torque).max() < 1e-4 * torque[0]
    assert result.quantity("energy.input").value == pytest.approx(
        0.5 * 10.0 * (expected[-1] ** 2 - start**2), rel=1e-4
    )
    assert result.quantity("energy.residual").value < 1e-5


def reduced_slider_crank(scene, end):
    """Return crank angle and speed of a slider-crank of one coordinate, by LSODA.

    J(a) a_tt + J'(a) a_t^2 / 2 = T(a_t) - V'(a): kinetic energy J a_t^2 / 2 of flywheel, crank, rod
    and slider, potential V of rod and slider, all from the closed form of the slider-crank.
    """
    size, motor = scene.slider_crank, scene.drive
    r, rod, m, big_m = size.crank_radius, size.rod_length, size.rod_mass, size.slider_mass
    free = motor.no_load_speed_rpm * math.pi / 30
    slope = motor.rated_torque / (motor.slip * free)

    def terms(a):
        """Return J and V; a from the top."""
        sine = r * math.sin(a) / rod
        cosine = math.sqrt(1 - sine**2)
        swing = r * math.cos(a) / (rod * cosine)  # of the rod, over the crank's
        down = -r * math.sin(a) + rod * sine * swing  # of the slider
        middle = -r * math.cos(a) / 2, (down - r * math.sin(a)) / 2
        inertia = size.crank_inertia + motor.inertia + size.rod_inertia * swing**2
        inertia += m * (middle[0] ** 2 + middle[1] ** 2) + big_m * down**2
        height = r * math.cos(a) - rod * cosine
        return inertia, scene.gravity * (big_m * height + m * (r * math.cos(a) + height) / 2)

    def rates(_time, state):
        a, speed = state
        step = 1e-5
        (j_2, v_2), (j_1, v_1), (j, _) = terms(a + step), terms(a - step), terms(a)
        torque = slope * (free - speed)
        j_slope, v_slope = (j_2 - j_1) / (2 * step), (v_2 - v_1) / (2 * step)
        return [speed, (torque - v_slope - 0.5 * j_slope * speed**2) / j]

    start = [0.0, scene.angular_speed]
    return solve_ivp(rates, (0.0, end), start, "LSODA", rtol=1e-10, atol=1e-10, dense_output=True)


def test_the_speed_fluctuates_as_a_model_of_one_coordinate_says():
    scene = Scene(mechanism="slider_crank", joints={}, drive=MOTOR, solver={"tolerance": 1e-5})
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


def test_a_smaller_flywheel_fluctuates_more_and_a_huge_one_not():
    found = []
    for inertia in (5.0, 50.0, 5e6):
        scene = Scene(joints={}, drive={"inertia": inertia}, revolutions=1.2)
        found.append(simulate(scene).quantity("drive.fluctuation").value)
    assert found[0] > 3.0 * found[1] > 0.0
    assert found[2] < 1e-6


@pytest.mark.parametrize(
    "scene",
    [
        {},
        {"joints": {"shaft": "lubricated", "balls": "dry"}, "guide": {}},
        {"load": {"blanking": {"kind": "blanking", "force": 1e5, "end_angle_deg": 60.0}}},
    ],
    ids=str,
)
def test_the_balance_closes(scene):
    result = simulate(Scene(**scene, drive={"inertia": 20.0}, revolutions=0.3))
    assert result.completed
    assert result.quantity("energy.residual").value < 1e-3


def test_a_pulse_follows_the_cranks_angle():
    """A crank that slows down meets it later; steps end near its corners."""
    load = {"blanking": {"kind": "blanking", "force": 1e4, "end_angle_deg": 150.0}}
    weak = {"rated_torque": 1.0, "no_load_speed_rpm": 100.0, "inertia": 5.0}
    scene = Scene(joints={}, drive=weak, revolutions=0.7, load=load)
    result = simulate(scene)
    force, degrees = result["load_blanking_force"], np.degrees(result["crank_angle"])
    assert result["crank_speed"][-1] < 0.99 * scene.angular_speed
    pulse = 1.5e-3 * scene.speed_rpm * 6.0  # degrees
    acting = force > 0.0
    assert degrees[acting].min() > 150.0 - pulse - 1e-9
    assert degrees[acting].max() < 150.0 + 1e-9
    assert force.max() == pytest.approx(1e4, rel=2e-3)


def test_a_flexible_crank_has_its_flywheel():
    pytest.importorskip("ngsolve")
    scene = Scene(
        joints={},
        bodies={"crank": {"flexible": "crank", "modes": 4, "mesh_size": 0.05}},
        drive={"inertia": 20.0},
        revolutions=0.1,
    )
    result = simulate(scene)
    rigid = simulate(scene.replace("bodies", {}))
    assert result.quantity("energy.residual").value < 1e-2
    assert result["crank_speed"][-1] == pytest.approx(rigid["crank_speed"][-1], rel=2e-3)


def test_what_a_scene_says():
    scene = Scene(drive={})
    assert scene.drive == Motor(rated_torque=400.0, slip=0.05, inertia=50.0)
    assert Scene().drive is None
    assert scene.replace("drive", None) == Scene()
    with pytest.raises(InputError, match=r"drive\.slip = 0\.0: allowed is a number > 0"):
        Scene(drive={"slip": 0.0})
    with pytest.raises(InputError, match=r"drive\.flywheel = 1\.0: unknown key"):
        Scene(drive={"flywheel": 1.0})
