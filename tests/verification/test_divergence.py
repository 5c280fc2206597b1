"""From when on runs of a scene have nothing in common, and how fast neighbours part."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from exu_press import Scene, simulate
from exu_press.scene import mechanism_of
from exu_press.verification.divergence import DIVERGED, divergence
from exu_press.verification.estimate import error_ratio, single_difference_factor
from exu_press.verification.growth import growth

PLAY = 1e-4
LOOSE = Scene(
    mechanism="slider_crank", joints={}, revolutions=0.2, guide={"clearance": PLAY, "length": 0.2}
)


HALF, FOUR, EIGHT = (error_ratio(LOOSE, ratio) for ratio in (0.5, 4.0, 8.0))
ACROSS = int(np.argmax(np.abs(mechanism_of(LOOSE).guides[0].normal)))


@pytest.fixture(scope="module")
def run():
    return simulate(LOOSE)


def moved(result, column, amount):
    """Return a run whose slider moves away, from next to nothing on to `amount` at its end."""
    values = result["body_position"].copy()
    values[:, result.bodies.index("slider"), column] += amount * np.geomspace(
        1e-6, 1.0, len(values)
    )
    return result.with_values({"body_position": values})


def horizon(result, others):
    return divergence(result, others).growth.horizon


@pytest.mark.parametrize(("column", "part"), [(ACROSS, 1.0), (2, 10.0)], ids=["across", "tilted"])
def test_a_body_that_is_elsewhere_between_its_ways_has_parted(run, column, part):
    """The ends of a body that tilts are about half its length away."""
    assert horizon(run, {FOUR: moved(run, column, 0.9 * part * DIVERGED * PLAY / 2**0.5)}) is None
    found = horizon(run, {FOUR: moved(run, column, part * DIVERGED * PLAY)})
    assert 0.9 * run.time[-1] < found <= run.time[-1]
    for side in (1.0, -1.0):  # on one of them its upper end is where it was
        tilted = moved(run, 2, 10.0 * side * DIVERGED * PLAY)
        assert horizon(run, {FOUR: moved(tilted, ACROSS, DIVERGED * PLAY)}) is not None


def test_one_that_is_ahead_has_not(run):
    assert horizon(run, {FOUR: moved(run, 1 - ACROSS, PLAY)}) is None


@pytest.mark.parametrize(("ratio", "parted"), [(0.5, True), (0.25, False), (9.0, False)])
def test_errors_go_with_a_power_of_the_tolerance(run, ratio, parted):
    found = horizon(run, {error_ratio(LOOSE, ratio): moved(run, ACROSS, 0.33 * DIVERGED * PLAY)})
    assert (found is not None) is parted


def test_a_run_at_half_the_tolerance_vouches_for_less_where_a_coarser_one_has_diverged(run):
    """One difference is small by chance more often than two."""
    near = moved(run, ACROSS, 1.1 * DIVERGED * PLAY / single_difference_factor(HALF))
    beside, away = (moved(run, ACROSS, part * DIVERGED * PLAY) for part in (0.6, 1.5))
    found = divergence(run, {HALF: near, EIGHT: beside})
    assert found.growth.horizon is None
    assert found.nearest == 0.0
    found = divergence(run, {HALF: near, EIGHT: away})
    assert 0.9 * run.time[-1] < found.growth.horizon <= run.time[-1]
    assert found.nearest == single_difference_factor(HALF)
    assert found.distances[EIGHT] > found.distances[HALF] > 0.0


def test_a_run_that_was_beside_by_chance_vouches_for_less_still(run):
    """When the coarser one diverged, its distance told an error twelve times the other's."""
    near, away = (moved(run, ACROSS, part * PLAY) for part in (0.035, 10.0 * DIVERGED))
    found = divergence(run, {HALF: near, EIGHT: away})
    part = 0.035 / (10.0 * DIVERGED)  # of the coarser one's distance, at all times
    assert found.nearest == pytest.approx(1.0 / ((EIGHT - 1.0) * part), rel=0.1)
    assert found.growth.horizon is not None
    assert found.distances[EIGHT] == pytest.approx(10.0 * DIVERGED * 2.0**0.5)


LORENZ_EXPONENT = 0.9056
"""Largest Lyapunov exponent at sigma = 10, rho = 28, beta = 8/3 (J. C. Sprott, Chaos and
Time-Series Analysis, Oxford 2003, Table A.3)."""


def lorenz(_time, state):
    x, y, z = state.reshape(3, -1)
    return np.concatenate([10.0 * (y - x), x * (28.0 - z) - y, x * y - 8.0 / 3.0 * z])


@pytest.mark.long
def test_lorenz_system():
    """Sixty pairs that start 1e-9 apart on the attractor."""
    pairs, time = 60, np.linspace(0.0, 20.0, 2001)
    random = np.random.default_rng(1)
    start = random.normal(0.0, 1.0, 3 * pairs) + np.repeat([1.0, 1.0, 20.0], pairs)
    on = solve_ivp(lorenz, (0.0, 30.0), start, rtol=1e-8).y[:, -1]
    both = np.stack([on.reshape(3, -1), on.reshape(3, -1) + 1e-9], axis=2).reshape(3, -1)
    run = solve_ivp(lorenz, (0.0, 20.0), both.ravel(), t_eval=time, rtol=1e-12, atol=1e-12)
    states = run.y.reshape(3, pairs, 2, -1)
    distance = np.linalg.norm(states[:, :, 0] - states[:, :, 1], axis=0)
    found = growth(time, distance, diverged_distance=1.0)
    assert found.rate == pytest.approx(LORENZ_EXPONENT, rel=0.05)
    assert found.horizon == pytest.approx(np.log(1.0 / 2e-9) / LORENZ_EXPONENT, rel=0.1) or (
        found.horizon is None
    )


def test_motions_that_stay_together_say_nothing():
    """Two runs never more than 1e-9 m apart, in a clearance of 1e-4 m, gave 3.9 1/s."""
    time = np.linspace(0.0, 1.0, 1001)
    found = growth(time, 1e-9 / 1e-4 * np.exp(3.9 * (time - 1.0)) * 1.0, diverged_distance=0.3)
    assert found.rate is None and found.horizon is None
    assert growth(time, np.ones(1001), diverged_distance=0.3).horizon == 0.0
