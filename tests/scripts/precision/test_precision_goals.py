"""Ratios of run times that are aimed at."""

import dataclasses

import pytest

from exu_press.studies.precision.errors import Errors, Late
from exu_press.studies.precision.measured import Attempt, Measured
from exu_press.studies.precision.rows import row_of
from precision.goals import cheapest, goals_of

NO_FLOOR = Errors(0.0, 0.0, 0.0)


def row(value, error, wall_time=1.0, case="case", solver="fixed step", floor=NO_FLOOR):
    attempt = Attempt(solver, "step", value, lambda: Measured(None, (wall_time,), (wall_time,)))
    return row_of(case, attempt, attempt.run(), Errors(error, error, error), floor, None)


def test_goals_compare_the_cheapest_runs():
    rows = [
        row(1e-5, 1e-3, 6.0, "press_lubricated"),
        row(1e-3, 1e-3, 0.05, "press_lubricated", "tolerance"),
    ]
    fixed, real_time = goals_of(rows, {"press_lubricated": 0.5})
    assert fixed.ratio == pytest.approx(1 / 120) and fixed.met
    assert real_time.ratio == pytest.approx(0.1) and real_time.met


def test_the_dry_press_is_judged_by_the_peaks_of_its_whole_run():
    """Its peak until the horizon is right at any setting, its distribution not."""

    def dry(solver, wall_time, mean, large):
        late = Late(9, None, 0.5, 0.1, 0.1, mean, large)
        return dataclasses.replace(row(1e-4, 1e-6, wall_time, "press_dry", solver), late=late)

    rows = [dry("fixed step", 30.0, 0.01, 0.019), dry("tolerance", 1.0, 0.01, 0.015)]
    fixed, real_time = goals_of(rows, {"press_dry": 0.5})
    assert "95th percentile" in fixed.what and fixed.ratio == pytest.approx(1 / 30) and fixed.met
    assert real_time.ratio == pytest.approx(2.0) and not real_time.met
    rows[1] = dry("tolerance", 1.0, 0.01, 0.03)
    assert goals_of(rows, {"press_dry": 0.5})[0].ratio is None


def test_a_goal_without_a_run_is_not_told():
    (fixed, real_time) = goals_of([row(1e-5, 0.5, case="press_dry")], {"press_dry": 0.5})
    assert fixed.ratio is None and fixed.met is None and real_time.met is None


def test_the_cheapest_setting_is_not_a_lucky_one():
    lucky = [row(1e-1, 1e-6, 0.1), row(1e-2, 1e-2, 1.0), row(1e-3, 1e-5, 3.0), row(1e-4, 0.0, 9.0)]
    assert cheapest(lucky, "error_position", 1e-4).wall_time == 3.0
    assert cheapest(lucky[:2], "error_position", 1e-4) is None


def test_failed_runs_do_not_count_as_quick():
    failed = dataclasses.replace(row(1e-4, None, 0.01), status="not converged")
    assert cheapest([row(1e-3, 1e-5, 3.0), failed], "error_position", 1e-4).wall_time == 3.0
