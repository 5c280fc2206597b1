"""Where Newton's method starts may change what a run costs, not what comes out."""

import numpy as np
import pytest

from exu_press import Scene, simulate
from exu_press.integrate.newton import Newton


@pytest.mark.parametrize("pin", ["lubricated", "dry"])
def test_expected_accelerations_save_iterations(pin, monkeypatch):
    scene = Scene(crank_pin=pin, balls="dry", revolutions=0.1, solver={"step": 5e-5})
    guided = simulate(scene)
    monkeypatch.setattr(Newton, "_advance", lambda newton, step: None)
    plain = simulate(scene)
    assert guided.info["newton_iterations"] < 0.7 * plain.info["newton_iterations"]
    apart = guided["slider_acceleration"] - plain["slider_acceleration"]
    assert np.abs(apart).max() < 1e-3 * np.abs(plain["slider_acceleration"]).max()


def test_nothing_is_left_of_the_tolerance_where_rounding_leaves_more(monkeypatch):
    """A film of 0.1 um makes more of the last digit of a speed than the tolerance allows."""
    thin = Scene(mechanism="slider_crank", clearance={"crank_pin": 1e-7}, revolutions=0.01)
    assert simulate(thin).completed
    monkeypatch.setattr(Newton, "_ask_for", lambda newton, least: None)
    assert not simulate(thin).completed
