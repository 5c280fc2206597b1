"""Errors of trajectories whose errors are known; their rows, floors and orders."""

import math

import numpy as np
import pytest

from exu_press.studies.precision.errors import (
    Errors,
    Trajectory,
    errors_of,
)
from exu_press.studies.precision.rows import order_of, row_of
from exu_press.studies.precision.timing import Attempt, TimedRun, time_runs

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
