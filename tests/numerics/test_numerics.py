"""Piecewise cubic polynomials against SciPy's, and linear systems."""

import numpy as np
import pytest
from scipy.integrate import cumulative_trapezoid
from scipy.interpolate import CubicHermiteSpline, CubicSpline
from threadpoolctl import threadpool_info

from exu_press.numerics import linear
from exu_press.numerics.linear import SPARSE_FROM, Equations
from exu_press.numerics.piecewise import eno_cubic, evaluate, hermite, integral, spline
from exu_press.numerics.threads import one_thread

X = np.array([-1.0, -0.4, 0.1, 0.2, 1.0, 1.7])
VALUES = np.array([[2.0, -1.0, 0.5, 0.7, 3.0, 1.0], np.sin(X)])
AT = np.array([-1.5, -1.0, -0.7, 0.1, 0.15, 0.9, 1.7, 2.0])


@pytest.mark.parametrize("ends", ["clamped", "natural", "not-a-knot"])
def test_splines_are_those_of_scipy(ends):
    values = np.moveaxis(np.array([VALUES, VALUES**2, np.exp(VALUES)]), 0, 1)  # another order
    theirs = CubicSpline(X, values, axis=2, bc_type=ends)
    ours = spline(X, values, ends)
    assert np.allclose(ours, np.moveaxis(theirs.c[::-1], 1, -1), rtol=1e-11, atol=1e-11)
    assert np.allclose(evaluate(X, ours, AT), theirs(AT), rtol=1e-11, atol=1e-11)
    assert np.allclose(evaluate(X, ours, AT, derivative=1), theirs(AT, 1), rtol=1e-11, atol=1e-11)


def test_values_and_slopes_are_met_as_by_scipy():
    slopes = np.cos(X)
    theirs = CubicHermiteSpline(X, VALUES[1], slopes)
    assert np.allclose(evaluate(X, hermite(X, VALUES[1], slopes), AT), theirs(AT), rtol=1e-13)


def test_the_integral_is_that_of_straight_lines():
    assert np.allclose(
        integral(X, VALUES[0]), cumulative_trapezoid(VALUES[0], X, initial=0.0), rtol=1e-14
    )


def test_no_event_bends_its_neighbours():
    """A ramp begins and ends, a force jumps: straight beside, and within the samples' range."""
    x = np.sort(np.random.default_rng(1).uniform(0.0, 1.0, 60))
    places = np.linspace(x[0], x[-1], 5001)
    corners = np.clip(x, x[20], x[40])  # corners on samples, as steps end there
    assert np.abs(
        evaluate(x, eno_cubic(x, corners), places) - np.clip(places, x[20], x[40])
    ).max() < (1e-14)
    jump = evaluate(x, eno_cubic(x, x > 0.5), places)
    assert jump.min() > -1e-14 and jump.max() < 1.0 + 1e-14


def test_what_is_smooth_is_cubic():
    errors = []
    for count in (50, 100):
        x = np.linspace(0.0, 1.0, count)
        inside = np.linspace(0.0, 1.0, 5001)
        errors.append(
            np.abs(evaluate(x, eno_cubic(x, np.sin(20 * x)), inside) - np.sin(20 * inside))
        )
    assert 12.0 < errors[0].max() / errors[1].max() < 19.0


def saddle(size):
    """A chain of springs whose first and last point are held by a constraint each."""
    matrix = np.diag(np.full(size, 2.0)) - np.eye(size, k=1) - np.eye(size, k=-1)
    matrix[-2:], matrix[:, -2:] = 0.0, 0.0
    matrix[-2, 0] = matrix[0, -2] = matrix[-1, size - 3] = matrix[size - 3, -1] = 1.0
    return matrix


@pytest.mark.parametrize("columns", [(), (3,)], ids=str)
@pytest.mark.parametrize("size", [8, SPARSE_FROM + 50])
def test_what_is_solved_fits(size, columns):
    matrix, wanted = saddle(size), np.random.default_rng(1).normal(size=(size, *columns))
    equations = Equations(matrix)
    for factor in (1.0, 2.0, 3.0, 4.0):  # a small matrix is inverted on the way
        found = equations.solve(factor * matrix @ wanted)
        assert found == pytest.approx(factor * wanted, abs=1e-9)


@pytest.mark.parametrize("size", [8, SPARSE_FROM])
@pytest.mark.parametrize("value", [0.0, 1.0])
def test_what_cannot_be_solved_is_told(size, value):
    with pytest.raises(np.linalg.LinAlgError):
        linear.Equations(np.full((size, size), value)).solve(np.zeros(size))


def test_linear_algebra_has_one_thread_and_then_its_own_again():
    def threads():  # of NumPy and SciPy; NGSolve, if another test has loaded it, has its own
        libraries = [one for one in threadpool_info() if one["prefix"] == "libscipy_openblas"]
        return [library["num_threads"] for library in libraries]

    before = threads()
    with one_thread():
        assert set(threads()) == {1}
    assert threads() == before
