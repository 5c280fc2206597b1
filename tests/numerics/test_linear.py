"""Sparse and dense ways give the same unknowns, and name the same failure."""

import numpy as np
import pytest
from threadpoolctl import threadpool_info

from exu_press.numerics import linear
from exu_press.numerics.linear import SPARSE_FROM, Equations
from exu_press.numerics.threads import one_thread


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


def test_many_unknowns_take_the_sparse_way(monkeypatch):
    monkeypatch.setattr(np.linalg, "solve", None)
    assert Equations(saddle(SPARSE_FROM)).solve(np.zeros(SPARSE_FROM)).max() == 0.0


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
