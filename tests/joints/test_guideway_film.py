"""Oil between a block and its guideway: Jacobian, power, a model of its own on Reynolds' film."""

import math

import exudyn as exu
import numpy as np
import pytest
from exudyn.itemInterface import LoadForceVector, LoadTorqueVector, MarkerBodyRigid
from independent.pad_pressure import end_forces
from scipy.integrate import solve_ivp
from solving import completed
from stand_in_system import planar_body, recorded

from exu_press.joints import add_guideway_contact, add_guideway_film, add_joint_sensor
from exu_press.laws.contact import hertz, step_damping
from exu_press.laws.friction import no_friction

MASS, LENGTH, WIDTH, HALF, VISCOSITY = 20.0, 0.3, 0.05, 0.04, 0.1
CLEARANCE, ONSET, STIFFNESS = 3e-5, 2e-6, 1e9
SIDE, MOMENT, SPEED = 1e5, 3e3, 0.3


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
