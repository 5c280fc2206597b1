"""Impacts between steps: a step ends right behind an event, where a function sets velocities."""

import math

import exudyn as exu
import exudyn.utilities as items
import numpy as np
import pytest
from scipy.integrate import solve_ivp

from exu_press import SolverStatus, solve_dynamic
from exudyn_examples.example import GRAVITY
from exudyn_examples.other import first_order, mass_1d
from exudyn_examples.planar import rods

REBOUND = 0.8


def settings(end):
    chosen = exu.SimulationSettings()
    chosen.timeIntegration.endTime, chosen.timeIntegration.numberOfSteps = end, 100
    chosen.timeIntegration.generalizedAlpha.spectralRadius = 0.8
    chosen.solution.file.write = False
    return chosen


def falling(arms=1):
    """Bars of 1 m in a row, let go while horizontal; the first one rebounds where it hangs.

    Its own velocities are set there, and nothing of what that does to the others.
    """
    mbs = exu.SystemContainer().AddSystem()
    rods(mbs, [2.0 - number for number in range(arms)])

    def rebound(mbs, time):
        velocities = np.array(mbs.systemData.GetODE2Coordinates_t())
        if above(mbs, time) < 0.0 and velocities[2] < 0.0:
            velocities[:3] *= -REBOUND
            mbs.systemData.SetODE2Coordinates_t(velocities)
        return True

    mbs.SetPostStepUserFunction(rebound)
    mbs.Assemble()
    return mbs


def above(mbs, time):
    return mbs.systemData.GetODE2Coordinates()[2] + 0.5 * math.pi


def rebounding(end):
    """Angular velocity of one bar at a time, s, by SciPy, and the largest one, rad/s."""

    def hangs(time, state):
        return state[0] + 0.5 * math.pi

    hangs.terminal, hangs.direction = True, -1.0
    time, state, largest = 0.0, (0.0, 0.0), 0.0
    while time < end:
        found = solve_ivp(
            lambda time, state: (state[1], -1.5 * GRAVITY * math.cos(state[0])),
            (time, end),
            state,
            rtol=1e-10,
            atol=1e-11,
            events=hangs,
        )
        time, speed = found.t[-1], found.y[1, -1]
        largest = max(largest, abs(speed))
        state = -0.5 * math.pi, -REBOUND * speed
    return speed, largest


@pytest.mark.parametrize(("tolerance", "most"), [(1e-2, 300), (1e-3, 700), (1e-4, 1700)])
def test_a_pendulum_rebounds(tolerance, most):
    mbs = falling()
    outcome = solve_dynamic(mbs, settings(3.0), tolerance=tolerance, event=above)
    assert outcome.status is SolverStatus.COMPLETED, outcome.reason
    assert outcome.steps + outcome.rejected_steps < most
    speed, largest = rebounding(3.0)
    found = mbs.systemData.GetODE2Coordinates_t()[2]
    assert found == pytest.approx(speed, abs=tolerance * largest)


def test_constraints_spread_an_impact():
    """The second bar drags the first one back to its stop many times, which amplifies errors."""
    found = []
    for tolerance in (1e-4, 1e-3):
        mbs = falling(arms=2)
        outcome = solve_dynamic(mbs, settings(2.0), tolerance=tolerance, event=above)
        assert outcome.status is SolverStatus.COMPLETED, outcome.reason
        found.append(mbs.systemData.GetODE2Coordinates_t())
    largest = np.abs(found[0]).max()
    assert found[1] == pytest.approx(found[0], abs=5e-3 * largest)


def test_rows_between_steps_begin_with_the_velocities_that_are_set():
    """A falling body is kicked upwards once; rows lie between its few steps."""
    mbs, kicked = exu.SystemContainer().AddSystem(), []
    ends = mass_1d(mbs, 1.0)
    mbs.AddLoad(items.LoadCoordinate(markerNumber=ends[1], load=-GRAVITY))
    sensor = mbs.AddSensor(
        items.SensorNode(
            nodeNumber=mbs.GetMarker(ends[1])["nodeNumber"],
            outputVariableType=exu.OutputVariableType.Coordinates_t,
            storeInternal=True,
        )
    )

    def kick(mbs, time):
        if time > 0.3 and not kicked:
            kicked.append(time)
            mbs.systemData.SetODE2Coordinates_t([5.0])
        return True

    mbs.SetPostStepUserFunction(kick)
    mbs.Assemble()
    chosen = settings(1.0)
    chosen.solution.sensors.writePeriod = 1e-4
    assert solve_dynamic(mbs, chosen).check()
    rows = mbs.GetSensorStoredData(sensor)
    assert len(rows) >= 10001
    times, (instant,) = rows[:, 0], kicked
    expected = np.where(times <= instant, 0.0, 5.0 + GRAVITY * instant) - GRAVITY * times
    assert rows[:, 1] == pytest.approx(expected, abs=1e-9)


@pytest.mark.parametrize("spin", [0.0, 5.0, 20.0])
@pytest.mark.parametrize("tolerance", [1e-2, 1e-3])
def test_behind_an_event_a_spinning_disc_has_its_accelerations(spin, tolerance):
    """On an arm of 1 m that turns at 2 rad/s: those of its middle are 4 m/s^2.

    Exudyn's directions of joints are those of Euler parameters of length 1, and accelerations do
    not keep it, so that one iteration mends their length and a second one the joints.
    """
    mbs = exu.SystemContainer().AddSystem()
    ground, rate = mbs.CreateGround(), 2.0
    arm = mbs.CreateRigidBody(
        inertia=items.InertiaCuboid(1000.0, [1.0, 0.1, 0.1]),
        referencePosition=[0.5, 0.0, 0.0],
        initialVelocity=[0.0, 0.5 * rate, 0.0],
        initialAngularVelocity=[0.0, 0.0, rate],
    )
    disc = mbs.CreateRigidBody(
        inertia=items.InertiaCylinder(1000.0, 0.05, 0.2, 0),
        referencePosition=[1.0, 0.0, 0.0],
        initialVelocity=[0.0, rate, 0.0],
        initialAngularVelocity=[spin, 0.0, rate],
    )
    for pair, place, axis in (((ground, arm), 0.0, [0, 0, 1]), ((arm, disc), 1.0, [1, 0, 0])):
        mbs.CreateRevoluteJoint(itemNumbers=list(pair), position=[place, 0.0, 0.0], axis=axis)
    sensor = mbs.AddSensor(
        items.SensorBody(
            bodyNumber=disc,
            storeInternal=True,
            outputVariableType=exu.OutputVariableType.Acceleration,
        )
    )
    mbs.Assemble()
    outcome = solve_dynamic(
        mbs, settings(1.0), tolerance=tolerance, event=lambda mbs, time: math.sin(20.0 * time - 0.1)
    )
    assert outcome.status is SolverStatus.COMPLETED, outcome.reason
    sizes = np.linalg.norm(mbs.GetSensorStoredData(sensor)[:, 1:], axis=1)
    assert sizes == pytest.approx(rate**2, rel=1e-2)


def test_a_first_order_coordinate_has_events_as_well():
    """A tank is filled up to 1.5, and empties from there."""
    mbs = exu.SystemContainer().AddSystem()
    node, inflow = first_order(mbs, [0.0]), [10.0]
    mbs.AddObject(
        items.ObjectGenericODE1(
            nodeNumbers=[node],
            systemMatrix=np.array([[-5.0]]),
            rhsUserFunction=lambda mbs, time, item, level: [inflow[0]],
        )
    )

    def level(mbs, time):
        return mbs.systemData.GetODE1Coordinates()[0] - 1.5

    def close(mbs, time):
        if level(mbs, time) > 0.0:
            inflow[0] = 0.0
        return True

    mbs.SetPostStepUserFunction(close)
    mbs.Assemble()
    outcome = solve_dynamic(mbs, settings(1.0), event=level)
    assert outcome.status is SolverStatus.COMPLETED, outcome.reason
    expected = 1.5 * math.exp(-5.0 * (1.0 - math.log(4.0) / 5.0))
    assert mbs.systemData.GetODE1Coordinates()[0] == pytest.approx(expected, abs=1.5e-3)
