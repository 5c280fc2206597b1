"""Loads that alternate from step to step are read without that."""

import numpy as np
import pytest

from exu_press import Scene, simulate
from exu_press.quantities import alternating
from exu_press.quantities.alternating import peaks, remove_alternation


@pytest.fixture(scope="module")
def run():
    return simulate(Scene(mechanism="slider_crank", revolutions=0.1))


def smooth(run):
    turns = 2.0 * np.pi * (run.time / run.time[-1])
    return 1000.0 * np.stack([np.sin(turns), 2.0 + np.cos(turns)], axis=1)


def signs(run):
    return np.where(np.arange(len(run.time)) % 2, 1.0, -1.0)[:, None]


@pytest.mark.parametrize("size", [3.0, 900.0])
def test_what_alternates_is_taken_away(run, size):
    found = remove_alternation(run.time, smooth(run) + size * signs(run))
    assert found[2:] == pytest.approx(smooth(run)[2:], abs=0.02 * size + 0.5)


def test_a_peak_of_one_sample_stays(run):
    force = np.zeros((len(run.time), 2))
    force[40] = 500.0
    assert np.array_equal(remove_alternation(run.time, force), force)


@pytest.mark.parametrize("at_once", [7, 50, 10_000])
def test_the_largest_is_that_of_the_steady_load(run, monkeypatch, at_once):
    """The last parts of a record are those of the whole."""
    whole = alternating.AT_ONCE
    for count in (3, 7, 8, 15, 51, len(run.time)):
        time, values = run.time[:count], (smooth(run) + 300.0 * signs(run))[:count]
        monkeypatch.setattr(alternating, "AT_ONCE", whole)
        expected = remove_alternation(time, values)
        monkeypatch.setattr(alternating, "AT_ONCE", at_once)
        assert np.array_equal(remove_alternation(time, values), expected)
        found = peaks(time, values)
        assert np.array_equal(found.columns, np.abs(expected).max(axis=0))
        assert found.length == np.linalg.norm(expected, axis=1).max()
        assert peaks(time, values[:, 0]).length == found.columns[0]
