"""Guides and pivots: their forces from equilibrium are those of constraints in their place."""

import numpy as np
import pytest

from exu_press import Scene, simulate
from exu_press.mechanism import Mechanism

PULSE = {"force": 1e5, "eccentricity": 0.05, "rise": 2e-3, "fall": 1e-3, "end_angle_deg": 10.0}
SCENES = {
    "ideal press": {"joints": {}},
    "one-sided load": {"joints": {}, "blanking": PULSE},
    "lubricated pin, dry balls": {
        "joints": {"crank_pin": "lubricated", "balls": "dry"},
        "blanking": PULSE,
    },
    "dry pin": {"joints": {"crank_pin": "dry", "balls": "dry"}},
    "slider-crank": {"mechanism": "slider_crank", "joints": {}},
    "flexible": {"bodies": "flexible", "joints": {}, "flexible": {"modes": 4, "mesh_size": 0.05}},
}
STEPS = {"step": 2e-5}


def run(scene):
    return simulate(Scene(**scene, revolutions=0.03, solver=STEPS))


def hold_all(monkeypatch, flexible):
    """Give all bodies x, y and angle, and hold them by constraints; a crank shaft has bearings."""
    pivoted = Mechanism.pivoted
    kept = {"crank"} if flexible else set()

    def only(mechanism, ideal):
        return {k: v for k, v in pivoted(mechanism, ideal).items() if k in kept}

    monkeypatch.setattr(Mechanism, "pivoted", only)
    monkeypatch.setattr(Mechanism, "sliding", frozenset())


@pytest.mark.parametrize("name", SCENES)
def test_forces_are_those_of_constraints(name, monkeypatch):
    free = run(SCENES[name])
    hold_all(monkeypatch, "flexible" in SCENES[name])
    constrained = run(SCENES[name])
    assert free.info["coordinates"] < constrained.info["coordinates"]
    assert set(free) == set(constrained)
    settled = free.time > 1e-3  # a film that takes up its load makes the accelerations ring
    for channel in free:
        expected = constrained[channel][settled]
        tilts = channel in ("slider_tilt", "slider_lateral")  # rounding, where constraints hold it
        scale = 1.0 if tilts else np.abs(expected).max()
        if "moment" in channel or channel.endswith("guide_force"):  # of the mechanism's forces
            scale = np.abs(constrained["crank_pin_force"][settled]).max()
        assert free[channel][settled] == pytest.approx(expected, abs=3e-4 * scale), channel
