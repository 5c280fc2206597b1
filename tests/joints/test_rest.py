"""At rest under gravity a journal sits at the penetration the Hertz law gives; a film keeps it."""

import exudyn as exu
import numpy as np
import pytest
from exudyn.itemInterface import (
    LoadMassProportional,
    MarkerBodyMass,
    ObjectGround,
)
from solving import fixed_steps, planar_body, solve
from state_in import state_in

from exu_press import (
    add_dry_revolute,
    add_dry_spherical,
)
from exu_press.laws.contact import hertz, step_damping
from exu_press.laws.friction import no_friction

STIFFNESS, CLEARANCE = 2.5545e10, 1e-4


@pytest.mark.parametrize("add", [add_dry_revolute, add_dry_spherical])
@pytest.mark.parametrize("mass", [50.0, 1500.0])
def test_penetration_at_rest(add, mass):
    """(m g / K)^(2/3), to 1e-3; the damping is chosen to settle within the run."""
    mbs = exu.SystemContainer().AddSystem()
    ground = mbs.AddObject(ObjectGround())
    body, node = planar_body(mbs, mass, 1.0, (0.0, -CLEARANCE, 0.0))
    marker = mbs.AddMarker(MarkerBodyMass(bodyNumber=body))
    mbs.AddLoad(LoadMassProportional(markerNumber=marker, loadVector=[0.0, -9.81, 0.0]))
    depth = (mass * 9.81 / STIFFNESS) ** (2 / 3)
    critical = 2 * np.sqrt(mass * 1.5 * STIFFNESS * np.sqrt(depth))
    joint = add(
        mbs,
        (body, (0.0, 0.0)),
        (ground, (0.0, 0.0)),
        radius=0.07,
        clearance=CLEARANCE,
        contact=step_damping(hertz(STIFFNESS), critical, depth),
        friction=no_friction(),
    )
    mbs.Assemble()
    settings = fixed_steps(0.05, 2e-5)
    settings.timeIntegration.generalizedAlpha.spectralRadius = 0.8
    solve(mbs, settings)
    q = list(mbs.GetNodeOutput(node, exu.OutputVariableType.Coordinates))
    q_t = list(mbs.GetNodeOutput(node, exu.OutputVariableType.Coordinates_t))
    ground_coordinates = [0.0, 0.0, 0.0]
    state = state_in(joint, [*q, *ground_coordinates], [*q_t, *ground_coordinates])
    assert -state.eccentricity[1] - CLEARANCE == pytest.approx(depth, rel=1e-3)
    assert abs(q_t[1]) < 1e-6, "it has come to rest"
    assert state.force[1] == pytest.approx(mass * 9.81, rel=1e-3)
