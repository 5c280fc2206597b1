"""Peaks as three observers read them, and of loads that alternate from step to step."""

import numpy as np
import pytest

from exu_press import Scene, simulate
from exu_press.quantities import (
    acceleration,
    alternating,
    differentiated_peak,
    mean_peak,
    mean_peak_of,
)
from exu_press.quantities.alternating import peaks, remove_alternation

TIME = np.linspace(0.0, 0.1, 10001)


def pulse(height, begin, length):
    """Velocity and position of a body that a constant acceleration moves for a while."""
    into = np.clip(TIME - begin, 0.0, length)
    velocity = height * into
    position = height * into**2 / 2 + height * length * np.clip(TIME - begin - length, 0.0, None)
    return velocity, position


@pytest.mark.parametrize(
    ("begin", "window", "mean"), [(0.0312345, 1e-3, 100.0), (0.03, 5e-4, 200.0), (0.03, 5e-5, 1e3)]
)
def test_an_impact_is_spread_over_the_window(begin, window, mean):
    """1000 m/s^2 over 0.1 ms is 100 m/s^2 over 1 ms, wherever the window may fall."""
    velocity, _ = pulse(1000.0, begin, 1e-4)
    assert mean_peak(TIME, velocity, window=window) == pytest.approx(mean, rel=1e-3)


@pytest.mark.parametrize(("middle", "expected"), [(0.03, 100.0), (0.0305, 50.0)])
def test_second_difference_of_an_impact_depends_on_where_samples_are(middle, expected):
    """A step of velocity dv on a sample reads dv * rate, one between two samples half of it."""
    velocity, position = pulse(1000.0, middle - 5e-5, 1e-4)
    read = differentiated_peak(TIME, position, velocity)
    assert read == pytest.approx(expected, rel=0.03)


def test_samples_of_a_part_are_those_of_the_whole():
    """Wherever the part begins: the same impact reads the same."""
    velocity, position = pulse(1000.0, 0.0305 - 5e-5, 1e-4)
    for begin in (0.0123, 0.01254, 0.02, 0.0278):
        part = slice(int(np.searchsorted(TIME, begin)), None)
        read = differentiated_peak(TIME[part], position[part], velocity[part])
        assert read == pytest.approx(differentiated_peak(TIME, position, velocity), rel=1e-9)


def test_second_difference_of_a_sine():
    """(2 sin(w T / 2) / T)^2 times the amplitude, for samples T apart; of uneven steps."""
    omega, rate = 2 * np.pi * 100.0, 1e3
    rng = np.random.default_rng(1)
    into = np.sort(np.concatenate([[0.0, 0.1], rng.uniform(0.0, 0.1, 3000)]))
    position, velocity = 1e-3 * np.cos(omega * into), -1e-3 * omega * np.sin(omega * into)
    expected = 1e-3 * (2 * np.sin(omega / rate / 2) * rate) ** 2
    assert differentiated_peak(7.0 + into, position, velocity) == pytest.approx(expected, rel=1e-6)


def test_records_that_are_too_short_have_no_answer():
    """A mean over 1 ms needs 1 ms, a second difference three samples."""
    for end, mean, second in (
        (50, None, None),
        (101, 5.0, None),
        (150, 5.0, None),
        (201, 5.0, 5.0),
    ):
        time = TIME[:end]
        assert mean_peak(time, 5.0 * time) == pytest.approx(mean)
        assert differentiated_peak(time, 2.5 * time**2, 5.0 * time) == pytest.approx(second)


@pytest.mark.parametrize("window", [1e-4, 1e-3, 1e-2])
def test_no_larger_mean_is_left_out(window, monkeypatch):
    """Of a load with peaks of all widths, against windows everywhere; read whole and in parts."""
    random = np.random.default_rng(2)
    time = np.cumsum(random.uniform(1e-6, 6e-5, 6000))
    width = 10.0 ** random.uniform(-5.0, -2.0, 200)
    place, height = random.uniform(0.0, time[-1], 200), random.normal(size=200)
    values = (height * np.exp(-(((time[:, None] - place) / width) ** 2))).sum(axis=1)
    steps = np.diff(time)
    summed = np.append(0.0, np.cumsum(0.5 * steps * (values[1:] + values[:-1])))

    def until(at):
        row = np.clip(np.searchsorted(time, at, side="right") - 1, 0, len(steps) - 1)
        into = at - time[row]
        slope = (values[row + 1] - values[row]) / steps[row]
        return summed[row] + into * (values[row] + 0.5 * slope * into)

    ends = np.linspace(time[0] + window, time[-1], 200_000)
    everywhere = np.abs(until(ends) - until(ends - window)).max() / window
    assert mean_peak_of(time, values, window) == pytest.approx(everywhere, rel=1e-5)
    assert mean_peak_of(time, values, window) >= everywhere * (1.0 - 1e-12)
    whole = mean_peak(time, values, window), mean_peak_of(time, values, window)
    for at_once in (7, 501):
        monkeypatch.setattr(acceleration, "AT_ONCE", at_once)
        parts = mean_peak(time, values, window), mean_peak_of(time, values, window)
        assert parts == pytest.approx(whole, rel=1e-12)


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


def test_the_peak_of_no_load_has_no_sign():
    assert str(peaks(TIME, np.zeros_like(TIME)).columns[0]) == "0.0"


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
