"""Interpolation error of a force between two points, in the middle of a step."""

from types import SimpleNamespace

import numpy as np
import pytest

from exu_press.integrate.criteria.interpolated_force import InterpolatedForceError

TASK = SimpleNamespace(tolerance=1e-3)


def error_of(motion, force, step):
    """Return the error of a step in the middle of a motion (time -> r, v) about time 0."""
    now = [-0.5 * step]
    criterion = InterpolatedForceError(TASK, lambda: motion(now[0]), force)
    criterion.accept_step()
    now[0] = 0.5 * step
    return criterion.error(step)


def cubic(t):
    return np.array([1.0 + t + t**3, 2.0 - t**2]), np.array([1.0 + 3.0 * t**2, -2.0 * t])


@pytest.mark.parametrize("of_rate", [0.0, 1.0])
def test_the_middle_of_a_cubic_motion_is_exact(of_rate):
    step = 0.3
    ends = [(1.0 - of_rate) * cubic(t)[0] + of_rate * cubic(t)[1] for t in (-0.15, 0.15)]
    middle = np.array([1.0, 2.0 * (1.0 - of_rate)])
    largest = max(np.hypot(*f) for f in (*ends, middle))
    missed = np.hypot(*(middle - 0.5 * (ends[0] + ends[1])))
    error = error_of(cubic, lambda r, v: (1.0 - of_rate) * r + of_rate * v, step)
    assert error == pytest.approx((missed / (1e-3 * largest)) ** 1.5)


def test_a_force_that_turns_about_within_a_step_is_seen():
    past = lambda t: (np.array([1e-4, t]), np.array([0.0, 1.0]))  # noqa: E731
    assert error_of(past, lambda r, v: r / np.hypot(*r), 0.01) == pytest.approx(1e3**1.5, rel=0.05)


def test_the_error_goes_with_the_cube_of_the_step():
    def force(r, v):
        return r * r

    errors = [error_of(cubic, force, step) for step in (1e-2, 5e-3)]
    assert errors[0] / errors[1] == pytest.approx(8.0, rel=1e-2)
