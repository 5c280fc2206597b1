"""Steps of one size keep to their grid."""

import numpy as np

from exu_press import Scene, simulate
from exu_press.integrate.stepping import FixedSteps


def test_fixed_steps_return_to_their_grid_after_a_halved_one(monkeypatch):
    scene = Scene(
        joints={"crank_pin": "ideal", "balls": "ideal"}, revolutions=0.1, solver={"step": 2e-4}
    )
    failed = []

    def fail_one(control, time):
        if time > 5e-3 and not failed:
            failed.append(time)
            return [2.0, -1.0]
        return [0.0, -1.0]

    monkeypatch.setattr(FixedSteps, "after_newton", fail_one)
    time = simulate(scene).time
    on_grid = np.abs(time / 2e-4 - np.round(time / 2e-4)) < 1e-6
    assert failed and 1 <= (~on_grid).sum() <= 2
    assert on_grid[-50:].all()
