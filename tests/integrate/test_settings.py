"""What a run is asked for, and what it sets in Exudyn's settings and puts back."""

import re

import exudyn as exu
import pytest

from exu_press import InputError, Scene
from exu_press.integrate.problem import Problem
from exu_press.integrate.scales import ErrorScales
from exu_press.integrate.settings import SolverTuning, Task, prepared, refuse_unusable
from exudyn_examples import EXAMPLES

LUBRICATED = Scene(mechanism="slider_crank", joints={"crank_pin": "lubricated"})
IDEAL = Scene(mechanism="slider_crank", joints={})


def settings(**changes):
    chosen = exu.SimulationSettings()
    integration = chosen.timeIntegration
    integration.endTime, integration.numberOfSteps = 2.0, 100
    for name, value in changes.items():
        setattr(integration, name, value)
    return chosen


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
    problem = Problem.of(scene.build().mbs)
    task = Task(problem, settings(**changes), tolerance, ErrorScales(), SolverTuning())
    assert task.largest == pytest.approx(0.02)
    assert task.first == pytest.approx(expected)


@pytest.mark.parametrize(("radius", "times"), [(0.8, 25.0), (1.0, 400.0)])
def test_rounding_alternates_by_the_spectral_radius(radius, times):
    """By 1 / (1 - rho)^2, with rho up to 0.95."""
    chosen = settings()
    chosen.timeIntegration.generalizedAlpha.spectralRadius = radius
    scales = Task(
        Problem.of(IDEAL.build().mbs), chosen, None, ErrorScales(), SolverTuning(rounding=1e-15)
    ).scales
    assert scales.alternating == pytest.approx(1e-15 * scales.length * times)


@pytest.mark.parametrize("name", ["slider-crank", "stick-slip"])
def test_settings_are_put_back_even_after_an_error(name):
    mbs = exu.SystemContainer().AddSystem()
    EXAMPLES[name].build(mbs)
    mbs.Assemble()
    chosen = settings()
    discontinuous = chosen.timeIntegration.discontinuous
    own, before = discontinuous.maxIterations, chosen.GetDictionary()
    task = Task(Problem.of(mbs), chosen, 1e-3, ErrorScales(), SolverTuning())
    task.smallest = 1e-7
    with pytest.raises(ZeroDivisionError), prepared(chosen, task):
        assert chosen.timeIntegration.minimumStepSize == 1e-7
        assert chosen.linearSolver.solverType == exu.LinearSolverType.EigenDense
        assert discontinuous.maxIterations == (own if name == "stick-slip" else 1)
        raise ZeroDivisionError
    assert chosen.GetDictionary() == before


@pytest.mark.parametrize("tolerance", [1e-8, 0.1, None])
def test_tolerances_at_their_limits_are_allowed(tolerance):
    refuse_unusable(settings(), tolerance)


@pytest.mark.parametrize("tolerance", [0.99e-8, 0.101, 1, -1e-3])
def test_tolerances_beyond_their_limits_are_refused(tolerance):
    said = f"tolerance = {tolerance}: allowed is a number from 1e-08 to 0.1"
    with pytest.raises(InputError, match=re.escape(said)):
        refuse_unusable(settings(), tolerance)
