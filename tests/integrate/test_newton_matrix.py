"""Newton's matrix as a filter of errors."""

from types import SimpleNamespace

import numpy as np
import pytest
from patched import PATCHED

from exu_press.integrate.criteria.newton_matrix import NewtonMatrix
from exu_press.integrate.settings import LARGE


def solver_of(jacobian, mass):
    """A solver that has made one Jacobian so far."""
    return SimpleNamespace(
        GetSystemMassMatrix=lambda: mass,
        GetSystemJacobian=lambda: jacobian,
        GetODE1size=lambda: 0,
        GetAEsize=lambda: len(jacobian) - len(mass),
        it=SimpleNamespace(newtonJacobiCount=1),
        alphaM=0.0,
        alphaF=0.0,
    )


def matrix_of(solver, size, joints=None, switching=False):
    problem = SimpleNamespace(current=SimpleNamespace(accelerations=np.zeros(size)), joints=joints)
    impacts = joints is not None or switching
    return NewtonMatrix(
        SimpleNamespace(solver=solver, scales=None, problem=problem, impacts=impacts)
    )


@PATCHED
@pytest.mark.parametrize("joints", [None, object()])
@pytest.mark.parametrize("twice", [False, True])
def test_a_constraint_that_says_the_same_twice_filters_like_one(twice, joints):
    """Of two equal masses the first one is held, and the second one keeps its error."""
    constraints = np.array([[1.0, 0.0]] * (2 if twice else 1))
    count = len(constraints)
    jacobian = np.block([[np.eye(2), constraints.T], [constraints, np.zeros((count, count))]])
    matrix = matrix_of(solver_of(jacobian, np.eye(2)), 2, joints)
    assert matrix.renew()
    (left,) = matrix.filtered([3.0, 5.0])
    assert left == pytest.approx([0.0, 5.0])


@PATCHED
def test_an_earlier_matrix_filters_steps_of_one_size_until_it_fails():
    """Then one step goes by without a try, after the next failure two."""
    solver = solver_of(np.eye(LARGE), np.eye(LARGE))
    matrix = matrix_of(solver, LARGE)
    steps = 0

    def serves(step, enough):
        nonlocal steps
        steps += 1
        solver.it.newtonJacobiCount += 1
        served = matrix.serves(step)
        if not (served and enough):
            assert matrix.renew()
        assert matrix.filtered([float(steps)] * LARGE)[0] == pytest.approx([steps] * LARGE)
        return served

    assert not serves(0.1, enough=True)
    assert all(serves(0.1, enough=True) for _ in range(5))
    assert not serves(0.2, enough=True)
    assert serves(0.2, enough=False)
    assert not serves(0.2, enough=True)
    assert serves(0.2, enough=False)
    assert [serves(0.2, enough=True) for _ in range(3)] == [False, False, True]


@PATCHED
@pytest.mark.parametrize("what", [{"size": LARGE - 1}, {"joints": object()}, {"switching": True}])
def test_small_matrices_and_those_that_contacts_change_are_taken_anew(what):
    given = {"size": LARGE, **what}
    size = given["size"]
    matrix = matrix_of(solver_of(np.eye(size), np.eye(size)), **given)
    assert not any(matrix.serves(0.1) for _ in range(3))
