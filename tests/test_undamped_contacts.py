"""Contacts with Table 2's c_max taken for 0.01 N s/m: they end, resolved, and lose nothing."""

import numpy as np
import pytest

from exu_press import Scene, simulate
from exu_press.scene import flexible_press

UNDAMPED = {
    "joints.crank_pin": "dry",
    "joints.crank_pin.clearance": 1e-5,
    "joints.balls.clearance": 1e-5,
    "contact.damping_max": 0.01,
}


def test_without_friction_the_press_keeps_all_its_energy():
    """Ten impacts and more; what the contacts damp is nothing beside what they store."""
    scene = Scene(revolutions=0.15).replace({**UNDAMPED, "friction.law": "none"})
    result = simulate(scene)
    assert result.info["status"] == "completed", result.info["reason"]
    summary = result.summary()
    assert sum(result.quantity(f"joints.{n}.impacts").value for n in result.clearance_joints) >= 10
    assert summary["quantities"]["energy.residual"]["value"] < 1e-3
    stored = np.abs(result["energy_stored"]).max()
    assert np.abs(result["energy_dissipated"]).max() < 1e-6 * stored


@pytest.mark.long
def test_flexible_bodies_between_undamped_contacts_do_not_ring_numerically():
    """A tolerance of 1e-3 leaves a peak to one step, and says so."""
    fine = {**UNDAMPED, "solver.tolerance": 2e-4}
    result = simulate(Scene(bodies=flexible_press(), revolutions=0.6).replace(fine))
    assert result.info["status"] == "completed", result.info["reason"]
    assert result.quantity("energy.residual").value < 1e-4
