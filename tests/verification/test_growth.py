"""Neighbouring motions part as fast as is known of them."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from exu_press.verification.growth import growth

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


def test_motions_that_stay_together_have_no_horizon():
    time = np.linspace(0.0, 1.0, 100)
    found = growth(time, np.full(100, 1e-6), diverged_distance=0.3)
    assert found.rate is None
    assert found.horizon is None


def test_motions_that_are_apart_at_once():
    time = np.linspace(0.0, 1.0, 100)
    assert growth(time, np.ones(100), diverged_distance=0.3).horizon == 0.0


def test_motions_that_stay_together_say_nothing():
    """Two runs never more than 1e-9 m apart, in a clearance of 1e-4 m, gave 3.9 1/s."""
    time = np.linspace(0.0, 1.0, 1001)
    found = growth(time, 1e-9 / 1e-4 * np.exp(3.9 * (time - 1.0)) * 1.0, diverged_distance=0.3)
    assert found.rate is None and found.horizon is None
