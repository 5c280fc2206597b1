"""Guides without clearance, on the frame and on moving bodies: friction, momentum, Jacobians."""

import math

import exudyn as exu
import numpy as np
import pytest
from differences import assert_jacobian, assert_partials, forces, state_in
from exudyn.itemInterface import (
    LoadForceVector,
    MarkerBodyRigid,
    MarkerNodeCoordinates,
    NodePointGround,
    ObjectConnectorCoordinateVector,
)
from solving import completed
from stand_in_system import planar_body, recorded

from exu_press.joints.ends import BodyEnd
from exu_press.joints.guide_friction import (
    GuideFriction,
    HeldSide,
    SpringSide,
)
from exu_press.joints.guide_line import FixedLine, TurningLine
from exu_press.joints.guide_springs import GuideSprings
from exu_press.joints.guideway_film import GuidewayFilm
from exu_press.joints.interface import DryInterface
from exu_press.joints.moving_guideway import MovingGuidewayContact
from exu_press.joints.planar import PlanarEnd
from exu_press.laws.contact import hertz, step_damping
from exu_press.laws.film.asperities import pad_with_asperities
from exu_press.laws.film.plane_pad import plane_pad
from exu_press.laws.friction import LuGre, coulomb

MASS, GRAVITY = 20.0, 9.81
LUGRE = LuGre(0.3, 0.2, 1e5, 300.0, 0.0, 0.01, 2.0)


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
    _container, mbs, motion, along = block(slope, LUGRE)
    time, speed = speeds(mbs, motion, along, end=2.0)
    assert abs(speed[-1]) < 1e-10
    bent = -0.3 / 1e5 * math.log1p(-math.tan(slope) / 0.3)
    assert np.trapezoid(speed, time) == pytest.approx(bent, rel=2e-3)
    late = time > 1.0
    assert abs(np.trapezoid(speed[late], time[late])) < 1e-11


def test_without_bristles_it_creeps_as_slowly_as_the_law_says():
    """At the speed at which mu = tan of the slope: Coulomb's is v_r artanh(tan / mu)."""
    slope = math.radians(5.0)
    _container, mbs, motion, along = block(slope, coulomb(0.2, 1e-3))
    time, speed = speeds(mbs, motion, along)
    creep = 1e-3 * math.atanh(math.tan(slope) / 0.2)
    assert speed[-1] == pytest.approx(creep, rel=1e-3)
    assert np.trapezoid(speed, time) < 1.01 * creep * time[-1]


BODY, BASE = np.array([0.5, 0.2, 0.3]), np.array([0.2, -0.1, -0.4])
LINE = TurningLine(BODY, BASE, (0.31, 0.14), 0.7)
Q = np.array([1e-3, -2e-3, 0.02, 3e-3, 1e-3, -0.01])
RATES = np.array([0.3, -0.2, 0.5, 0.1, 0.4, -0.3])
FACTORS = 0.7, 0.3


def assert_balanced(force, q):
    """Check that the forces on both bodies cancel, with their moments about the origin."""
    x, y = BODY[:2] + q[:2], BASE[:2] + q[3:5]
    assert force[:2] == pytest.approx(-force[3:5])
    moments = force[2] + force[5] + x[0] * force[1] - x[1] * force[0]
    moments += y[0] * force[4] - y[1] * force[3]
    assert moments == pytest.approx(0.0, abs=1e-9 * np.abs(force).max())


def assert_rate(joint, q, q_t):
    """Check that the velocity at which a step's error is measured is the eccentricity's rate."""
    vectors = []
    for time in (-1e-6, 1e-6):
        forces(joint, np.array(q) + time * np.array(q_t), q_t)
        vectors.append(np.array(joint.eccentricity))
    forces(joint, q, q_t)
    rate = (vectors[1] - vectors[0]) / 2e-6
    assert joint.relative_velocity == pytest.approx(rate, abs=1e-7)


@pytest.mark.parametrize("item", ["friction", "springs"])
def test_friction_and_springs_keep_momentum_and_have_their_jacobian(item):
    mbs = exu.SystemContainer().AddSystem()
    nodes = [planar_body(mbs, 2.0, 0.1)[1] for _ in range(2)]
    if item == "friction":
        made = GuideFriction(mbs, nodes, LINE, SpringSide(1e5, 30.0, LINE), coulomb(0.2, 1.0))
    else:
        made = GuideSprings(mbs, nodes, LINE, (1e5, 30.0), (2e4, 5.0), 0.6)
    force, jacobian = made._forces, made._jacobian
    state = Q.copy(), RATES.copy()
    assert_balanced(np.array(force(mbs, 0.0, 0, *state)), Q)
    matrix = jacobian(mbs, 0.0, 0, *state, *FACTORS).Convert2DenseMatrix()
    assert_partials(
        matrix, lambda: np.array(force(mbs, 0.0, 0, *state)), state, FACTORS, 1e-4, by_rows=False
    )
    if item == "friction":
        assert force(mbs, 0.0, 0, *state) @ RATES < 0.0


def test_a_film_on_a_moving_body_keeps_momentum_and_has_its_power_and_jacobian():
    clearance, onset, length = 3e-5, 2e-6, 0.2
    rear, front = (
        BodyEnd("RigidBody2D", 0, BODY, np.array([half * length, 0.0, 0.0])) for half in (-0.5, 0.5)
    )
    x, y = (BODY - BASE)[:2]
    c, s = np.cos(BASE[2]), np.sin(BASE[2])
    turned = BODY[2] - BASE[2]
    film = GuidewayFilm(
        rear,
        front,
        BodyEnd("RigidBody2D", 3, BASE, np.array([c * x + s * y, c * y - s * x, 0.0])),
        (float(np.cos(turned)), float(np.sin(turned))),
        law=pad_with_asperities(plane_pad(length, 0.1), onset),
        viscosity=0.1,
        clearance=clearance,
        contact_onset=clearance - onset,
        length=length,
        half_width=0.04,
    )
    q, q_t = [1e-5, -5e-6, 1e-5, 2e-6, 3e-6, -2e-5], [0.3, -0.2, 0.5, 0.1, 0.4, 0.51]
    force = forces(film, q, q_t)
    assert_balanced(force, np.array(q))
    state = state_in(film, [*q], [*q_t])
    assert state.power == pytest.approx(force @ q_t, rel=1e-6)
    assert state.dissipated_power > 0.0
    assert_jacobian(film, q, q_t, (0.0, 1.0), 1e-3)
    assert_rate(film, q, q_t)


def touching(radius):
    """Return a contact between walls of another body, and coordinates in which it touches."""
    contact = step_damping(hertz(1e7, 1.0), damping_max=1e3, damping_depth=1e-6)
    end = PlanarEnd((0, 1, 2), tuple(BODY), (0.1, 0.0))
    line = PlanarEnd((3, 4, 5), tuple(BASE), (0.3, 0.05))
    interface = DryInterface(contact, coulomb(0.2, 0.5), 0.02, 1e-4)
    joint, q = MovingGuidewayContact(end, line, 0.6, interface, radius), np.zeros(6)
    for _ in range(20):
        forces(joint, q, np.zeros(6))
        q[:2] += (2e-4 - joint._motion[0]) * np.array(joint._rows[0][:2])
    return joint, q


@pytest.mark.parametrize("radius", [None, 0.1])
def test_a_contact_on_a_moving_body_keeps_momentum_and_has_its_jacobian(radius):
    """But for what only turns arms."""
    (joint, q), q_t = touching(radius), [0.3, -0.2, 5.0, 0.1, 0.4, -3.0]
    force = forces(joint, q, q_t)
    assert np.hypot(*force[:2]) > 100.0
    assert_balanced(force, q)
    for factors in ((1.0, 0.0), (0.0, 1.0)):
        assert_jacobian(joint, q, q_t, factors, 2e-2, by_rows=False)


@pytest.mark.parametrize("radius", [None, 0.1, -0.1])
def test_the_rate_of_an_eccentricity_turns_with_the_walls(radius):
    """On either wall; else steps follow the walls' rotation, as if it were an error."""
    (joint, q), q_t = touching(None if radius is None else abs(radius)), RATES
    if radius is not None and radius < 0.0:
        q[:2] -= 2.0 * joint._motion[0] * np.array(joint._rows[0][:2])
    assert_rate(joint, q, q_t)
