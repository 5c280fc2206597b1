"""Steps end where surfaces touch, and shorten before their errors are too large."""

import math
from types import SimpleNamespace

import pytest
from patched import PATCHED

from exu_press import Scene, Tuning, simulate
from exu_press.integrate.joint_error import JointError
from exu_press.integrate.touch import Touch

TUNING = Tuning()
DEPTH, SHORT, SHORTEST = TUNING.touch_depth, TUNING.touch_reserve, TUNING.shortest_touch

CLEARANCE = 1e-4
REACH = CLEARANCE * (1.0 - SHORT * DEPTH)


def touch_after(place, velocity, acceleration=(0.0, 0.0), step=1e-4, reach=CLEARANCE):
    """A joint that comes to a place with a velocity and a constant acceleration."""
    joint = SimpleNamespace(clearance=CLEARANCE, reach=reach)
    motion = JointError(joint, 1e-7, math.inf, 1e-14, TUNING)
    for ago in (step, 0.0):
        rates = zip(place, velocity, acceleration, strict=True)
        joint.eccentricity = tuple(p - ago * v + 0.5 * ago * ago * a for p, v, a in rates)
        pairs = zip(velocity, acceleration, strict=True)
        joint.relative_velocity = tuple(v - ago * a for v, a in pairs)
        motion.error(step)
        motion.accept()
    return Touch(joint, motion, TUNING)


def test_a_free_journal_arrives_when_its_parabola_says():
    touch = touch_after((9e-5, 0.0), (0.05, 0.0), (-50.0, 0.0))
    arrival = touch.until(1e-3)
    there = 9e-5 + 0.05 * arrival - 25.0 * arrival**2
    assert there == pytest.approx(REACH, abs=SHORT * DEPTH * CLEARANCE)


def test_a_free_journal_in_space_may_come_from_aside():
    touch = touch_after((9.8e-5, 0.0, 0.0), (0.0, 0.016, 0.012), (0.0, 0.0, 0.0))
    assert touch.until(1e-2) == pytest.approx(math.sqrt(REACH**2 - 9.8e-5**2) / 0.02)


def test_however_little_deeper_it_would_go():
    """A force at the end of a long step acts on all of it: 0.5 um deep cost 4 % of an impact."""
    touch = touch_after((9.99e-5, 0.0), (3e-4, 0.0))
    assert touch.until(1e-3) == pytest.approx((REACH - 9.99e-5) / 3e-4)


def test_from_afar_a_step_ends_half_way():
    assert touch_after((0.0, 0.0), (0.2, 0.0)).until(1e-3) == pytest.approx(0.5 * REACH / 0.2)


def test_rough_surfaces_touch_earlier():
    arrival = touch_after((9e-5, 0.0), (0.05, 0.0), reach=9.5e-5).until(1e-3)
    assert arrival == pytest.approx(5e-6 / 0.05, rel=1e-2)


@pytest.mark.parametrize(
    ("place", "velocity"),
    [
        ((0.0, 0.0), (0.0, 0.0)),  # at rest
        ((9e-5, 0.0), (-1e-3, 0.0)),  # leaving
        ((0.0, 0.0), (0.09, 0.0)),  # arrives later
        ((1.001e-4, 0.0), (0.1, 0.0)),  # touches already
    ],
)
def test_other_steps_are_left_alone(place, velocity):
    assert touch_after(place, velocity).until(1e-3) == 1e-3


def test_nothing_is_foreseen_before_there_was_a_step():
    joint = SimpleNamespace(clearance=CLEARANCE, reach=CLEARANCE)
    joint.eccentricity, joint.relative_velocity = (0.0,), (1.0,)
    motion = JointError(joint, 1e-7, math.inf, 1e-14, TUNING)
    assert Touch(joint, motion, TUNING).until(1e-3) == 1e-3
    assert Touch(joint, motion, TUNING).first_step() == math.inf


def test_a_contact_that_begins_goes_a_little_deeper():
    just_there = CLEARANCE * (1.0 + 0.1 * DEPTH)
    assert touch_after((0.0, just_there), (3.0, 0.2)).first_step() == pytest.approx(
        DEPTH * CLEARANCE / 0.2
    )
    assert touch_after((0.0, just_there), (3.0, -0.2)).first_step() == math.inf
    assert touch_after((0.0, 0.99 * CLEARANCE), (0.0, 0.2)).first_step() == math.inf
    assert touch_after((0.0, 1.01 * CLEARANCE), (0.0, 0.2)).first_step() == math.inf


def test_no_step_is_so_short_that_rounding_shows():
    """Of clearances of 0.1 um a depth asks for steps of 1e-8 s."""
    assert touch_after((0.0, CLEARANCE), (0.0, 1e2)).first_step() == SHORTEST
    assert touch_after((0.999 * CLEARANCE, 0.0), (1e2, 0.0)).until(1e-3) == SHORTEST
    assert touch_after((0.999 * CLEARANCE, 0.0), (1e2, 0.0)).until(5e-8) == 5e-8


@pytest.fixture
def dry_press():
    return Scene(
        joints={"crank_pin": "dry", "balls": "dry"}, revolutions=0.5, solver={"tolerance": 0.02}
    )


@PATCHED
def test_impacts_cost_fewer_iterations(dry_press, monkeypatch):
    foreseen = simulate(dry_press).info
    monkeypatch.setattr(Touch, "until", lambda touch, step: step)
    monkeypatch.setattr(Touch, "first_step", lambda touch: math.inf)
    leapt_into = simulate(dry_press).info
    assert foreseen["rejected_steps"] < 0.7 * leapt_into["rejected_steps"]
    assert foreseen["newton_iterations"] < 0.95 * leapt_into["newton_iterations"]


def test_a_loose_tolerance_meets_an_impact_of_rough_surfaces():
    """A step that leapt over the pin's first impact left 55 % of the second one's force."""
    film = {"at_contact": "mixed", "viscosity": 1e-5}
    rough = Scene(revolutions=0.03, film=film, solver={"tolerance": 0.1})
    loose, fine = (
        simulate(rough.replace("solver.tolerance", tolerance)).summary()["joints"]["crank_pin"]
        for tolerance in (0.1, 1e-4)
    )
    assert loose["peak_force"] == pytest.approx(fine["peak_force"], rel=0.05)


def test_errors_that_rise_are_foreseen(dry_press):
    foreseen = dry_press.build().solve().rejected_steps
    assert foreseen < 0.7 * dry_press.build().solve(tuning=Tuning(rise=0.0)).rejected_steps
