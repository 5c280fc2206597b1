"""Violations of constraints, and the least change that undoes them."""

import numpy as np
import pytest
from stand_in_system import settings

from exu_press import Scene
from exu_press.integrate.constraints import Constraints, normalise
from exu_press.integrate.scales import ErrorScales
from exu_press.integrate.system import System
from exu_press.integrate.task import SolverTuning, Task


def constraints_of(scene):
    system = System.of_mbs(scene.build().mbs)
    return Constraints(Task(system, settings(), 1e-3, ErrorScales(), SolverTuning()))


def test_directions_have_length_one_and_zeros_stay():
    directions, lengths = normalise(np.array([[3.0, 4.0], [0.0, 0.0]]))
    assert directions.tolist() == [[0.6, 0.8], [0.0, 0.0]]
    assert lengths.tolist() == [5.0, 1.0]


@pytest.mark.parametrize("twice", [False, True])
def test_the_projection_is_the_least_change_in_the_norm_of_masses(twice):
    """x + y = 1 of masses of 1 and 3 kg: the light one takes three quarters; also twice."""
    constraints = constraints_of(Scene(mechanism="slider_crank", joints={}))
    directions, lengths = normalise(np.array([[1.0, 1.0]] * (2 if twice else 1)))
    project = constraints.projection(np.diag([1.0, 3.0]), directions)
    change = project(np.ones((len(directions), 1)) / lengths[:, None])
    assert change[:, 0] == pytest.approx([0.75, 0.25], rel=1e-6)


def test_a_matrix_that_cannot_be_inverted_projects_nowhere():
    constraints = constraints_of(Scene(mechanism="slider_crank", joints={}))
    project = constraints.projection(np.full((2, 2), np.nan), np.array([[1.0, 0.0]]))
    assert np.isnan(project(np.ones((1, 1)))).all()
