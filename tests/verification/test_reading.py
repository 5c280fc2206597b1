"""What reading a record at its steps leaves open."""

import numpy as np
import pytest

from exu_press import Scene, simulate
from exu_press.verification.reading import (
    OF_FIRST_STEP,
    TRANSVERSE,
    add_energy_residual,
    add_start_overshoot,
    average_neighbours,
    enlarge_reversing_forces,
)
from exu_press.verification.run import errors_of

SCENE = Scene(mechanism="slider_crank", revolutions=0.1)


@pytest.fixture(scope="module")
def run():
    return simulate(SCENE)


def with_force(result, values):
    return result.with_values({"shaft_force": values})


def test_a_force_that_turns_round_within_a_step_may_act_across_it(run):
    """A film behind a load that goes away: 7 kN to one side, 5 kN to the other one step later."""
    force = np.tile([200.0, 7000.0], (len(run.time), 1))
    force[50:] = [-90.0, -5000.0]
    found = enlarge_reversing_forces(with_force(run, force))["shaft_force"]
    beside = TRANSVERSE * np.hypot(290.0, 12000.0)
    assert found[49:51, 0] == pytest.approx([200.0 + beside, -90.0 - beside])
    assert np.array_equal(found[:49], force[:49]) and np.array_equal(found[51:], force[51:])


def test_of_a_smooth_peak_twice_what_lies_between_steps_is_taken(run):
    """A parabola is higher between two steps than at them by an eighth of its second difference."""
    curve = np.stack([1000.0 - 1e8 * (run.time - run.time[100]) ** 2] * 2, axis=1)
    before, after = np.diff(run.time)[99:101]
    taken = curve[100] - average_neighbours(with_force(run, curve))["shaft_force"][100]
    assert taken == pytest.approx(0.5 * 1e8 * before * after)


def test_a_film_may_take_up_its_load_at_once(run):
    """Then the first step's area below the load is the second value's, not that of a triangle.

    A force that rises within the first step may go beyond what it rises to.
    """
    falling = np.zeros((len(run.time), 2))
    falling[0] = 100.0
    found = add_start_overshoot(with_force(run, falling))
    area = np.trapezoid(found["shaft_force"][:, 0], found.time)
    assert abs(area) < OF_FIRST_STEP * np.trapezoid(falling[:, 0], run.time) * 1.001
    assert found["slider_position"][1] == run["slider_position"][0]
    assert found.time[1] > found.time[0]
    rising = np.full((len(run.time), 2), 500.0)
    rising[0] = 100.0
    found = add_start_overshoot(with_force(run, rising))["shaft_force"]
    assert np.abs(found).max() == pytest.approx(500.0 + OF_FIRST_STEP * 400.0)


def test_energy_and_mean_power_are_as_unsure_as_the_balance(run):
    residual = np.abs(run["energy_input"] - run["energy_stored"] - run["energy_dissipated"]).max()
    read = add_energy_residual(run)
    assert (read["energy_input"] - run["energy_input"])[1:] == pytest.approx(residual)
    power = read["drive_power"] - run["drive_power"]
    assert np.trapezoid(power, run.time) == pytest.approx(residual)


@pytest.mark.parametrize("missed", [0.0, 100.0])
def test_a_load_is_read_as_exactly_as_its_curve_is_met(missed):
    """Runs that share their steps pass over the peak of a pulse alike, or end a step at it."""
    pulse = {"kind": "blanking", "force": 1e4, "start_angle_deg": 10.0}
    run = simulate(SCENE.replace({"load": {"press": pulse}}))
    force = run["load_press_force"]
    assert force.max() == pytest.approx(1e4, rel=1e-12)
    read = run.with_values({"load_press_force": np.minimum(force, 1e4 - missed)})
    stated = errors_of(read, [(4.0, read), (8.0, read)])["errors"]["loads.press.peak_force"]
    assert missed <= stated["error"] < 1.6 * missed + 1e-4


def test_a_peak_velocity_between_steps_is_stated(run):
    """Runs that share their steps pass over it alike, and agree."""
    peak = run.time[100] + 0.5 * (run.time[101] - run.time[100])
    speed = 0.3 - 10.0 * (run.time - peak) ** 2
    alike = run.with_values({"slider_velocity": speed})
    told = errors_of(alike, [(4.0, alike), (8.0, alike)])["errors"]["peak_velocity"]
    passed_over = 0.3 - speed.max()
    assert passed_over > 0.0
    assert told["error"] >= passed_over


@pytest.mark.parametrize(
    ("steps", "more", "least"),
    [(slice(60, 61), [400.0], 0.75 * 195.0), (slice(-2, None), [-40.0, 40.0], 0.5 * 39.0)],
    ids=["within", "at the end"],
)
def test_a_peak_of_one_sample_is_stated_as_unsure(run, steps, more, least):
    """Where all runs have it, as at a start, no difference of theirs says so."""
    force = np.tile([0.0, 500.0], (len(run.time), 1))
    force[steps, 1] += more
    loud = with_force(run, force)
    stated = errors_of(loud, [(4.0, loud), (8.0, loud)])["errors"]["joints.shaft.peak_force"]
    assert stated["error"] >= least
