"""What is determined of figures where motion is chaotic."""

import numpy as np
import pytest

from exu_press import InputError, Scene
from exu_press.verification.distribution import LEAST_REVOLUTIONS, distributions, percentiles

NAME = "peak_acceleration.resolved"


def test_distribution_of_revolutions(monkeypatch):
    """The dry slider-crank's peaks scatter from revolution to revolution; what adds up has none."""
    scene = Scene(mechanism="slider_crank", joints={"crank_pin": "dry"}, solver={"tolerance": 2e-2})
    names = [NAME, "peak_velocity", "energy.dissipated", "strokes.range"]
    monkeypatch.setattr("exu_press.verification.distribution.AT_A_TIME", 3)
    found = distributions(scene, names, within=1e-9, least=2, most=4)
    assert found.keys() == {NAME, "peak_velocity"}
    assert found[NAME].revolutions == 4
    (low, *_), (median, *bounds), (high, *_) = found[NAME].percentiles.values()
    assert low <= median <= high
    assert bounds[0] <= median <= bounds[1]


@pytest.mark.parametrize("count", [LEAST_REVOLUTIONS, 100])
@pytest.mark.parametrize("draw", ["normal", "exponential"])
def test_bounds_of_percentiles_have_their_confidence(count, draw):
    """Of any distribution; nine in ten, or a few more, as samples are counted."""
    random = np.random.default_rng(3)
    true = np.percentile(getattr(random, draw)(size=1_000_000), [5.0, 50.0, 95.0])
    inside = np.zeros(3)
    for _ in range(400):
        found = percentiles(getattr(random, draw)(size=count).tolist())
        inside += [low <= x <= high for x, (_, low, high) in zip(true, found.values(), strict=True)]
    assert (inside / 400 > 0.87).all()
    assert (inside / 400 < 0.98).all()


def test_of_fewer_samples_the_largest_may_be_below_the_percentile():
    assert 0.95**LEAST_REVOLUTIONS <= 0.05 < 0.95 ** (LEAST_REVOLUTIONS - 1)


def test_a_run_that_stops_early_leaves_none():
    scene = Scene(mechanism="slider_crank", joints={"crank_pin": "dry"}, solver={"max_steps": 20})
    with pytest.raises(InputError, match=r"no distribution, as a run .*20 steps"):
        distributions(scene, [NAME], within=0.01)


def test_percentiles_of_thousands_of_revolutions():
    values = np.random.default_rng(3).normal(5.0, 2.0, 4000)
    middle, low, high = percentiles(values.tolist())[95.0]
    assert low < 5.0 + 1.6449 * 2.0 < high
    assert middle == pytest.approx(5.0 + 1.6449 * 2.0, rel=0.03)
