"""What is determined of figures where motion is chaotic."""

import numpy as np
import pytest

from exu_press import InputError, Scene
from exu_press.verification.distribution import (
    FINER,
    LEAST_REVOLUTIONS,
    Distribution,
    discretization_error,
    distributions,
    percentiles,
)
from exu_press.verification.estimate import ORDERS

NAME = "peak_acceleration.resolved"


@pytest.mark.parametrize("count", [LEAST_REVOLUTIONS, 100])
@pytest.mark.parametrize("draw", ["normal", "exponential"])
def test_bounds_of_percentiles_have_their_confidence(count, draw):
    """Of any distribution; nine in ten, or a few more, as samples are counted."""
    random = np.random.default_rng(3)
    true = np.percentile(getattr(random, draw)(size=200_000), [5.0, 50.0, 95.0])
    inside = np.zeros(3)
    for _ in range(200):
        found = percentiles(getattr(random, draw)(size=count).tolist())
        inside += [low <= x <= high for x, (_, low, high) in zip(true, found.values(), strict=True)]
    assert (inside / 200 > 0.87).all()
    assert (inside / 200 < 0.98).all()


def test_a_run_that_stops_early_leaves_none():
    scene = Scene(mechanism="slider_crank", joints={"crank_pin": "dry"}, solver={"max_steps": 20})
    with pytest.raises(InputError, match=r"no distribution, as a run .*20 steps"):
        distributions(scene, [NAME], tolerance=0.01)


def test_errors_of_mean_and_scatter_are_those_of_many_samples():
    """They are within it in nineteen of twenty; also of values that come in runs of ten."""
    random = np.random.default_rng(3)
    found = [Distribution.from_values(random.normal(5.0, 2.0, 200).tolist()) for _ in range(200)]
    for name, expected in (("mean", 2.0 / 200**0.5), ("scatter", 2.0 / 398**0.5)):
        told = np.array([getattr(one, name) for one in found])
        true = 5.0 if name == "mean" else 2.0
        assert told[:, 0].std() == pytest.approx(expected, rel=0.15)
        assert 0.91 < np.mean(np.abs(told[:, 0] - true) <= told[:, 1]) < 0.98
    runs = [
        Distribution.from_values(np.repeat(random.normal(size=20), 10).tolist()) for _ in range(200)
    ]
    assert 0.91 < np.mean([abs(one.mean[0]) <= one.mean[1] for one in runs]) < 0.98


def test_differences_of_pairs_that_scatter_are_known_the_worse():
    random = np.random.default_rng(3)
    assert discretization_error([0.2] * 5) == pytest.approx(
        0.2 / (1.0 - FINER ** ORDERS["tolerance"])
    )
    inside = [discretization_error(random.normal(0.2, 1.0, 5)) > 0.2 for _ in range(200)]
    assert np.mean(inside) > 0.95


@pytest.mark.long
def test_means_over_revolutions_are_those_of_a_finer_tolerance():
    """The statistics alone said +- 0.0013 m/s^2, for 0.18 from runs at a hundredth of it."""
    scene = Scene(mechanism="slider_crank")
    names = [NAME, "joints.wrist_pin.peak_force", "peak_acceleration.mean_1ms", "peak_velocity"]
    rough = distributions(scene, names, tolerance=1.0, minimum=10, maximum=10)
    fine = distributions(
        scene.replace({"solver.tolerance": 1e-5}), names, tolerance=1.0, minimum=10, maximum=10
    )
    for name in names:
        (value, error), (true, _) = rough[name].mean, fine[name].mean
        assert abs(value - true) <= error, name
        assert error <= 0.05 * value
