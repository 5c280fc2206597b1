"""Local error of velocities, against closed forms."""

import math
from types import SimpleNamespace

import numpy as np
import pytest
from patched import PATCHED
from stand_in_system import system_at

from exu_press.integrate.criteria.velocity import PrescribedVelocityError, VelocityError
from exu_press.integrate.scales import ErrorScales, RunningScales
from exu_press.integrate.system import Node
from exu_press.integrate.task import SolverTuning

pytestmark = PATCHED
LIMIT = 1e-3
ROUNDOFF = 1e-13


class Filter:
    """A filter that lets a part of a change through."""

    def __init__(self, part=1.0, roundoff=0.0):
        self.part, self.roundoff = part, roundoff

    def refresh(self):
        pass

    def filter_change(self, change):
        return [self.part * value for value in change]

    def begin_step(self):
        pass

    def roundoff_of_constraints(self):
        return self.roundoff


def task_of(masses=(2.0,)):
    """Bodies that rest, each of one mass and a moment of inertia of 0.5, at a speed of 1 m/s."""
    nodes = [Node(i, "", 3 * i, 3, mass) for i, mass in enumerate(masses)]
    system = system_at(nodes, np.zeros(3 * len(masses)), np.zeros(3 * len(masses)))
    scales = RunningScales(ErrorScales(speed=1.0, force=1.0), system, longest=1.0)
    scales.begin(np.diag([value for mass in masses for value in (mass, mass, 0.5)]))
    scales.roundoff = ROUNDOFF
    return SimpleNamespace(system=system, scales=scales, tuning=SolverTuning(), tolerance=LIMIT)


def errors(accelerations, step=0.01, masses=(2.0,), make=None, **keys):
    """Errors of steps from rest that end with these accelerations, in turn."""
    task = task_of(masses)
    criterion = make(task) if make else VelocityError(task, Filter(**keys), LIMIT)
    criterion.restart()
    values = []
    for now in accelerations:
        task.system.current.accelerations[:] = now
        values.append(criterion.error(step))
        criterion.accept_step()
    return values


def test_velocities_are_off_by_the_cube_of_the_step():
    """a = b t^2: its second derivative is 2 b."""
    b, h = 3.0, 0.01
    rows = [[0.0, b * (i * h) ** 2, 0.0] for i in range(1, 5)]
    assert errors(rows, h)[-1] == pytest.approx(h**3 * 2.0 * b / LIMIT)


def test_rotations_count_by_their_energy():
    """An angular acceleration counts sqrt(J/m) of it."""
    (turning,) = errors([[0.0, 0.0, 4.0]])
    (moving,) = errors([[4.0 * math.sqrt(0.5 / 2.0), 0.0, 0.0]])
    assert turning == pytest.approx(moving)


def test_what_is_excluded_and_what_rounding_makes():
    assert errors([[1e3, 1e3, 0.0]], masses=(math.inf,)) == [0.0]
    step = 1e-8
    rounding = 0.99 * ROUNDOFF / step**2
    assert errors([[rounding, 0.0, 0.0]], step)[0] < 1.0
    large = [[1e3, 0.0, 0.0]]
    assert errors(large)[0] > 1.0 > errors(large, roundoff=1.0)[0]


def test_newtons_matrix_filters_what_is_too_large():
    """Constraints, films and contacts undo the rest; what is small enough is not filtered."""
    whole, part = (errors([[1e3, 0.0, 0.0]], part=share)[0] for share in (1.0, 0.25))
    assert part == pytest.approx(0.25 * whole)
    assert errors([[1e-3, 0.0, 0.0]], part=0.0)[0] > 0.0


def test_velocities_as_prescribed_are_off_by_the_square_of_the_step():
    """h^2 |da/dt| / 12, against the tolerance itself; less than what rounding makes is nothing."""
    h, rate = 0.01, 30.0
    found = errors([[rate * h, 0.0, 0.0]], h, make=PrescribedVelocityError)[0]
    assert found == pytest.approx((h * h * rate / 12.0 / LIMIT) ** 1.5)
    h = 1e-8
    for size in (0.9, 1.1):
        change = 2.0 * size * ROUNDOFF / h**2
        counts = errors([[change, 0.0, 0.0]], h, make=PrescribedVelocityError)[0] > 0.0
        assert counts is (size > 1.0)
