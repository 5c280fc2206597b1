"""What a run is asked for, what it sets in Exudyn's settings and puts back, and constraints."""

import exudyn as exu
import numpy as np
import pytest
from stand_in_system import settings

from exu_press import Scene
from exu_press.integrate.constraints import Constraints, normalise
from exu_press.integrate.scales import ErrorScales
from exu_press.integrate.system import System
from exu_press.integrate.task import SolverTuning, Task, prepared_settings

LUBRICATED = Scene(mechanism="slider_crank", joints={"crank_pin": "lubricated"})
IDEAL = Scene(mechanism="slider_crank", joints={})


@pytest.mark.parametrize(
    ("scene", "tolerance", "changes", "expected"),
    [
        (IDEAL, 1e-3, {}, 0.02 / 64.0),
        (LUBRICATED, 1e-3, {}, 2e-6),
        (LUBRICATED, 1e-3, {"minimumStepSize": 1e-6}, 1e-5),  # room to repeat it
        (IDEAL, 1e-3, {"initialStepSize": 1e-5}, 1e-5),
        (IDEAL, 1e-3, {"initialStepSize": 1.0}, 0.02),
        (IDEAL, None, {}, 0.02),
        (LUBRICATED, None, {}, 0.02 / 512.0),
    ],
)
def test_the_first_step(scene, tolerance, changes, expected):
    system = System.of_mbs(scene.build().mbs)
    task = Task(system, settings(2.0, **changes), tolerance, ErrorScales(), SolverTuning())
    assert task.largest == pytest.approx(0.02)
    assert task.first == pytest.approx(expected)


@pytest.mark.parametrize(("radius", "times"), [(0.8, 25.0), (1.0, 400.0)])
def test_rounding_alternates_by_the_spectral_radius(radius, times):
    """By 1 / (1 - rho)^2, with rho up to 0.95."""
    chosen = settings(2.0, generalizedAlpha__spectralRadius=radius)
    system = System.of_mbs(IDEAL.build().mbs)
    task = Task(system, chosen, None, ErrorScales(), SolverTuning(rounding=1e-15))
    size = len(system.current.positions)
    task.scales.begin([[float(i == j) for i in range(size)] for j in range(size)])
    assert task.scales.roundoff == pytest.approx(1e-15 * task.scales.length * times)


def test_settings_are_put_back_even_after_an_error():
    chosen = settings(2.0)
    before = chosen.GetDictionary()
    task = Task(System.of_mbs(IDEAL.build().mbs), chosen, 1e-3, ErrorScales(), SolverTuning())
    task.smallest = 1e-7
    with pytest.raises(ZeroDivisionError), prepared_settings(chosen, task):
        assert chosen.timeIntegration.minimumStepSize == 1e-7
        assert chosen.linearSolver.solverType == exu.LinearSolverType.EigenDense
        assert chosen.timeIntegration.discontinuous.maxIterations == 1
        raise ZeroDivisionError
    assert chosen.GetDictionary() == before


def constraints_of(scene):
    system = System.of_mbs(scene.build().mbs)
    return Constraints(Task(system, settings(), 1e-3, ErrorScales(), SolverTuning()))


@pytest.mark.parametrize("twice", [False, True])
def test_the_projection_is_the_least_change_in_the_norm_of_masses(twice):
    """x + y = 1 of masses of 1 and 3 kg: the light one takes three quarters; also twice."""
    constraints = constraints_of(Scene(mechanism="slider_crank", joints={}))
    directions, lengths = normalise(np.array([[1.0, 1.0]] * (2 if twice else 1)))
    project = constraints.projection(np.diag([1.0, 3.0]), directions)
    change = project(np.ones((len(directions), 1)) / lengths[:, None])
    assert change[:, 0] == pytest.approx([0.75, 0.25], rel=1e-6)
