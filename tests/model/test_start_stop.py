"""Clutch, brake and schedule: closed forms of free rotors, and a press of two coordinates."""

import math
from types import SimpleNamespace

import numpy as np
import pytest
from schedules import LIGHT, OneCoordinate, keys, kloss
from scipy.integrate import solve_ivp

from exu_press import Scene, simulate
from exu_press.scene import mechanism_of
from exu_press.schema.table import plain

FREE = {
    "rated_torque": 1e-3,
    "inertia": 20.0,
    "begins": "standing",
    "clutch_torque": 200.0,
    "clutch_on": [0.05, 0.07],
    "clutch_off": [0.0, 0.01],
    "brake_torque": 100.0,
    "brake_on": [0.02, 0.03],
    "brake_off": [0.0, 0.01],
    "start_time": [0.1],
    "stop_time": [0.6],
}


def rotors(**changes):
    """Return two rotors: a flywheel of 20 kg m^2 and a crank of 4 kg m^2, without weight."""
    return Scene(
        mechanism="slider_crank",
        joints={},
        speed_rpm=60.0,
        revolutions=1.3,
        gravity=0.0,
        slider_crank={**LIGHT, "crank_inertia": 4.0},
        drive=keys(**{**FREE, **changes}),
    )


def test_a_press_that_stands_is_resolved():
    """Its inertia forces are rounding: they jump from step to step, and move nothing."""
    pin = {"kind": "dry", "clearance": 5e-5, "radius": 0.03}
    never = dict.fromkeys(("stop_time", "clutch_off", "brake_on"))
    standing = rotors(start_time=[0.05], brake_torque=600.0, **never).replace(
        {
            "joints": {"crank_pin": pin},
            "contact": {"length": 0.05},
            "slider_crank": {},
            "gravity": 9.81,
            "revolutions": 0.05,
        }
    )
    result = simulate(standing)
    assert result.info["status"] == "completed", result.info["reason"]
    assert abs(result["slider_velocity"]).max() < 1e-11
    assert result.summary()["read_from"] == {"from": 0.0, "to": 0.0}


def test_free_rotors_are_engaged_and_stopped_as_closed_forms_say():
    """J_r = J_1 J_2 / (J_1 + J_2): the clutch slips for J_r w / T and takes J_r w^2 / 2."""
    result = simulate(rotors())
    assert result.completed
    speed, both, reduced = 2.0 * math.pi, 24.0, 80.0 / 24.0
    lasts = reduced * speed / 200.0
    begins, rises = 0.15, 0.02  # half of the ramp's torque is there on the mean
    assert result.quantity("drive.starting_time").value == pytest.approx(
        begins - 0.1 + 0.5 * rises + lasts, rel=2e-3
    )
    together = 20.0 / both * speed
    at = np.searchsorted(result.time, 0.5)
    assert result["crank_speed"][at] == pytest.approx(together, rel=1e-4)
    assert result["flywheel_speed"][at] == pytest.approx(together, rel=1e-4)
    assert result.quantity("drive.clutch_energy").value == pytest.approx(
        0.5 * reduced * speed**2, rel=1e-3
    )
    assert result.quantity("drive.speed_drop").value == pytest.approx(
        4.0 / 24.0,
        abs=2e-3,  # and the shafts untwist
    )
    brakes = 4.0 * together / 100.0
    stops = 0.02 + 0.5 * 0.01 + brakes
    assert result.quantity("drive.stopping_time").value == pytest.approx(stops, rel=1e-4)
    stands = result.time[-1] - 1e-2 / 3.0  # between two steps, and a shaft untwists
    slow = result.with_values({"crank_speed": 1e-3 * (stands - result.time)})
    stop = result.scene.drive.clutch.stop.stop_time[-1]
    assert slow.quantity("drive.stopping_time").value == pytest.approx(stands - stop, rel=1e-12)
    # J w^2 / 2 T at full torque; in the ramp of length r the speed falls by T r / 2 J, and the way
    # is w r - T r^2 / 6 J
    ramp = 0.01
    slower = together - 100.0 * ramp / (2.0 * 4.0)
    way = together * (0.02 + ramp) - 100.0 * ramp**2 / (6.0 * 4.0) + 4.0 * slower**2 / 200.0
    assert result.quantity("drive.stopping_angle_deg").value == pytest.approx(
        math.degrees(way), rel=1e-4
    )
    assert result.quantity("drive.brake_energy").value == pytest.approx(
        0.5 * 4.0 * together**2, rel=1e-3
    )
    assert result.quantity("energy.residual").value < 1e-4
    late = result.time > 1.2
    assert np.ptp(result["crank_angle"][late]) < 1e-9  # what stands stays
    assert result.quantity("drive.mean_power").value is None


def reduced(scene, end):
    """Return time, crank angle, crank and flywheel speed of a slider-crank with clutch and brake.

    Of two coordinates, from the closed form of the slider-crank, with dry friction that jumps: each
    piece is integrated by LSODA until something slips or sticks.
    """
    motor, wheel, free = scene.drive.torque, scene.drive.inertia, scene.angular_speed
    keys = SimpleNamespace(**plain(scene.drive.clutch))
    crank = OneCoordinate(scene, keys.driven_inertia).crank

    def ramp(pair, since):
        return min(1.0, max(0.0, (since - pair[0]) / (pair[1] - pair[0])))

    (start,), (stop,) = keys.start_time, keys.stop_time

    def clutch(t):
        if t >= stop:
            return keys.clutch_torque * (1.0 - ramp(keys.clutch_off, t - stop))
        return keys.clutch_torque * ramp(keys.clutch_on, t - start) if t >= start else 0.0

    def brake(t):
        if t >= stop:
            return keys.brake_torque * ramp(keys.brake_on, t - stop)
        return keys.brake_torque * (1.0 - ramp(keys.brake_off, t - start) if t >= start else 1.0)

    def rates(t, state, clutched, braked):
        """`clutched`, `braked`: the signs with which they slip, 0 where they stick."""
        a, speed, turning = state
        j, own = crank(a, speed)
        drive = kloss(motor, turning, free)
        if braked == 0:
            through = clutched * clutch(t)
            return [0.0, 0.0, (drive - through) / wheel]
        own -= braked * brake(t)
        if clutched == 0:
            together = (drive + own) / (j + wheel)
            return [speed, together, together]
        through = clutched * clutch(t)
        return [speed, (own + through) / j, (drive - through) / wheel]

    # the order of what happens is known: start, level, stop, standstill
    def let_go(t, state):
        """The brake no longer holds the weight."""
        return brake(t) - abs(crank(state[0], 0.0)[1])

    def through(t, state):
        """Return the torque of a clutch that sticks."""
        j, own = crank(state[0], state[1])
        return (j * kloss(motor, state[2], free) - wheel * (own - brake(t))) / (j + wheel)

    def slips(t, state):
        return clutch(t) - abs(through(t, state))

    def level(t, state):
        return state[2] - state[1]

    def stands(t, state):
        return state[1]

    pieces = (
        ((1, 0), let_go, -1),
        ((1, 1), None, start + keys.brake_off[1]),
        ((1, 1), level, -1),
        ((0, 1), None, stop),
        ((0, 1), slips, -1),
        (("slips", 1), None, stop + keys.brake_on[0]),
        ((1, 1), stands, -1),
        ((1, 0), None, end),
    )
    time, state = 0.0, [0.0, 0.0, free]
    times, states = [], []
    for modes, event, until in pieces:
        events = None
        if event is not None:
            event.terminal, event.direction = True, -1
            events, until = [event], end
        if modes[0] == "slips":
            modes = math.copysign(1.0, through(time, state)), 1
        found = solve_ivp(
            lambda t, s, modes=modes: rates(t, s, *modes),
            (time, until),
            state,
            "LSODA",
            events=events,
            rtol=1e-9,
            atol=1e-10,
            max_step=2e-3,
        )
        times.append(found.t)
        states.append(found.y)
        time, state = float(found.t[-1]), found.y[:, -1].tolist()
        if event is stands:
            state[1] = 0.0
        if event is level:
            state[1] = state[2]
    return np.concatenate(times), *np.concatenate(states, axis=1)


PRESS = {
    "rated_torque": 60.0,
    "slip": 0.1,
    "no_load_speed_rpm": 60.0,
    "inertia": 40.0,
    "begins": "standing",
    "driven_inertia": 1.5,
    "clutch_torque": 900.0,
    "clutch_on": [0.03, 0.08],
    "clutch_off": [0.0, 0.02],
    "brake_torque": 500.0,
    "brake_on": [0.03, 0.06],
    "brake_off": [0.0, 0.03],
    "windup_deg": 0.002,
    "start_time": [0.1],
    "stop_time": [0.7],
}


def test_a_press_starts_and_stops_as_a_model_of_two_coordinates_says():
    scene = Scene(
        mechanism="slider_crank",
        joints={},
        speed_rpm=60.0,
        revolutions=1.0,
        start_angle_deg=0.0,
        drive=PRESS,
        solver={"tolerance": 1e-5},
    )
    result = simulate(scene)
    assert result.completed
    time, angle, speed, wheel = reduced(scene, 1.0)
    keep = np.concatenate([[True], np.diff(time) > 0.0])
    fastest = scene.angular_speed
    grid = np.linspace(0.0, 1.0, 2001)
    for channel, expected in (("crank_speed", speed), ("flywheel_speed", wheel)):
        there = np.interp(grid, result.time, result[channel])
        missed = np.abs(there - np.interp(grid, time[keep], expected[keep]))
        assert np.quantile(missed, 0.9) < 1e-4 * fastest
        assert missed.max() < 1e-2 * fastest  # where shafts untwist as slip ends
    there = np.interp(grid, result.time, result["crank_angle"])
    missed = np.abs(there - np.interp(grid, time[keep], angle[keep]))
    assert missed.max() < 4e-4
    stood = time[keep][(time[keep] > 0.7) & (speed[keep] <= 1e-9)][0]
    assert result.quantity("drive.stopping_time").value == pytest.approx(stood - 0.7, rel=1e-3)
    turned = np.interp(stood, time[keep], angle[keep]) - np.interp(0.7, time[keep], angle[keep])
    assert result.quantity("drive.stopping_angle_deg").value == pytest.approx(
        math.degrees(turned), rel=2e-3
    )
    assert result.quantity("energy.residual").value < 1e-3


def test_the_stopping_travel_is_the_way_there_and_back_across_the_dead_centre():
    result = simulate(rotors(stop_time=[0.78]))
    angle = result["crank_angle"][np.searchsorted(result.time, 0.78)]
    stands = angle + math.radians(result.quantity("drive.stopping_angle_deg").value)
    assert angle < math.pi < stands
    begin, bottom, end = mechanism_of(result.scene).ideal_slider(
        np.array([angle, math.pi, stands]), 1.0
    )[0]
    travel = result.quantity("drive.stopping_travel").value
    assert travel == pytest.approx(begin + end - 2.0 * bottom, rel=1e-4)
    assert travel > 1.2 * abs(end - begin)
