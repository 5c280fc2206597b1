"""A mass that bounces in a real Exudyn joint delivers the restitution that its law alone does."""

import exudyn as exu
import numpy as np
import pytest
from exudyn.itemInterface import ObjectGround
from solving import fixed_steps, planar_body, recorded, solve

from exu_press import add_dry_revolute
from exu_press.laws.contact import (
    DAMPING_LAWS,
    delivered_restitution,
    hertz,
    step_damping,
)
from exu_press.laws.friction import no_friction


def bounce(contact, mass, speed, duration, step=1e-6, clearance=1e-4):
    """Return rebound over approach speed of a body in a clearance around a point of the ground."""
    container = exu.SystemContainer()
    mbs = container.AddSystem()
    body, node = planar_body(mbs, mass, 1.0, (0.99 * clearance, 0, 0), (speed, 0, 0))
    ground = mbs.AddObject(ObjectGround())
    add_dry_revolute(
        mbs, (body, (0, 0)), (ground, (0, 0)), radius=0.05, clearance=clearance,
        contact=contact, friction=no_friction(),
    )  # fmt: skip
    velocity = recorded(mbs, node, "Coordinates_t")
    mbs.Assemble()
    settings = fixed_steps(duration, step)
    settings.timeIntegration.newton.modifiedNewtonJacUpdatePerStep = True
    solve(mbs, settings)
    return -np.asarray(mbs.GetSensorStoredData(velocity))[:, 1].min() / speed


@pytest.mark.parametrize(("law", "wanted"), [("flores", 0.1), ("hu_guo", 0.9)])
def test_hysteretic_laws(law, wanted):
    contact = DAMPING_LAWS[law](hertz(1e10), restitution=wanted)
    expected = delivered_restitution(contact, mass=1.0, speed=0.5)
    assert bounce(contact, 1.0, 0.5, 1.2e-3) == pytest.approx(expected, abs=1e-3)


def test_an_almost_undamped_contact_gives_everything_back():
    """c_max = 0.01 N s/m at the press's stiffness and the slider's mass."""
    speed = 0.5
    contact = step_damping(hertz(2.5545e10), damping_max=0.01, damping_depth=1e-5)
    assert delivered_restitution(contact, 1347.0, speed) == pytest.approx(1.0, abs=1e-6)
    assert bounce(contact, 1347.0, speed, 7.5e-3, step=2e-6) == pytest.approx(1.0, abs=1e-4)
