"""Prescribed motions whose velocities jump: steps end there, and the motion begins anew."""

import exudyn as exu
import exudyn.utilities as items
import numpy as np
import pytest

from exu_press import SolverStatus, add_dry_revolute, add_lubricated_revolute, solve_dynamic
from exu_press.laws.contact import hertz, step_damping
from exu_press.laws.film import finite
from exu_press.laws.friction import no_friction
from exudyn_examples.flexible import cables, hold
from exudyn_examples.planar import bar, pin


def settings(end, smallest=1e-8):
    chosen = exu.SimulationSettings()
    chosen.timeIntegration.endTime, chosen.timeIntegration.numberOfSteps = end, 100
    chosen.timeIntegration.minimumStepSize = smallest
    chosen.timeIntegration.generalizedAlpha.spectralRadius = 0.8
    chosen.solution.file.write = False
    return chosen


def prescribe(mbs, node, coordinate, motion):
    """Let a function of time give a coordinate of a node."""
    hold(mbs, node, (coordinate,), offsetUserFunction=lambda mbs, time, item, given: motion(time))


def pulled(offset):
    """A mass of 2 kg on a spring of 400 N/m, whose other end a function of time moves."""
    mbs = exu.SystemContainer().AddSystem()
    nodes = [
        mbs.AddNode(items.NodePoint2D()),
        mbs.AddNode(items.NodePoint2D(referenceCoordinates=[1.0, 0.0])),
    ]
    for node, mass in zip(nodes, (1.0, 2.0), strict=True):
        mbs.AddObject(items.ObjectMassPoint2D(nodeNumber=node, mass=mass))
        hold(mbs, node, (1,))
    ends = [
        mbs.AddMarker(items.MarkerNodeCoordinate(nodeNumber=node, coordinate=0)) for node in nodes
    ]
    spring = items.ObjectConnectorCoordinateSpringDamper
    mbs.AddObject(spring(markerNumbers=ends, stiffness=400.0))
    prescribe(mbs, nodes[0], 0, offset)
    mbs.Assemble()
    return mbs, nodes


def test_a_cable_goes_on_after_the_velocity_of_its_end_jumps():
    """A cable's end is given another speed at once; until then it rests."""
    mbs = exu.SystemContainer().AddSystem()
    nodes, _ = cables(mbs, 2.1e8)
    hold(mbs, nodes[0], (0,))
    prescribe(mbs, nodes[0], 1, lambda time: max(0.0, time - 0.01))
    mbs.Assemble()
    outcome = solve_dynamic(mbs, settings(0.0101), tolerance=1e-2, max_steps=5000)
    assert outcome.status is SolverStatus.COMPLETED, outcome.reason
    assert mbs.GetNodeOutput(nodes[0], exu.OutputVariableType.Velocity)[1] == pytest.approx(1.0)


@pytest.mark.parametrize("tolerance", [1e-3, 1e-5])
def test_the_velocity_of_a_prescribed_motion_may_jump(tolerance):
    """A ramp from 0.3 to 0.7 s; its corners are no load's, and steps end on them.

    Each corner is an impulse on what is prescribed, and none on the mass behind the spring.
    """
    mbs, (end, body) = pulled(lambda time: min(max(0.0, time - 0.3), 0.4))
    velocity = exu.OutputVariableType.Velocity
    sensors = [
        mbs.AddSensor(
            items.SensorNode(nodeNumber=node, outputVariableType=velocity, storeInternal=True)
        )
        for node in (end, body)
    ]
    mbs.Assemble()
    chosen = settings(1.0)
    chosen.solution.sensors.writePeriod = 0.03125
    outcome = solve_dynamic(mbs, chosen, tolerance=tolerance)
    assert outcome.status is SolverStatus.COMPLETED, outcome.reason
    times = mbs.GetSensorStoredData(sensors[0])[:, 0]
    rate = np.sqrt(400.0 / 2.0)  # rad/s
    ends = ((times > 0.3) & (times < 0.7)).astype(float)
    bodies = sum(
        sign * np.where(times > corner, 1.0 - np.cos(rate * (times - corner)), 0.0)
        for sign, corner in ((1.0, 0.3), (-1.0, 0.7))
    )
    for sensor, expected in zip(sensors, (ends, bodies), strict=True):
        found = mbs.GetSensorStoredData(sensor)[:, 1]
        assert found == pytest.approx(expected, abs=3.5 * tolerance)


@pytest.mark.parametrize("behind", [1e-8, 1e-7, 1e-6, 1e-5])
def test_a_corner_right_behind_a_step(behind):
    """A step up to the corner, s, leaves the motion as it was; the system is linear."""

    def swing(time):
        return 0.1 * np.sin(3.0 * time)

    ends, velocities = [], []
    mbs, _ = pulled(swing)
    outcome = solve_dynamic(mbs, settings(1.0), watch=lambda time: ends.append(time) or "")
    velocities.append(mbs.systemData.GetODE2Coordinates_t()[2])
    corner = min(ends, key=lambda time: abs(time - 0.5)) + behind
    mbs, _ = pulled(lambda time: swing(time) + max(0.0, time - corner))
    told = solve_dynamic(mbs, settings(1.0))
    velocities.append(mbs.systemData.GetODE2Coordinates_t()[2])
    assert told.steps < 1.5 * outcome.steps + 150, "no step answers to a corner ahead"
    expected = 1.0 - np.cos(np.sqrt(200.0) * (1.0 - corner))
    assert velocities[1] - velocities[0] == pytest.approx(expected, abs=4e-3)


def test_a_prescribed_place_that_jumps_is_thought_of():
    mbs, _ = pulled(lambda time: 0.1 if time > 0.01 else 0.0)
    outcome = solve_dynamic(mbs, settings(0.02), tolerance=1e-4, max_steps=3000)
    assert outcome.status is SolverStatus.STEP_TOO_SMALL, outcome.reason
    assert outcome.end_time == pytest.approx(0.01) and "offset that jumps" in outcome.reason
    assert outcome.steps < 150


RATE = np.sqrt(400.0 / 2.0)  # rad/s, of the mass behind its spring


def follows(velocity, corner, tolerance):
    """Whether the mass answers at 1 s to a ramp from a corner on (s), in some tolerances."""
    expected = 1.0 - np.cos(RATE * (1.0 - corner))
    return velocity == pytest.approx(expected, abs=3.5 * tolerance)


@pytest.mark.parametrize("tolerance", [1e-2, 1e-3])
def test_a_velocity_may_jump_anywhere(tolerance):
    """Steps near a corner are no smaller than it takes to end before and behind it."""
    undisturbed = 100 if tolerance == 1e-2 else 180
    for corner in np.arange(0.3, 0.7, 0.007):
        mbs, (_, body) = pulled(lambda time, corner=corner: max(0.0, time - corner))
        outcome = solve_dynamic(mbs, settings(1.0), tolerance=tolerance)
        assert outcome.status is SolverStatus.COMPLETED, (corner, outcome.reason)
        assert outcome.steps + outcome.rejected_steps < undisturbed + 60, corner
        velocity = mbs.GetNodeOutput(body, exu.OutputVariableType.Velocity)[0]
        assert follows(velocity, corner, tolerance), corner


@pytest.mark.parametrize("smallest", [1e-12, 1e-10, 1e-6, 1e-4])
@pytest.mark.parametrize("start", [0.0, 1e3, 1e5])
def test_a_velocity_may_jump_at_any_time_for_any_smallest_step(smallest, start):
    """Times of 1e5 s are rounded to 1e-11 s."""
    if smallest < 1e-15 * start:
        pytest.skip("the smallest step is rounding")
    mbs, (_, body) = pulled(lambda time: max(0.0, time - start - 0.6))
    chosen = settings(start + 1.0, smallest)
    chosen.timeIntegration.startTime = start
    outcome = solve_dynamic(mbs, chosen)
    assert outcome.status is SolverStatus.COMPLETED, outcome.reason
    assert follows(mbs.GetNodeOutput(body, exu.OutputVariableType.Velocity)[0], 0.6, 1e-3)


@pytest.mark.parametrize("width", [1e-4, 3e-7, 1e-7, 3e-8, 1e-8, 1e-9])
def test_a_corner_may_be_rounded(width):
    """Within some smallest steps or less it is as good as sharp."""

    def rounded(time):
        begun = time - 0.5 + 0.37 * width
        return 0.5 * max(begun, 0.0) ** 2 / width if begun < width else begun - 0.5 * width

    mbs, (_, body) = pulled(rounded)
    outcome = solve_dynamic(mbs, settings(1.0))
    assert outcome.status is SolverStatus.COMPLETED, outcome.reason
    assert follows(mbs.GetNodeOutput(body, exu.OutputVariableType.Velocity)[0], 0.5, 1e-3)


@pytest.mark.parametrize("apart", [1e-8, 1e-6, 1e-4])
def test_corners_may_be_close_to_each_other(apart):
    """A ramp is over as soon as it has begun: hardly anything has moved."""
    mbs, (end, body) = pulled(lambda time: max(0.0, time - 0.35) - max(0.0, time - 0.35 - apart))
    outcome = solve_dynamic(mbs, settings(1.0))
    assert outcome.status is SolverStatus.COMPLETED, outcome.reason
    assert outcome.steps < 300
    velocity = exu.OutputVariableType.Velocity
    assert mbs.GetNodeOutput(end, velocity)[0] == pytest.approx(0.0, abs=1e-6)
    # the spring was longer by the whole way from then on
    expected = apart * RATE * np.sin(RATE * 0.65)
    assert mbs.GetNodeOutput(body, velocity)[0] == pytest.approx(expected, abs=2e-2 * apart * RATE)


def test_a_motion_may_be_given_by_a_table():
    """Between its points a table is a line: each of them is a corner."""
    grid = np.linspace(0.0, 1.0, 101)
    places = 0.05 * np.sin(4.0 * np.pi * grid)
    velocities = []
    for motion in (
        lambda time: float(np.interp(time, grid, places)),
        lambda time: 0.05 * np.sin(4.0 * np.pi * time),
    ):
        mbs, (_, body) = pulled(motion)
        outcome = solve_dynamic(mbs, settings(1.0))
        assert outcome.status is SolverStatus.COMPLETED, outcome.reason
        velocities.append(mbs.GetNodeOutput(body, exu.OutputVariableType.Velocity)[0])
    # chords are up to (h^2 / 8) of the second derivative short of the sine
    assert velocities[0] == pytest.approx(velocities[1], abs=5e-3)


def rocking(motion):
    """Two arms in a row, with a spring between; a function of time turns the first."""
    mbs = exu.SystemContainer().AddSystem()
    ground = mbs.AddObject(items.ObjectGround())
    arm, half, node = bar(mbs, (0.0, 0.0), (1.0, 0.0), 2.0)
    other, its_half, its_node = bar(mbs, (1.0, 0.0), (2.0, 0.0), 1.0)
    pin(mbs, ground, (0.0, 0.0), arm, (-half, 0.0))
    pin(mbs, arm, (half, 0.0), other, (-its_half, 0.0))
    angles = [
        mbs.AddMarker(items.MarkerNodeCoordinate(nodeNumber=number, coordinate=2))
        for number in (node, its_node)
    ]
    spring = items.ObjectConnectorCoordinateSpringDamper
    mbs.AddObject(spring(markerNumbers=angles, stiffness=3e3, damping=5.0))
    prescribe(mbs, node, 2, motion)
    mbs.Assemble()
    return mbs


@pytest.mark.parametrize(
    ("rate", "height", "tolerance", "most"),
    [
        (6.95, 1.3e-4, 1e-3, 2600),
        (16.05, 5.6e-5, 1e-3, 2600),
        (27.4, 0.11, 1e-2, 1900),
    ],
)
def test_velocities_that_jump_again_and_again_leave_nothing_ringing(rate, height, tolerance, most):
    """Also those that a step has room for in part."""
    mbs = rocking(lambda time: height * abs(np.sin(rate * time)))
    outcome = solve_dynamic(mbs, settings(1.0), tolerance=tolerance, max_steps=most)
    assert outcome.status is SolverStatus.COMPLETED, outcome.reason


def test_a_place_that_jumps_with_its_velocity_stops_the_run():
    mbs, _ = pulled(lambda time: 0.1 + time if time > 0.35 else 0.0)
    outcome = solve_dynamic(mbs, settings(1.0))
    assert outcome.status is SolverStatus.STEP_TOO_SMALL
    assert outcome.end_time == pytest.approx(0.35) and "offset that jumps" in outcome.reason


def swung(motion):
    """A bar in space whose joint a function of time turns, and another one at its end."""
    mbs = exu.SystemContainer().AddSystem()
    ground = mbs.CreateGround()
    bars = [
        mbs.CreateRigidBody(
            referencePosition=[middle, 0.0, 0.0],
            inertia=items.InertiaCuboid(1000.0, [1.0, width, width]),
            gravity=[0.0, 0.0, -9.81],
        )
        for middle, width in ((0.5, 0.1), (1.5, 0.05))
    ]
    for (one, at), (other, held) in (
        ((ground, 0.0), (bars[0], {"offsetUserFunction": lambda mbs, time, *others: motion(time)})),
        ((bars[0], 0.5), (bars[1], {"constrainedAxes": [1, 1, 1, 0, 0, 0]})),
    ):
        markers = [
            mbs.AddMarker(items.MarkerBodyRigid(bodyNumber=body, localPosition=[place, 0.0, 0.0]))
            for body, place in ((one, at), (other, -0.5))
        ]
        mbs.AddObject(items.GenericJoint(markerNumbers=markers, **held))
    mbs.Assemble()
    return mbs


def test_a_jump_in_the_last_part_of_a_good_step_is_found_by_the_next_one():
    """So small a part of it lies behind the jump that the step seems good enough."""
    tolerance = 1e-2
    for corner in np.arange(0.1, 0.2, 0.0023):
        found = []
        for asked in (0.1 * tolerance, tolerance):

            def turned(time, corner=corner):
                return [0.0] * 5 + [2.0 * max(0.0, time - corner)]

            mbs = swung(turned)
            outcome = solve_dynamic(mbs, settings(0.5), tolerance=asked)
            assert outcome.status is SolverStatus.COMPLETED, (corner, outcome.reason)
            found.append(mbs.systemData.GetODE2Coordinates_t())
        assert found[1] == pytest.approx(found[0], abs=2.0 * tolerance), corner


def cranked(joint, motion):
    """A slider-crank with a clearance at the crank pin; a function of time turns the crank."""
    mbs = exu.SystemContainer().AddSystem()
    ground = mbs.AddObject(items.ObjectGround())
    crank, half, node = bar(mbs, (0.0, 0.0), (0.2, 0.0), 5.0)
    rod, its_half, _ = bar(mbs, (0.2, 0.0), (1.0, 0.0), 10.0)
    pin(mbs, ground, (0.0, 0.0), crank, (-half, 0.0))
    ends = (crank, (half, 0.0)), (rod, (-its_half, 0.0))
    size = {"radius": 0.02, "clearance": 5e-5}
    if joint == "dry":
        contact = step_damping(hertz(2.5e10), 2.5e6, 1e-5)
        add_dry_revolute(mbs, *ends, **size, contact=contact, friction=no_friction())
    else:
        add_lubricated_revolute(mbs, *ends, **size, length=0.03, viscosity=0.1, law=finite(0.75))
    slider = mbs.AddNode(items.NodePoint2D(referenceCoordinates=[1.0, 0.0]))
    body = mbs.AddObject(items.ObjectMassPoint2D(nodeNumber=slider, mass=20.0))
    wrist = [
        mbs.AddMarker(items.MarkerBodyPosition(bodyNumber=rod, localPosition=[its_half, 0.0, 0.0])),
        mbs.AddMarker(items.MarkerBodyPosition(bodyNumber=body)),
    ]
    mbs.AddObject(items.ObjectJointRevolute2D(markerNumbers=wrist))
    hold(mbs, slider, (1,))
    prescribe(mbs, node, 2, motion)
    mbs.Assemble()
    return mbs, slider


SPEED, STARTS = 30.0, 0.05  # rad/s, s


@pytest.mark.parametrize(("joint", "allowed"), [("dry", 0.02), ("lubricated", 2e-3)])
def test_a_crank_with_a_clearance_may_start_at_once(joint, allowed):
    """The slider follows the crank, but for the clearance."""
    velocity = exu.OutputVariableType.Velocity
    mbs, slider = cranked(joint, lambda time: SPEED * max(0.0, time - STARTS))
    outcome = solve_dynamic(mbs, settings(0.2))
    assert outcome.status is SolverStatus.COMPLETED, outcome.reason
    angle = SPEED * (0.2 - STARTS)
    sine, across = 0.2 * np.sin(angle), np.sqrt(0.8**2 - (0.2 * np.sin(angle)) ** 2)
    expected = -SPEED * sine * (1.0 + 0.2 * np.cos(angle) / across)
    assert mbs.GetNodeOutput(slider, velocity)[0] == pytest.approx(expected, abs=allowed)


@pytest.mark.parametrize("joint", ["dry", "lubricated"])
def test_a_crank_with_a_clearance_may_follow_a_table(joint):
    grid = np.linspace(0.0, 0.1, 21)
    angles = SPEED * grid + 0.05 * np.sin(SPEED * grid)
    mbs, _ = cranked(joint, lambda time: float(np.interp(time, grid, angles)))
    outcome = solve_dynamic(mbs, settings(0.1))
    assert outcome.status is SolverStatus.COMPLETED, outcome.reason
