"""A block in its guideway: the Jacobian, Coulomb's law on a slope, corners that bear a moment."""

import math

import exudyn as exu
import numpy as np
import pytest
from differences import assert_jacobian, state_in
from exudyn.itemInterface import (
    LoadForceVector,
    LoadTorqueVector,
    MarkerBodyRigid,
)
from solving import completed
from stand_in_system import planar_body, recorded

from exu_press import InputError
from exu_press.joints import add_guideway_contact, add_joint_sensor
from exu_press.joints.ends import BodyEnd
from exu_press.joints.guideway import GuidewayContact, SpatialGuidewayContact
from exu_press.joints.interface import DryInterface
from exu_press.joints.planar import PlanarEnd
from exu_press.laws.contact import hertz, step_damping
from exu_press.laws.friction import coulomb, no_friction, stribeck

MASS, LENGTH, GRAVITY, CLEARANCE, STIFFNESS = 20.0, 0.3, 9.81, 5e-5, 5e7


def block(slope, friction, *, moment=0.0, half_width=0.0, start=(0.0, 0.0, 0.0), speed=0.0):
    """Return a system with a block on a guideway that falls by a slope, and their two contacts."""
    container = exu.SystemContainer()
    mbs = container.AddSystem()
    along = math.cos(slope), -math.sin(slope)
    inertia, velocity = MASS * LENGTH**2 / 12, (speed * along[0], speed * along[1], 0.0)
    body, node = planar_body(mbs, MASS, inertia, velocity=velocity, initialCoordinates=start)
    marker = mbs.AddMarker(MarkerBodyRigid(bodyNumber=body))
    mbs.AddLoad(LoadForceVector(markerNumber=marker, loadVector=[0.0, -MASS * GRAVITY, 0.0]))
    mbs.AddLoad(LoadTorqueVector(markerNumber=marker, loadVector=[0.0, 0.0, moment]))
    contact = step_damping(hertz(STIFFNESS, 1.0), damping_max=2e4, damping_depth=1e-6)
    contacts = [
        add_guideway_contact(
            mbs,
            (body, (end * along[0], end * along[1])),
            middle=(0.0, 0.0),
            direction=along,
            clearance=CLEARANCE,
            contact=contact,
            friction=friction,
            half_width=half_width,
        )
        for end in (-0.5 * LENGTH, 0.5 * LENGTH)
    ]
    sensors = [add_joint_sensor(mbs, contact) for contact in contacts]
    motion = recorded(mbs, node, "Coordinates_t")
    mbs.Assemble()
    return container, mbs, sensors, motion, along


@pytest.mark.parametrize("degrees", [20.0, 45.0])
def test_a_block_slides_down_a_slope_as_coulomb_says(degrees):
    """a = g (sin - mu cos) from rest, once it lies on its way."""
    slope, mu = math.radians(degrees), 0.2
    _container, mbs, sensors, motion, along = block(slope, coulomb(mu, 1e-4))
    completed(mbs, 0.5)
    data = np.asarray(mbs.GetSensorStoredData(motion))
    speed = data[:, 1:3] @ np.array(along)
    begin, end = np.searchsorted(data[:, 0], [0.2, 0.5 - 1e-9])
    found = (speed[end] - speed[begin]) / (data[end, 0] - data[begin, 0])
    assert found == pytest.approx(GRAVITY * (math.sin(slope) - mu * math.cos(slope)), rel=1e-4)
    normal = sum(np.asarray(mbs.GetSensorStoredData(s))[-1, 3:5] for s in sensors)
    expected = MASS * GRAVITY * math.cos(slope)
    assert normal @ np.array([-along[1], along[0]]) == pytest.approx(expected, rel=1e-4)
    assert normal @ np.array(along) == pytest.approx(-mu * expected, rel=1e-4)


def test_below_the_angle_of_friction_it_stays_but_for_a_creep():
    """Coulomb's smooth law creeps at v_r artanh(tan / mu)."""
    slope, mu = math.radians(5.0), 0.2
    _container, mbs, _, motion, along = block(slope, coulomb(mu, 1e-4))
    completed(mbs, 0.2)
    speed = np.asarray(mbs.GetSensorStoredData(motion))[-1, 1:3] @ np.array(along)
    assert speed == pytest.approx(1e-4 * math.atanh(math.tan(slope) / mu), rel=1e-3)


def test_a_moment_is_borne_by_opposite_corners():
    """N (L) = M, one end on either side: the tilt is 2 (c + N / k) / L."""
    moment = 300.0
    _container, mbs, sensors, _, _ = block(0.0, no_friction(), moment=moment)
    mbs.SetLoadParameter(0, "loadVector", [0.0, 0.0, 0.0])
    completed(mbs, end=1.0)
    ends = [np.asarray(mbs.GetSensorStoredData(s))[-1] for s in sensors]
    force = moment / LENGTH
    assert ends[0][4] == pytest.approx(force, rel=1e-3)
    assert ends[1][4] == pytest.approx(-force, rel=1e-3)
    assert abs(ends[0][2]) == pytest.approx(CLEARANCE + force / STIFFNESS, rel=1e-4)


def test_friction_beside_the_middle_turns_the_block():
    """Both ends' friction, mu m g, acts half a width below: N_1 - N_2 bears mu m g w."""
    mu, half_width = 0.25, 0.04
    _container, mbs, sensors, _, _ = block(0.0, coulomb(mu, 1e-4), half_width=half_width, speed=3.0)
    completed(mbs, 0.5)
    rear, front = (np.asarray(mbs.GetSensorStoredData(s))[-1, 4] for s in sensors)
    weight = MASS * GRAVITY
    assert rear + front == pytest.approx(weight, rel=1e-4)
    assert (front - rear) * LENGTH / 2 == pytest.approx(mu * weight * half_width, rel=1e-3)


def pressed_end(side, kind=GuidewayContact):
    """Return a contact, with coordinates and rates in which it touches on a side."""
    end = PlanarEnd((0, 1, 2), (0.3, -0.2, 0.4), (0.1, 0.25))
    interface = DryInterface(
        step_damping(hertz(5e7, 1.5), damping_max=3e4, damping_depth=1e-5),
        stribeck(0.3, 0.2, 0.05, 2.0, 0.02, 0.1),
        0.05,
        1e-4,
    )
    across = (math.cos(0.7), math.sin(0.7))
    x, y = end.reference[:2]
    arm = [math.cos(0.4) * 0.1 - math.sin(0.4) * 0.25, math.sin(0.4) * 0.1 + math.cos(0.4) * 0.25]
    shift = side * 1.2e-4
    middle = (x + arm[0] - shift * across[0], y + arm[1] - shift * across[1])
    given = end
    if kind is SpatialGuidewayContact:
        reference, point = np.array(end.reference), np.array([*end.point, 0.0])
        given = BodyEnd("RigidBody2D", 0, reference, point)
    rates = [-0.03 * side, 0.02 * side, -0.4 * side]
    return kind(given, middle, across, interface), [0.0, 0.0, 0.0], rates


@pytest.mark.parametrize("side", [-1.0, 1.0])
def test_in_space_it_is_the_same(side):
    """Its Jacobian leaves out what only turns the arm: in the third column, by the coordinates."""
    (planar, q, q_t), (spatial, _, _) = (
        pressed_end(side, kind) for kind in (GuidewayContact, SpatialGuidewayContact)
    )
    one, other = state_in(planar, q, q_t), state_in(spatial, q, q_t)
    assert other.gap == pytest.approx(one.gap, rel=1e-9) and one.gap < 0.0
    for name in ("eccentricity", "force", "velocity"):
        assert getattr(other, name)[:2] == pytest.approx(getattr(one, name), rel=1e-9)
    assert other.power == pytest.approx(one.power, rel=1e-9)
    assert spatial.relative_velocity[:2] == pytest.approx(planar.relative_velocity)
    assert spatial.largest_eccentricity == planar.largest_eccentricity
    for by_q, by_q_t in ((1.0, 0.0), (0.0, 1.0)):
        found, expected = (
            np.reshape(contact.jacobian(by_q, by_q_t), (3, 3)) for contact in (spatial, planar)
        )
        columns = slice(0, 2) if by_q else slice(0, 3)
        apart = np.abs(found - expected)[:, columns].max()
        assert apart < 1e-9 * np.abs(expected).max()


@pytest.mark.parametrize("side", [-1.0, 1.0])
@pytest.mark.parametrize("factors", [(1.0, 0.0), (0.0, 1.0)])
def test_the_jacobian_is_that_of_the_forces(side, factors):
    contact, q, q_t = pressed_end(side)
    assert state_in(contact, q, q_t).gap < 0.0
    assert_jacobian(contact, q, q_t, factors, 1e-5)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"clearance": 0.0}, "clearance = 0, half_width = 0: allowed are numbers > 0"),
        ({"direction": (0.0, 0.0)}, "allowed is a direction"),
        ({"friction": "coulomb"}, "friction = 'coulomb': allowed is a law"),
    ],
)
def test_what_is_refused(change, message):
    mbs = exu.SystemContainer().AddSystem()
    body, _ = planar_body(mbs, 1.0, 1.0)
    given = {
        "middle": (0.0, 0.0),
        "direction": (0.0, 1.0),
        "clearance": 1e-4,
        "contact": step_damping(hertz(1e7, 1.0), damping_max=1.0, damping_depth=1e-6),
        "friction": no_friction(),
    }
    with pytest.raises(InputError, match=message):
        add_guideway_contact(mbs, (body, (0.0, 0.0)), **{**given, **change})
