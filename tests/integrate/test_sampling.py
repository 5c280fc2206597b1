"""Pre-step functions are called on their grid, and steps end where events are."""

import exudyn as exu
import exudyn.utilities as items
import numpy as np
import pytest
from scipy.special import ellipk

from exu_press import InputError, SolverStatus, solve_dynamic

PERIOD = 0.02  # s


def mass(before=None, force=0.0):
    """A mass of a kilogram on a line, its load, and its coordinate's constraint, inactive."""
    mbs = exu.SystemContainer().AddSystem()
    node = mbs.AddNode(items.Node1D(referenceCoordinates=[0.0]))
    mbs.AddObject(items.ObjectMass1D(nodeNumber=node, mass=1.0))
    at = mbs.AddMarker(items.MarkerNodeCoordinate(nodeNumber=node, coordinate=0))
    load = mbs.AddLoad(items.LoadCoordinate(markerNumber=at, load=force))
    if before is not None:
        mbs.SetPreStepUserFunction(before(load))
    mbs.Assemble()
    return mbs


def first_order(**equation):
    """A system of one first-order coordinate, from zero, not yet assembled, and its object."""
    mbs = exu.SystemContainer().AddSystem()
    node = mbs.AddNode(
        items.NodeGenericODE1(
            referenceCoordinates=[0.0], initialCoordinates=[0.0], numberOfODE1Coordinates=1
        )
    )
    return mbs, mbs.AddObject(items.ObjectGenericODE1(nodeNumbers=[node], **equation))


def settings(end=1.0):
    chosen = exu.SimulationSettings()
    chosen.timeIntegration.endTime, chosen.solution.file.write = end, False
    chosen.timeIntegration.numberOfSteps = 20
    return chosen


def velocity(mbs):
    return mbs.systemData.GetODE2Coordinates_t()[0]


def test_a_controller_is_sampled_on_its_grid_and_its_output_is_held():
    """v' = 1 - K v(t_k): v_k+1 = v_k + T (1 - K v_k)."""
    called = []

    def controller(load):
        def control(mbs, time):
            called.append(time)
            mbs.SetLoadParameter(load, "load", 1.0 - 20.0 * velocity(mbs))
            return True

        return control

    mbs = mass(controller)
    outcome = solve_dynamic(mbs, settings(0.2), tolerance=1e-4, sample=PERIOD, hold=True)
    assert outcome.status is SolverStatus.COMPLETED, outcome.reason
    assert called == pytest.approx(PERIOD * np.arange(1, 11))
    expected = 0.0
    for _ in called:
        expected += PERIOD * (1.0 - 20.0 * expected)
    assert velocity(mbs) == pytest.approx(expected, rel=1e-3)


def test_a_pressure_whose_valve_is_set_on_the_grid_starts_with_its_new_rate():
    """y' = u_k - y with u_k = +-1: with the old rate, each jump took steps by the dozen."""
    mbs, tank = first_order(systemMatrix=[[-1.0]], rhsVector=[1.0])

    def switch(mbs, time):
        mbs.SetObjectParameter(tank, "rhsVector", [1.0 if round(time / PERIOD) % 2 else -1.0])
        return True

    mbs.SetPreStepUserFunction(switch)
    mbs.Assemble()
    outcome = solve_dynamic(mbs, settings(1.0), tolerance=1e-3, sample=PERIOD, hold=True)
    assert outcome.status is SolverStatus.COMPLETED, outcome.reason
    expected, part = 0.0, np.exp(-PERIOD)
    for number in range(50):
        expected = expected * part + (1.0 - part) * (-1.0 if number % 2 else 1.0)
    assert mbs.systemData.GetODE1Coordinates()[0] == pytest.approx(expected, abs=1e-6)
    assert outcome.steps + outcome.rejected_steps < 300


def test_rates_are_those_of_the_time_at_which_a_step_begins():
    """y' = 20 t on a grid: steps of any size are exact, but for rates of their ends."""
    mbs, _ = first_order(rhsUserFunction=lambda mbs, time, number, y: [20.0 * time])
    mbs.SetPreStepUserFunction(lambda mbs, time: True)
    mbs.Assemble()
    outcome = solve_dynamic(mbs, settings(), sample=PERIOD)
    assert outcome.status is SolverStatus.COMPLETED, outcome.reason
    assert mbs.systemData.GetODE1Coordinates()[0] == pytest.approx(10.0, rel=1e-9)
    assert outcome.steps < 100


@pytest.mark.parametrize("what", ["data", "velocity"])
def test_what_a_function_sets_of_the_state_stays_where_its_step_is_repeated(what):
    """A force, or a speed, of 1 and -1 on a grid, with a spring: its jumps repeat steps."""
    mbs = exu.SystemContainer().AddSystem()
    node = mbs.AddNode(items.Node1D(referenceCoordinates=[0.0]))
    memory = mbs.AddNode(items.NodeGenericData(initialCoordinates=[0.0], numberOfDataCoordinates=1))
    mbs.AddObject(items.ObjectMass1D(nodeNumber=node, mass=1.0))
    at = mbs.AddMarker(items.MarkerNodeCoordinate(nodeNumber=node, coordinate=0))
    output = exu.OutputVariableType.Coordinates

    def force(mbs, time, load):
        return float(mbs.GetNodeOutput(memory, output)) - 1e3 * mbs.GetNodeOutput(node, output)

    def switch(mbs, time):
        sign = 1.0 if round(time / PERIOD) % 2 else -1.0
        if what == "data":
            mbs.systemData.SetDataCoordinates([100.0 * sign])
        else:
            mbs.systemData.SetODE2Coordinates_t([sign])
        return True

    mbs.AddLoad(items.LoadCoordinate(markerNumber=at, load=0.0, loadUserFunction=force))
    mbs.SetPreStepUserFunction(switch)
    mbs.Assemble()
    chosen = settings(7 * PERIOD)
    chosen.timeIntegration.numberOfSteps = 1
    outcome = solve_dynamic(mbs, chosen, tolerance=1e-4, sample=PERIOD)
    assert outcome.status is SolverStatus.COMPLETED, outcome.reason
    assert outcome.rejected_steps > 0
    x, v, omega = 0.0, 0.0, np.sqrt(1e3)
    for number in range(7):
        sign = -1.0 if number % 2 else 1.0
        held = 0.1 * sign if what == "data" else 0.0
        v = v if what == "data" else sign
        c, s = np.cos(omega * PERIOD), np.sin(omega * PERIOD)
        x, v = held + (x - held) * c + v / omega * s, v * c - (x - held) * omega * s
    assert abs(v) + omega * abs(x) > 0.5
    assert mbs.systemData.GetODE2Coordinates()[0] * omega == pytest.approx(omega * x, abs=5e-3)
    assert velocity(mbs) == pytest.approx(v, abs=5e-3)


def test_a_function_that_is_called_for_every_try_counts_once_a_step():
    """It adds to a data variable; the force, whose jumps repeat steps, does not know of it."""
    mbs = exu.SystemContainer().AddSystem()
    node = mbs.AddNode(items.Node1D(referenceCoordinates=[0.0]))
    mbs.AddNode(items.NodeGenericData(initialCoordinates=[0.0], numberOfDataCoordinates=1))
    mbs.AddObject(items.ObjectMass1D(nodeNumber=node, mass=1.0))
    at = mbs.AddMarker(items.MarkerNodeCoordinate(nodeNumber=node, coordinate=0))

    def force(mbs, time, load):
        return 1.0 if int(time / 0.3) % 2 else -1.0

    def count(mbs, time):
        mbs.systemData.SetDataCoordinates(mbs.systemData.GetDataCoordinates() + 1.0)
        return True

    mbs.AddLoad(items.LoadCoordinate(markerNumber=at, load=0.0, loadUserFunction=force))
    mbs.SetPreStepUserFunction(count)
    mbs.Assemble()
    outcome = solve_dynamic(mbs, settings(), sample=0.0)
    assert outcome.status is SolverStatus.COMPLETED, outcome.reason
    assert outcome.rejected_steps > 0
    assert mbs.systemData.GetDataCoordinates()[0] == outcome.steps


def test_without_a_period_the_largest_step_is_one():
    """A switch that is on within a thousandth of a step of the grid's middle is not missed."""
    times = []

    def switch(load):
        def look(mbs, time):
            times.append(time)
            if abs(time - 0.5) < 1e-4:
                mbs.SetLoadParameter(load, "load", 2.0)
            return True

        return look

    mbs = mass(switch)
    outcome = solve_dynamic(mbs, settings(), tolerance=1e-4, hold=True)
    assert outcome.status is SolverStatus.COMPLETED, outcome.reason
    assert times == pytest.approx(np.arange(1, 21) / 20.0)
    assert velocity(mbs) == pytest.approx(2.0 * 0.55, rel=1e-3)


def test_a_step_ends_right_behind_an_event():
    """x = t^2 / 2 passes 0.1 m at sqrt(0.2) s, where its load is turned round."""
    mbs = mass(force=1.0)
    turned = []

    def turn(mbs, time):
        if not turned and mbs.systemData.GetODE2Coordinates()[0] >= 0.1:
            turned.append(time)
            mbs.SetLoadParameter(0, "load", -1.0)
        return True

    mbs.SetPostStepUserFunction(turn)
    outcome = solve_dynamic(
        mbs,
        settings(),
        tolerance=1e-4,
        event=lambda mbs, time: mbs.systemData.GetODE2Coordinates()[0] - 0.1,
    )
    assert outcome.status is SolverStatus.COMPLETED, outcome.reason
    (time,) = turned
    assert time == pytest.approx(np.sqrt(0.2), abs=1e-6)
    assert velocity(mbs) == pytest.approx(2.0 * np.sqrt(0.2) - 1.0, abs=2e-4)


def test_an_event_does_not_jolt_constraints():
    """A pendulum almost turns over; where it comes to rest, steps are a ten-thousandth as long.

    What they missed of the joint was scaled up to the next step: the pendulum jumped by 0.05 rad/s.
    """
    mbs = exu.SystemContainer().AddSystem()
    ground, angle = mbs.AddObject(items.ObjectGround()), np.radians(80.0)
    place = [0.7 * np.cos(angle), 0.7 * np.sin(angle), angle]
    node = mbs.AddNode(items.NodeRigidBody2D(referenceCoordinates=place))
    rod = mbs.AddObject(items.ObjectRigidBody2D(nodeNumber=node, mass=2.0, inertia=0.05))
    mass = mbs.AddMarker(items.MarkerBodyMass(bodyNumber=rod))
    mbs.AddLoad(items.LoadMassProportional(markerNumber=mass, loadVector=[0.0, -9.81, 0.0]))
    fixed = mbs.AddMarker(items.MarkerBodyPosition(bodyNumber=ground))
    held = mbs.AddMarker(items.MarkerBodyPosition(bodyNumber=rod, localPosition=[-0.7, 0.0, 0.0]))
    mbs.AddObject(items.ObjectJointRevolute2D(markerNumbers=[fixed, held]))
    mbs.Assemble()

    def speed(mbs, time=0.0):
        return mbs.GetNodeOutput(node, exu.OutputVariableType.Coordinates_t)[2]

    found = [(0.0, 0.0)]
    mbs.SetPostStepUserFunction(lambda mbs, time: found.append((time, speed(mbs))) or True)
    chosen = settings(5.0)
    chosen.timeIntegration.numberOfSteps = 100
    assert solve_dynamic(mbs, chosen, tolerance=1e-3, event=speed).check()
    times, speeds = np.array(found).T
    short = np.diff(times) < 1e-6
    assert np.count_nonzero(short) >= 2
    assert np.abs(np.diff(speeds)[short]).max() < 1e-3
    inertia = 2.0 * 0.7**2 + 0.05
    half = 2.0 * ellipk(np.sin(0.5 * np.radians(170.0)) ** 2) / np.sqrt(2.0 * 9.81 * 0.7 / inertia)
    first = times[np.flatnonzero((speeds[:-1] < 0.0) & (speeds[1:] > 0.0))[0]]
    assert first == pytest.approx(half, abs=3e-4)


def test_what_cannot_be_sampled_is_refused():
    with pytest.raises(InputError, match="sample = -1"):
        solve_dynamic(mass(), settings(), sample=-1.0)
    with pytest.raises(InputError, match=r"hold = True: .* sample = 0.0 has none"):
        solve_dynamic(mass(), settings(), sample=0.0, hold=True)
    with pytest.raises(InputError, match="event: allowed with a tolerance"):
        solve_dynamic(mass(), settings(), tolerance=None, event=lambda mbs, time: 1.0)
