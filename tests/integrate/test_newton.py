"""Where Newton's method starts may change what a run costs, not what comes out."""

import numpy as np
import pytest
from patched import PATCHED

from exu_press import Scene, Tuning, simulate
from exu_press.integrate.newton import Newton
from exu_press.result import record
from exu_press.scene import flexible_press


def tuned(scene, **numbers):
    model = scene.build()
    return record(model, model.solve(tuning=Tuning(**numbers)))


@PATCHED
@pytest.mark.parametrize("pin", ["lubricated", "dry"])
def test_expected_accelerations_save_iterations(pin, monkeypatch):
    scene = Scene(joints={"crank_pin": pin, "balls": "dry"}, revolutions=0.1, solver={"step": 5e-5})
    guided = simulate(scene)
    monkeypatch.setattr(Newton, "_advance", lambda newton, step: None)
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
        revolutions=0.02,
    )
    forgiving = simulate(thin)
    strict = tuned(thin, rounding=0.0)
    assert forgiving.completed
    assert not strict.completed


def test_euler_parameters_are_expected_on_their_unit_sphere():
    """Else one iteration leaves something in the constraints, whose forces alternate."""
    pytest.importorskip("ngsolve")
    run = simulate(
        Scene(
            bodies=flexible_press(modes=4),
            joints={"crank_pin": "ideal", "balls": "ideal"},
            revolutions=0.2,
        )
    )
    assert run.completed
    assert run.info["newton_iterations"] < 1.1 * run.info["steps"]
    force = np.linalg.norm(run.joints["counterweight_pin"].force, axis=1)
    assert np.abs(np.diff(force, 2)).max() < 0.02 * force.max()
