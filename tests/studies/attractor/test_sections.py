"""Sections of cranks that a motor turns, and of fixed steps; what is recorded; and no motion."""

from dataclasses import replace

import numpy as np
import pytest
from slider_cranks import FILM, section_points

from exu_press import InputError, Scene, simulate
from exu_press.integrate import SolverStatus
from exu_press.studies.attractor import attractor
from exu_press.studies.attractor.orbit import Orbit
from exu_press.studies.attractor.report import AttractorReport

MOTOR = FILM.replace({"drive": {"rated_torque": 200.0, "inertia": 2.0}})
NAMES = ["stroke", "crank_speed", "crank_pin_force.x"]
SHORT = {"revolutions": 20, "most": 4, "names": NAMES}


def test_a_motors_sections_lie_where_a_run_is_sampled():
    orbit = Orbit(MOTOR)
    orbit.advance()
    speed = orbit.point()[-1] * MOTOR.angular_speed
    time = orbit.state["time"]
    orbit.close()
    run = simulate(MOTOR.replace({"revolutions": 1.2, "output": {"samples": [0.0]}}))
    samples = run.samples.at_angle(0.0)
    assert speed == pytest.approx(samples["crank_speed"][1], rel=1e-5)
    assert time == pytest.approx(samples["time"][1], rel=1e-6)


def test_fixed_steps_end_on_the_section():
    orbit = Orbit(FILM.replace({"solver.step": 4.1e-4}))
    orbit.advance()
    result = orbit.advance(recorded=True)
    assert result.time[-1] == pytest.approx(0.5, rel=1e-12)
    assert result["crank_angle"][-1] == pytest.approx(4.0 * np.pi, rel=1e-9)
    assert np.diff(result.time).max() <= 4.1e-4
    orbit.close()


@pytest.mark.long
def test_a_motor_turns_a_lubricated_press_regularly():
    """More slowly than its speed without load, by its slip; channels are kept on the section."""
    turned = attractor(MOTOR, skip=6, **SHORT)
    assert turned.period.revolutions == 1
    assert turned.exponent.sign == "regular"
    assert turned.points.shape == (20, 5)
    mean = turned.figures["crank_speed"].mean()
    assert turned.points[:, -1].mean() * MOTOR.angular_speed == pytest.approx(mean, rel=1e-6)
    assert 0.95 * 4.0 < turned.turns < 4.0
    assert turned.per_second[0] == pytest.approx(turned.turns * turned.exponent.value)
    assert turned.units == {"stroke": "m", "crank_speed": "rad/s", "crank_pin_force.x": "N"}
    assert "crank_pin_force.x, N" in "\n".join(AttractorReport(turned).lines())


def test_an_interrupted_orbit_is_no_motion_that_fails(monkeypatch):
    orbit = Orbit(FILM)
    ended = replace(orbit._model.solve(), status=SolverStatus.INTERRUPTED)
    monkeypatch.setattr(type(orbit._model), "solve", lambda model: ended)
    with pytest.raises(KeyboardInterrupt):
        orbit.advance()
    orbit.close()


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        (
            {"drive": {"rated_torque": 0.2, "inertia": 0.01}, "solver.tolerance": 3e-2},
            "no motion in the long run: the press stalled at",
        ),
        (
            {
                "drive": {"rated_torque": 5000.0, "inertia": 0.01, "no_load_speed_rpm": 8.0},
                "solver.tolerance": 3e-2,
            },
            r"\[drive\]: the crank does not get to its section at 0 deg within 2.5 s; allowed is",
        ),
        (
            {"drive": {"rated_torque": 200.0, "inertia": 2.0}, "solver.step": 1e-4},
            "solver.step: a motor gets to its section at any instant; allowed is solver.tolerance",
        ),
    ],
    ids=["stalls", "never there", "fixed steps with a motor"],
)
def test_no_section(changes, words):
    scene = FILM.replace(changes)
    with pytest.raises(InputError, match=words) as raised:
        attractor(scene, skip=1, **SHORT)
    assert "\n" not in str(raised.value)


PRESSED = Scene(
    mechanism="slider_crank",
    joints={"crank_pin": {"kind": "dry", "clearance": 5e-6, "radius": 0.07}},
    contact={"length": 0.1},
)


@pytest.mark.long
def test_a_contact_that_lasts_does_not_creep():
    """By a ten-thousandth of the clearance a revolution, where what steps miss is kept for good."""
    _, first, last = section_points(PRESSED, 3, recorded=False)
    assert np.abs(last - first).max() < 1e-5
