"""Differences of two runs at their common instants."""

from types import SimpleNamespace

import numpy as np
import pytest

from exu_press.exudyn_systems.difference import at_peaks, differences
from exu_press.exudyn_systems.samples import Samples


def run_with(values, times):
    """A run of nothing but a sensor's values (instants,)."""
    empty = np.zeros((len(times), 0))
    nodes = np.zeros((len(times), 0, 3)), np.zeros((len(times), 0, 3, 3))
    turning = np.zeros((len(times), 0, 3))
    return Samples(times, empty, empty, empty, empty, *nodes, turning, np.array(values)[:, None])


@pytest.mark.parametrize("shift", [0.01, 0.1])
def test_an_error_of_phase_is_small_where_a_sensor_peaks(shift):
    """The largest difference is the shift; the peaks, each between instants, differ by less."""
    times = np.linspace(0.0, 7.0, 201)
    first, second = (run_with(np.sin(times - late), times) for late in (0.0, shift))
    variables = SimpleNamespace(kinds=np.array(["Displacement"]), plain=[], spans={})
    (bound,) = at_peaks(first, second, differences(first, second, variables))
    of_peaks = abs(np.abs(first.sensors).max() - np.abs(second.sensors).max())
    assert of_peaks <= bound <= shift * (shift + (times[1] - times[0]))


def test_a_sensor_that_is_no_number_has_no_bound():
    times = np.linspace(0.0, 1.0, 3)
    first, second = (run_with([1.0, end, 0.0], times) for end in (np.nan, 0.5))
    variables = SimpleNamespace(kinds=np.array(["Displacement"]), plain=[], spans={})
    assert at_peaks(first, second, differences(first, second, variables)) == np.inf
