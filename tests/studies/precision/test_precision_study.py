"""The study of a user's scene; errors of trajectories whose errors are known, their orders."""

import dataclasses
import itertools
import math

import numpy as np
import pytest

from exu_press import Scene
from exu_press.studies.precision import case_of, precision
from exu_press.studies.precision.cases import QUICK
from exu_press.studies.precision.errors import (
    Errors,
    Trajectory,
    errors_of,
    peaks_error,
)
from exu_press.studies.precision.references import divergence
from exu_press.studies.precision.rows import order_of, row_of
from exu_press.studies.precision.table import horizon_text
from exu_press.studies.precision.timing import Attempt, TimedRun, time_runs


@pytest.fixture(scope="module")
def report():
    """A lubricated slider-crank, against the package's own references."""
    scene = Scene(mechanism="slider_crank", revolutions=0.05)
    return precision(
        (case_of("mine", scene.replace({"joints.crank_pin": "lubricated"})),), quick=True
    )


def test_errors_follow_the_tolerance_and_the_reference_knows_how_good_it_is(report):
    errors = [row.error_position for row in report.rows if row.solver == "tolerance"]
    assert all(b < 1.01 * a for a, b in itertools.pairwise(errors))
    assert errors[-1] < 0.5 * errors[0]  # the last ones are the reference's own
    (stated,) = report.stated
    assert stated.covered >= 0.8 * stated.figures > 16
    reference = report.cases["mine"]["reference"]
    assert "extrapolated" in reference["method"]
    assert 0.0 < reference["difference"]["position"] < 1e-6


def test_a_horizon_is_measured_where_neighbours_part(report):
    """Two sliders part tenfold in 20 ms, from 1e-7 of a clearance on."""
    scene = Scene(mechanism="slider_crank", joints={"crank_pin": "dry"})
    clearance = scene.joints["crank_pin"].clearance
    time = np.linspace(0.0, 0.2, 2001)
    one = Trajectory(time, np.zeros_like(time), np.zeros_like(time), np.zeros_like(time))
    apart = 1e-7 * clearance * 10.0 ** (time / 0.02)
    found = divergence(scene, one, dataclasses.replace(one, position=apart))
    assert found.horizon == pytest.approx(0.08, abs=2e-4)
    assert found.rate == pytest.approx(np.log(10.0) / 0.02, rel=1e-2)
    assert divergence(scene, one, one).horizon is None
    text = "\n".join(report.lines())
    assert "no horizon: trajectories " in text
    case = {"duration": 0.2, "horizon": 0.08, "lyapunov_exponent": found.rate}
    assert horizon_text(case) == "horizon 0.08 s: trajectories diverge tenfold in 0.02 s"


@pytest.mark.parametrize(
    ("changes", "closed_form"),
    [
        ({"mechanism": "slider_crank", "joints": {}}, True),
        ({"mechanism": "slider_crank", "joints": {"crank_pin": "dry"}}, False),
        ({"joints": {}}, True),
        ({"joints": {"balls": "dry"}}, False),
        ({"joints": {"crank_pin": "lubricated", "balls": "dry"}}, False),
        ({"joints": {}, "guide": {"lateral_stiffness": 1e9}}, False),
        ({"joints": {}, "drive": {"rated_torque": 100.0, "inertia": 1.0}}, False),
    ],
)
def test_a_users_scene_gets_the_best_reference_there_is(changes, closed_form):
    """Kinematics where nothing gives, else the package's own tightest run."""
    case = case_of("mine", Scene(revolutions=0.01, **changes)).limit_to(QUICK)
    assert ("closed-form" in case.reference(QUICK).method) == closed_form


TIME = np.linspace(0.0, 0.1, 401)


def wave(time=TIME, amplitude=1.0):
    a, w = amplitude, 50.0
    x = w * time
    return Trajectory(time, a * np.sin(x), a * w * np.cos(x), -a * w * w * np.sin(x))


def test_a_larger_amplitude_is_seen_in_all_three():
    errors = errors_of(wave(amplitude=1.01), wave(), 0.1)
    assert errors.position == pytest.approx(0.01, rel=1e-2)
    assert errors.velocity == pytest.approx(0.5, rel=1e-6)
    assert errors.peak_acceleration == pytest.approx(0.01, rel=1e-6)
    position = wave().position + np.where(TIME > 0.05, 1.0, 0.0)
    run = Trajectory(TIME, position, wave().velocity, wave().acceleration)
    assert errors_of(run, wave(), 0.049).position == 0.0, "what lies behind the horizon counts"
    assert errors_of(run, wave(), 0.1).position == pytest.approx(1.0)


NO_FLOOR = Errors(0.0, 0.0, 0.0)


def row(value, error, wall_time=1.0, case="case", solver="fixed step", floor=NO_FLOOR):
    attempt = Attempt(solver, "step", value, lambda: TimedRun(None, (wall_time,), (wall_time,)))
    return row_of(case, attempt, attempt.run(), Errors(error, error, error), floor, None)


def test_order_leaves_out_what_cannot_be_told():
    floor = Errors(1e-7, 0.0, 0.0)
    series = [row(h, 3.0 * h**2, floor=floor) for h in (1e-1, 1e-2, 1e-3, 1e-4)]
    assert order_of(series) == pytest.approx(2.0)
    assert order_of(series[-1:]) is None


def test_long_runs_and_failed_ones_are_not_repeated():
    def attempt(seconds, status="completed"):
        return Attempt(
            "s", "step", 1.0, lambda: TimedRun(None, (seconds,), (seconds,), status=status)
        )

    assert len(time_runs(attempt(1.0), 3).wall_times) == 3
    assert len(time_runs(attempt(100.0), 3).wall_times) == 1
    assert len(time_runs(attempt(100.0), 3, longest=math.inf).wall_times) == 3
    assert len(time_runs(attempt(1.0, "failed"), 3).wall_times) == 1


def test_peaks_of_a_whole_run_are_a_distribution_over_its_starts():
    """Accelerations of a run are a tenth larger, those of its other start a tenth less."""
    truth, large, small = (wave(amplitude=amplitude) for amplitude in (1.0, 1.1, 0.9))
    assert peaks_error(large, truth) == pytest.approx(0.1)
    assert peaks_error(large, truth, [small]) == pytest.approx(0.0, abs=1e-12)
    assert peaks_error(large, truth, [], [large]) == pytest.approx(0.1 / 2.1)


def test_errors_below_the_floor_are_raised_to_it_and_marked():
    low = row(1e-3, 1e-9, floor=Errors(1e-8, 1e-10, None))
    assert (low.error_position, low.error_velocity) == (1e-8, 1e-9)
    assert low.at_most == ("error_position",)
    assert (
        low.resolved_error("error_position") is None
        and low.resolved_error("error_velocity") == 1e-9
    )
