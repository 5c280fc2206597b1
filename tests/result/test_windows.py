"""Parts of a run's record."""

import numpy as np
import pytest

from exu_press import Scene, simulate
from exu_press.result.windows import at_instant, revolutions_of, up_to, window

PERIOD = 0.25
"""s, at 240 rpm."""


@pytest.fixture(scope="module")
def run():
    return simulate(Scene(mechanism="slider_crank", joints={}, revolutions=2.5))


def test_both_ends_of_a_window_are_in_it(run):
    begin, end = run.time[3], run.time[7]
    found = window(run, begin, end)
    assert found.time.tolist() == run.time[3:8].tolist()
    assert found["shaft_force"].tolist() == run["shaft_force"][3:8].tolist()
    assert window(run, 1.001 * begin, 0.999 * end).time.tolist() == run.time[4:7].tolist()


@pytest.mark.parametrize("share", [0.0, 0.001, 0.5, 0.999, 1.0])
def test_between_samples_a_record_is_cubic(run, share):
    cubic = (run.time - 0.1) ** 3 + run.time
    instant = share * run.time[-1]
    found = at_instant(run.with_values({"energy_stored": cubic}), instant)
    assert found.time == pytest.approx([instant], abs=1e-12)
    assert found["energy_stored"] == pytest.approx([(instant - 0.1) ** 3 + instant])
    assert found["shaft_force"].shape == (1, 2)


def test_whole_revolutions_follow_each_other(run):
    first, second = revolutions_of(run)
    assert first.time[0] == 0.0
    assert first.time[-1] <= PERIOD <= second.time[-1] <= 2.0 * PERIOD
    assert PERIOD <= second.time[0] <= first.time[-1] + 2.0 * np.diff(run.time).max()
    assert np.ptp(second["crank_angle"]) == pytest.approx(2.0 * np.pi, abs=0.2)


def test_a_revolution_that_is_not_whole_is_none(run):
    assert revolutions_of(up_to(run, 0.99 * PERIOD)) == []
    assert len(revolutions_of(up_to(run, 1.99 * PERIOD))) == 1
