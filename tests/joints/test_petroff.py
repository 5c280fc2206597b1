"""A film's drag in a joint: Petroff's free rotor, and what the drive has to make up for."""

import math

import exudyn as exu
import numpy as np
import pytest
from exudyn.itemInterface import (
    NodeRigidBodyEP,
    ObjectGround,
    ObjectRigidBody,
)
from stand_in_system import planar_body, recorded, settings

from exu_press import add_joint_sensor, add_lubricated_revolute
from exu_press.laws.contact import hertz, step_damping
from exu_press.laws.film import (
    finite,
    pi_film,
    pinkus,
    short,
    with_asperities,
)

VISCOSITY, LENGTH, RADIUS, CLEARANCE = 0.4, 0.1, 0.07, 1e-4
INERTIA = 0.5
PETROFF = 2.0 * math.pi * VISCOSITY * LENGTH * RADIUS**3 / CLEARANCE  # N m s
LAWS = {"pinkus": pinkus(), "pi_film": pi_film(), "short": short(0.7), "finite": finite(0.71)}


def rotor(kind, **film):
    """A free rotor at 25 rad/s, centred in a bearing that stands still."""
    container = exu.SystemContainer()
    mbs = container.AddSystem()
    ground = mbs.AddObject(ObjectGround())
    if kind == "2D":
        body, node = planar_body(mbs, 50.0, INERTIA, velocity=(0.0, 0.0, 25.0))
    else:
        node = mbs.AddNode(
            NodeRigidBodyEP(
                referenceCoordinates=[0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0],
                initialVelocities=[0.0] * 6 + [12.5],
            )
        )
        inertia = [INERTIA, INERTIA, INERTIA, 0.0, 0.0, 0.0]
        body = mbs.AddObject(ObjectRigidBody(nodeNumber=node, mass=50.0, inertia=inertia))
    geometry = {"radius": RADIUS, "clearance": CLEARANCE}
    joint = add_lubricated_revolute(
        mbs, (body, (0.0, 0.0, 0.0)), (ground, (0.0, 0.0, 0.0)),
        **geometry, length=LENGTH, viscosity=VISCOSITY, **film,
    )  # fmt: skip
    spin = recorded(mbs, node, "AngularVelocity")
    sensor = add_joint_sensor(mbs, joint)
    mbs.Assemble()
    chosen = settings(0.5, 500, period=0.0, newton__useModifiedNewton=False)
    mbs.SolveDynamic(chosen, showHints=False)
    spins = np.asarray(mbs.GetSensorStoredData(spin))
    return spins[:, 0], spins[:, -1], np.asarray(mbs.GetSensorStoredData(sensor))[:, -1]


@pytest.mark.validation(
    "closed form",
    "free rotor, braked by the oil of a centred bearing",
    "N. P. Petroff (1883): exponential decay of the speed",
    "equation",
)
@pytest.mark.parametrize(
    ("kind", "law"), [*(("2D", law) for law in (*LAWS, "mixed")), ("EP", "mixed")]
)
def test_petroff_brakes_a_free_rotor(kind, law, compare):
    """25 to 10.6 rad/s in half a second; what it loses is what the joint dissipates."""
    film = {"law": with_asperities(finite(0.71), 0.02) if law == "mixed" else LAWS[law]}
    if law == "mixed":
        film |= {"contact": step_damping(hertz(1e9), 1e4, 1e-5), "asperity_onset": 2e-6}
    time, spin, power = rotor(kind, **film)
    closed = 25.0 * np.exp(-PETROFF / INERTIA * time)
    compare("angular velocity", closed, spin, error=None, rel=1e-4, unit="rad/s")
    assert spin[-1] == pytest.approx(10.6, abs=0.05)
    assert power == pytest.approx(PETROFF * spin**2, rel=1e-9)
    lost = 0.5 * INERTIA * (spin[0] ** 2 - spin[-1] ** 2)
    assert np.trapezoid(power, time) == pytest.approx(lost, rel=1e-4)
