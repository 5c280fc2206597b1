"""Oil between a block and its guideway: Jacobian, power, a model of its own on Reynolds' film."""

import math

import exudyn as exu
import numpy as np
import pytest
from differences import assert_jacobian, forces, state_in
from exudyn.itemInterface import LoadForceVector, LoadTorqueVector, MarkerBodyRigid
from independent.pad_pressure import end_forces
from scipy.integrate import solve_ivp
from solving import completed, planar_body, recorded

from exu_press.joints import add_guideway_contact, add_guideway_film, add_joint_sensor
from exu_press.joints.ends import BodyEnd
from exu_press.joints.guideway_film import GuidewayFilm
from exu_press.laws.contact import hertz, step_damping
from exu_press.laws.film import pad_with_asperities
from exu_press.laws.film.plane_pad import plane_pad
from exu_press.laws.friction import no_friction

MASS, LENGTH, WIDTH, HALF, VISCOSITY = 20.0, 0.3, 0.05, 0.04, 0.1
CLEARANCE, ONSET, STIFFNESS = 3e-5, 2e-6, 1e9
SIDE, MOMENT, SPEED = 1e5, 3e3, 0.3


def film_between(angle=0.0):
    """Return a film of a block at a place, whose guideway lies at an angle, and its coordinates."""
    along = np.array([math.cos(angle), math.sin(angle)])
    rear, front = (
        BodyEnd("RigidBody2D", 0, np.array([0.1, -0.2, angle]), np.array([half * LENGTH, 0.0, 0.0]))
        for half in (-0.5, 0.5)
    )
    film = GuidewayFilm(
        rear,
        front,
        BodyEnd("Ground", 0, np.zeros(0), np.array([0.1, -0.2, 0.0])),
        (float(along[0]), float(along[1])),
        law=pad_with_asperities(plane_pad(LENGTH, WIDTH), ONSET),
        viscosity=VISCOSITY,
        clearance=CLEARANCE,
        contact_onset=CLEARANCE - ONSET,
        length=LENGTH,
        half_width=HALF,
    )
    return film, along, np.array([along[1], -along[0]])


STATES = [(1e-5, 3e-5, 1e-3, -0.01, 0.4), (-2.8e-5, 1e-5, -1e-3, 0.02, -0.3), (0, 0, 1e-4, 0.01, 0)]
"""Displacement across, tilt, and rates of both with that along."""


def coordinates(along, across, beside, tilt, rate, turning, speed):
    q = np.append(beside * across, tilt)
    return q, np.append(rate * across + speed * along, turning)


@pytest.mark.parametrize("state", STATES)
@pytest.mark.parametrize("factors", [(1.0, 0.0), (0.0, 1.0)])
def test_the_jacobian_is_that_of_the_forces(state, factors):
    """But for what only turns arms, which the third column by the coordinates has."""
    film, *guideway = film_between(0.7)
    assert_jacobian(film, *coordinates(*guideway, *state), factors, 1e-3)


@pytest.mark.parametrize("state", STATES)
def test_its_power_is_that_of_its_forces(state):
    film, *guideway = film_between(0.7)
    q, q_t = coordinates(*guideway, *state)
    told = state_in(film, [*q], [*q_t])
    assert told.power == pytest.approx(forces(film, q, q_t) @ q_t, rel=1e-6)
    assert told.dissipated_power > 0.0
    assert told.eccentricity == pytest.approx(state[0] * guideway[1], abs=1e-12)


def block(side=SIDE, moment=MOMENT, speed=SPEED, viscosity=VISCOSITY):
    """Return a system with a block in a guideway along x, pressed and turned, and its motion."""
    container = exu.SystemContainer()
    mbs = container.AddSystem()
    inertia = MASS * LENGTH**2 / 12
    body, node = planar_body(mbs, MASS, inertia, velocity=(speed, 0.0, 0.0))
    marker = mbs.AddMarker(MarkerBodyRigid(bodyNumber=body))
    mbs.AddLoad(LoadForceVector(markerNumber=marker, loadVector=[0.0, side, 0.0]))
    mbs.AddLoad(LoadTorqueVector(markerNumber=marker, loadVector=[0.0, 0.0, moment]))
    ends = [(body, (half * LENGTH, 0.0)) for half in (-0.5, 0.5)]
    guideway = {"middle": (0.0, 0.0), "direction": (1.0, 0.0), "half_width": HALF}
    contact = step_damping(hertz(STIFFNESS, 1.0), damping_max=2e4, damping_depth=1e-6)
    joints = [
        add_guideway_contact(
            mbs,
            end,
            clearance=CLEARANCE - ONSET,
            contact=contact,
            friction=no_friction(),
            **guideway,
        )
        for end in ends
    ]
    film = add_guideway_film(
        mbs,
        *ends,
        clearance=CLEARANCE,
        length=LENGTH,
        face_width=WIDTH,
        viscosity=viscosity,
        asperity_onset=ONSET,
        **guideway,
    )
    joints.append(film)
    sensors = [add_joint_sensor(mbs, joint) for joint in joints]
    motion = [recorded(mbs, node, name) for name in ("Coordinates", "Coordinates_t")]
    mbs.Assemble()
    return container, mbs, motion, sensors


def reduced(end):
    """Return the block's motion from Reynolds' equation in two dimensions, without our law.

    Displacement y, tilt phi and x with their rates. The block's upper face closes as y grows.
    """
    inertia = MASS * LENGTH**2 / 12

    def rates(_, state):
        _, y, phi, u, v, turning = state
        fy, moment, drag = SIDE, MOMENT, 0.0
        for side in (1.0, -1.0):
            rear, front = (CLEARANCE - side * (y + half * LENGTH * phi) for half in (-0.5, 0.5))
            closing = [-side * (v + half * LENGTH * turning) for half in (-0.5, 0.5)]
            face = u - side * HALF * turning
            slope = (front - rear) / LENGTH
            pair = [rate - 0.5 * face * slope for rate in closing]
            f_1, f_2 = VISCOSITY * end_forces(LENGTH, WIDTH, (rear, front), pair, (16, 6))
            log = LENGTH / rear if rear == front else math.log(front / rear) / slope
            shear = -0.5 * slope * (f_1 + f_2) - VISCOSITY * face * WIDTH * log
            fy -= side * (f_1 + f_2)
            moment -= side * 0.5 * LENGTH * (f_2 - f_1) + side * HALF * shear
            drag += shear
        return [u, v, turning, drag / MASS, fy / MASS, moment / inertia]

    begin = [0.0, 0.0, 0.0, SPEED, 0.0, 0.0]
    size = [1e-2, 1e-8, 1e-7, 1e-3, 1e-7, 1e-6]
    found = solve_ivp(
        rates, (0.0, end), begin, method="Radau", rtol=1e-4, atol=1e-3 * np.array(size),
        dense_output=True,
    )  # fmt: skip
    assert found.success
    return found.sol


def test_a_sliding_block_pressed_aslant_moves_as_its_own_model_says():
    """Squeeze, wedge and shear at once, with cavitation."""
    end = 0.02
    _container, mbs, (places, speeds), _ = block()
    completed(mbs, end)
    data, rates = (np.asarray(mbs.GetSensorStoredData(s)) for s in (places, speeds))
    expected = reduced(end)(data[:, 0])
    assert np.abs(data[:, 2]).max() > 0.25 * CLEARANCE
    for column in (2, 3):
        apart = np.abs(data[:, column] - expected[column - 1]).max()
        assert apart < 0.01 * np.abs(expected[column - 1]).max()
    lost, own = SPEED - rates[-1, 1], SPEED - expected[3, -1]
    assert lost == pytest.approx(own, rel=0.002)
    assert lost > 0.05 * SPEED


def test_the_film_gives_way_to_contact():
    """In the end contacts bear the force, after the film has borne it alone."""
    _container, mbs, _, sensors = block(side=5e3, moment=0.0, speed=0.0, viscosity=5e-4)
    completed(mbs, 6.0)
    ends = [np.asarray(mbs.GetSensorStoredData(s)) for s in sensors]
    borne = [each[-1, 4] for each in ends]
    assert sum(borne[:2]) == pytest.approx(-5e3, rel=1e-3)
    assert abs(borne[2]) < 5.0
    assert ends[0][-1, 2] == pytest.approx(CLEARANCE - ONSET + 2.5e3 / STIFFNESS, rel=1e-3)
    early = (ends[0][:, 4] == 0.0) & (ends[0][:, 0] > 0.05)
    assert early.sum() > 20
    assert ends[2][early, 4] == pytest.approx(-5e3, rel=1e-3)


def test_it_sinks_as_the_closed_form_of_a_squeeze_says():
    """1/h^2 grows by 2 F / (mu w^3 L f) of the side that closes; f is the series of torsion."""
    _container, mbs, (places, _), _ = block(side=2e4, moment=0.0, speed=0.0)
    completed(mbs, 0.03)
    data = np.asarray(mbs.GetSensorStoredData(places))
    begin, end = np.searchsorted(data[:, 0], [0.005, 0.03 - 1e-12])
    inverse = 1.0 / (CLEARANCE - data[:, 2]) ** 2
    rate = (inverse[end] - inverse[begin]) / (data[end, 0] - data[begin, 0])
    odd = np.arange(1, 400, 2)
    ratio = WIDTH / LENGTH
    tanh = np.tanh(0.5 * math.pi * odd / ratio)
    f = 1.0 - 192.0 * ratio / math.pi**5 * (tanh / odd**5).sum()
    assert rate == pytest.approx(2.0 * 2e4 / (VISCOSITY * WIDTH**3 * LENGTH * f), rel=1e-2)
