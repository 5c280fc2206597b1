"""Friction of a guide without clearance: a block on a slope, the Jacobian, and no energy made."""

import math

import exudyn as exu
import numpy as np
import pytest
from differences import assert_partials
from exudyn.itemInterface import (
    LoadForceVector,
    MarkerBodyRigid,
    MarkerNodeCoordinates,
    NodePointGround,
    ObjectConnectorCoordinateVector,
)
from solving import completed, planar_body, recorded

from exu_press.joints.guide_friction import (
    GuideFriction,
    HeldSide,
    SpringSide,
)
from exu_press.joints.guide_line import FixedLine
from exu_press.laws.friction import LuGre, coulomb, no_friction, stribeck

MASS, GRAVITY = 20.0, 9.81
LAWS = {
    "none": no_friction(),
    "coulomb": coulomb(0.2, 1e-3),
    "stribeck": stribeck(0.3, 0.2, 0.01, 2.0, 1e-3, 0.01),
    "lugre": LuGre(0.3, 0.2, 1e5, 300.0, 0.0, 0.01, 2.0),
}


def block(slope, law, speed=0.0):
    """Return a system with a block in an ideal guide that falls by a slope."""
    container = exu.SystemContainer()
    mbs = container.AddSystem()
    along = np.array([math.cos(slope), -math.sin(slope)])
    body, node = planar_body(mbs, MASS, 1.0, velocity=(*(speed * along), 0.0))
    ground = mbs.AddNode(NodePointGround())
    rows = [[math.sin(slope), math.cos(slope), 0.0], [0.0, 0.0, 1.0]]
    markers = [mbs.AddMarker(MarkerNodeCoordinates(nodeNumber=n)) for n in (ground, node)]
    held = [
        mbs.AddObject(
            ObjectConnectorCoordinateVector(
                markerNumbers=markers, scalingMarker0=[], scalingMarker1=[row], offset=[0.0]
            )
        )
        for row in rows
    ]
    marker = mbs.AddMarker(MarkerBodyRigid(bodyNumber=body))
    mbs.AddLoad(LoadForceVector(markerNumber=marker, loadVector=[0.0, -MASS * GRAVITY, 0.0]))
    GuideFriction(mbs, [node], FixedLine(np.append(along, 0.0)), HeldSide(mbs, held[0]), law)
    motion = recorded(mbs, node, "Coordinates_t")
    mbs.Assemble()
    return container, mbs, motion, along


def speeds(mbs, motion, along, end=0.5, tolerance=1e-4):
    completed(mbs, end, 100, tolerance)
    data = np.asarray(mbs.GetSensorStoredData(motion))
    return data[:, 0], data[:, 1:3] @ along


@pytest.mark.parametrize("degrees", [20.0, 45.0, 100.0])
@pytest.mark.parametrize("tolerance", [1e-4, None])
def test_a_block_slides_down_a_slope_as_coulomb_says(degrees, tolerance):
    """A = g (sin - mu |cos|), whichever side of the guide it presses."""
    slope, mu = math.radians(degrees), 0.2
    _container, mbs, motion, along = block(slope, coulomb(mu, 1e-4), speed=1.0)
    time, speed = speeds(mbs, motion, along, tolerance=tolerance)
    expected = GRAVITY * (math.sin(slope) - mu * abs(math.cos(slope)))
    begun = 0 if tolerance else 1  # the accelerations at the start are those without friction
    gained = speed[begun:] - speed[begun]
    assert gained == pytest.approx(expected * (time[begun:] - time[begun]), rel=1e-4, abs=1e-4)


def test_a_block_at_rest_stays_on_a_slope_with_bristles():
    """They bend by dz = (1 - sigma_0 z / g) dx until sigma_0 z = tan, and then nothing moves."""
    slope = math.radians(10.0)
    law = LAWS["lugre"]
    _container, mbs, motion, along = block(slope, law)
    time, speed = speeds(mbs, motion, along, end=2.0)
    assert abs(speed[-1]) < 1e-10
    bent = -0.3 / 1e5 * math.log1p(-math.tan(slope) / 0.3)
    assert np.trapezoid(speed, time) == pytest.approx(bent, rel=2e-3)
    late = time > 1.0
    assert abs(np.trapezoid(speed[late], time[late])) < 1e-11


@pytest.mark.parametrize("law", LAWS)
def test_the_jacobian_is_the_derivative_of_the_force(law):
    rng = np.random.default_rng(3)
    mbs = exu.SystemContainer().AddSystem()
    _, node = planar_body(mbs, MASS, 1.0)
    line = FixedLine(np.array([-0.8, 0.6, 0.0]), np.array([0.6, 0.8, 0.0]), 1e-3)
    friction = GuideFriction(mbs, [node], line, SpringSide(1e5, 30.0, line), LAWS[law])
    mbs.Assemble()
    q, q_t = 1e-2 * rng.normal(size=3), 5e-3 * rng.normal(size=3)
    factors = 0.7, 0.3
    found = friction._jacobian(mbs, 0.0, 0, q, q_t, *factors).Convert2DenseMatrix()
    assert_partials(
        found, lambda: np.array(friction._forces(mbs, 0.0, 0, q, q_t)), (q, q_t), factors, 1e-5
    )
