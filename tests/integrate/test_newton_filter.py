"""Newton's matrix as a filter of errors."""

from types import SimpleNamespace

import numpy as np
import pytest
from patched import PATCHED

from exu_press.integrate.newton_filter import NewtonFilter

pytestmark = PATCHED

ROUNDING = 4e-15


def filter_of(constraints, violation=0.0):
    """A filter by the matrix of two masses of 1 kg with constraints (count, 2).

    The start violates each of them.
    """
    count = len(constraints)
    jacobian = np.block([[np.eye(2), constraints.T], [constraints, np.zeros((count, count))]])
    solver = SimpleNamespace(
        GetSystemMassMatrix=lambda: np.eye(2),
        GetSystemJacobian=lambda: jacobian,
        ComputeAlgebraicEquations=lambda mbs, **_: None,
        GetSystemResidual=lambda: np.full(2 + count, violation),
        it=SimpleNamespace(newtonJacobiCount=1),
        alphaM=0.0,
        alphaF=0.0,
    )
    scales = SimpleNamespace(length=3.0, norm=max)
    data = SimpleNamespace(GetTime=lambda *_: 0.0, SetTime=lambda time: None)
    current = SimpleNamespace(positions=np.zeros(2), multipliers=np.zeros(count))
    system = SimpleNamespace(
        current=current, start=None, data=data, mbs=None, length=3.0, rates_not_provided=False
    )
    tuning = SimpleNamespace(rounding=ROUNDING, regularisation=1e-8)
    task = SimpleNamespace(solver=solver, scales=scales, system=system, tuning=tuning)
    newton_filter = NewtonFilter(task)
    newton_filter.begin_step()
    return newton_filter


@pytest.mark.parametrize("count", [1, 2])
def test_a_redundant_constraint_filters_like_one(count):
    """Of two equal masses the first one is held, and the second one keeps its error."""
    newton_filter = filter_of(np.array([[1.0, 0.0]] * count))
    assert newton_filter.filter_change([3.0, 5.0]) == pytest.approx([0.0, 5.0])


@pytest.mark.parametrize(
    ("angle", "violation", "moved"),
    [(0.5 * np.pi, 0.0, 1.0), (1e-3, 0.0, 2e3), (1e-3, 5e-14, 2e3)],
)
def test_nearly_redundant_constraints_move_bodies_far_by_their_last_digits(angle, violation, moved):
    """Also by what Newton's method left at the start: a press's links that line up by 2 nm."""
    directions = np.array([[1.0, 0.0], [np.cos(angle), np.sin(angle)]])
    newton_filter = filter_of(directions, violation)
    expected = (ROUNDING * 3.0 + violation) * moved
    assert newton_filter.roundoff_of_constraints() == pytest.approx(expected, rel=1e-3)


def test_redundant_constraints_have_no_roundoff():
    assert filter_of(np.array([[1.0, 0.0]] * 2)).roundoff_of_constraints() == 0.0
