"""A step's first guess and Newton's matrix change only what a run costs."""

from importlib.util import find_spec

import numpy as np
import pytest
from coarse_parts import COARSE
from patched import PATCHED

from exu_press import Scene, SolverTuning, simulate
from exu_press.integrate.predictor import Predictor
from exu_press.result import record
from exu_press.scene import flexible_press

NGSOLVE = pytest.mark.skipif(find_spec("ngsolve") is None, reason="flexible parts need NGSolve")


def tuned(scene, **numbers):
    model = scene.build()
    return record(model, model.solve(tuning=SolverTuning(**numbers)))


@PATCHED
def test_expected_accelerations_save_iterations(monkeypatch):
    joints = {"crank_pin": "lubricated", "balls": "dry"}
    scene = Scene(joints=joints, revolutions=0.03, solver={"step": 5e-5})
    guided = simulate(scene)
    monkeypatch.setattr(Predictor, "_predict", lambda guide, step: None)
    plain = simulate(scene)
    assert guided.info["newton_iterations"] < 0.7 * plain.info["newton_iterations"]
    apart = guided["slider_acceleration"] - plain["slider_acceleration"]
    assert np.abs(apart).max() < 1e-3 * np.abs(plain["slider_acceleration"]).max()


def test_what_rounding_leaves_is_not_iterated_on():
    """A film of 30 nm makes more of the last digit of a speed than the tolerance allows."""
    thin = Scene(
        film={"law": "pinkus"},
        joints={
            "crank_pin": {"kind": "lubricated", "clearance": 3e-8},
            "balls": {"kind": "dry", "clearance": 1e-4},
        },
        revolutions=0.01,
    )
    forgiving = simulate(thin)
    strict = tuned(thin, rounding=0.0)
    assert forgiving.completed
    assert not strict.completed


@NGSOLVE
def test_euler_parameters_are_expected_on_their_unit_sphere():
    """Else one iteration leaves something in the constraints, whose forces alternate."""
    run = simulate(
        Scene(
            bodies=COARSE,
            joints={"crank_pin": "ideal", "balls": "ideal"},
            revolutions=0.1,
        )
    )
    assert run.completed
    assert run.info["newton_iterations"] < 1.1 * run.info["steps"]
    force = np.linalg.norm(run.joints["counterweight_pin"].force, axis=1)
    assert np.abs(np.diff(force, 2)).max() < 0.02 * force.max()


@NGSOLVE
@pytest.mark.long
def test_no_alternation_grows_from_what_newtons_method_leaves_in_the_constraints():
    """One iteration a step ends with the counterweight at +-11 m/s^2 about -10, and worse."""
    result = simulate(Scene(bodies=flexible_press(), joints={}, revolutions=0.55))
    assert result.completed, result.summary()["reason"]
    force = result["counterweight_pin_force"][:, 1]
    assert np.abs(np.diff(force, 2)).max() < 0.05 * np.abs(force).max()
