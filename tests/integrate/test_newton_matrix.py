"""Newton's matrix as a filter of errors."""

from types import SimpleNamespace

import numpy as np
import pytest
from patched import PATCHED

from exu_press.integrate.criteria.newton_matrix import NewtonMatrix


@PATCHED
@pytest.mark.parametrize("joints", [None, object()])
@pytest.mark.parametrize("twice", [False, True])
def test_a_constraint_that_says_the_same_twice_filters_like_one(twice, joints):
    """Of two equal masses the first one is held, and the second one keeps its error."""
    constraints = np.array([[1.0, 0.0]] * (2 if twice else 1))
    count = len(constraints)
    jacobian = np.block([[np.eye(2), constraints.T], [constraints, np.zeros((count, count))]])
    solver = SimpleNamespace(
        GetSystemMassMatrix=lambda: np.eye(2),
        GetSystemJacobian=lambda: jacobian,
        GetODE1size=lambda: 0,
        GetAEsize=lambda: count,
        it=SimpleNamespace(newtonJacobiCount=1),
        alphaM=0.0,
        alphaF=0.0,
    )
    problem = SimpleNamespace(current=SimpleNamespace(accelerations=np.zeros(2)), joints=joints)
    matrix = NewtonMatrix(SimpleNamespace(solver=solver, scales=None, problem=problem))
    (left,) = matrix.filtered([3.0, 5.0])
    assert left == pytest.approx([0.0, 5.0])
