"""Joints that slide along cables: a mass on a bent wire has the speed that its height gives it."""

import itertools

import exudyn as exu
import exudyn.utilities as items
import numpy as np
import pytest

from exu_press import SolverStatus, solve_dynamic

GRAVITY = 9.81  # m/s^2
RADIUS = 1.0  # of a quarter of a circle, m
ELEMENTS = 4
LENGTH = 0.5 * np.pi * RADIUS / ELEMENTS  # of an element, m
START = 0.5 * LENGTH  # place of the mass on the wire, m
SPEED = 1.0  # m/s, there
POSITION, VELOCITY = exu.OutputVariableType.Position, exu.OutputVariableType.Velocity


def wire(mbs, dimensions):
    """A cable that is held as a quarter of a circle, downwards from its left end; its markers."""
    plane = dimensions == 2
    still = mbs.AddNode(items.NodePointGround())
    ground = mbs.AddMarker(items.MarkerNodeCoordinate(nodeNumber=still, coordinate=0))
    node_kind = items.NodePoint2DSlope1 if plane else items.NodePointSlope1
    cable_kind = items.ObjectANCFCable2D if plane else items.ObjectANCFCable
    marker_kind = items.MarkerBodyCable2DCoordinates if plane else items.MarkerBodyBeamShape
    nodes = []
    for angle in np.linspace(0.0, 0.5 * np.pi, ELEMENTS + 1):
        place = [-RADIUS * np.cos(angle), -RADIUS * np.sin(angle), 0.0]
        slope = [np.sin(angle), -np.cos(angle), 0.0]
        found = [*place[:dimensions], *slope[:dimensions]]
        nodes.append(mbs.AddNode(node_kind(referenceCoordinates=found)))
        for i in range(2 * dimensions):
            one = items.MarkerNodeCoordinate(nodeNumber=nodes[-1], coordinate=i)
            mbs.AddObject(items.CoordinateConstraint(markerNumbers=[ground, mbs.AddMarker(one)]))
    cables = [
        cable_kind(length=LENGTH, massPerLength=1.0, nodeNumbers=list(pair))
        for pair in itertools.pairwise(nodes)
    ]
    return [mbs.AddMarker(marker_kind(bodyNumber=mbs.AddObject(cable))) for cable in cables]


def sliding(dimensions=2, start=START, **keys):
    """A mass that slides down a wire from a place; the numbers of its node and of the joint."""
    mbs = exu.SystemContainer().AddSystem()
    markers = wire(mbs, dimensions)
    place, direction = on_the_wire(start)
    kind = items.NodePoint2D if dimensions == 2 else items.NodePoint
    node = mbs.AddNode(
        kind(
            referenceCoordinates=[*place, 0.0][:dimensions],
            initialVelocities=[*(SPEED * direction), 0.0][:dimensions],
        )
    )
    body = items.ObjectMassPoint2D if dimensions == 2 else items.ObjectMassPoint
    mbs.AddObject(body(mass=0.3, nodeNumber=node))
    at = mbs.AddMarker(items.MarkerNodePosition(nodeNumber=node))
    mbs.AddLoad(items.LoadForceVector(markerNumber=at, loadVector=[0.0, -0.3 * GRAVITY, 0.0]))
    data = items.NodeGenericData(initialCoordinates=[0, start], numberOfDataCoordinates=2)
    joint = items.ObjectJointSliding2D if dimensions == 2 else items.ObjectJointSliding
    number = mbs.AddObject(
        joint(
            markerNumbers=[at, markers[0]],
            slidingMarkerNumbers=markers,
            slidingMarkerOffsets=[LENGTH * i for i in range(ELEMENTS)],
            nodeNumber=mbs.AddNode(data),
            **keys,
        )
    )
    mbs.Assemble()
    return mbs, node, number


def on_the_wire(place):
    """Place and direction of the wire, whose elements are cubics, at a length along it, m."""
    number = min(int(place // LENGTH), ELEMENTS - 1)
    angles = 0.5 * np.pi * np.array([number, number + 1]) / ELEMENTS
    (x, y), (u, v) = (-np.cos(angles), -np.sin(angles)), (np.sin(angles), -np.cos(angles))
    s = place / LENGTH - number
    shape = np.array([1 - 3 * s**2 + 2 * s**3, 3 * s**2 - 2 * s**3])
    sloped = LENGTH * np.array([s - 2 * s**2 + s**3, s**3 - s**2])
    rate = np.array([6 * s**2 - 6 * s, 6 * s - 6 * s**2]) / LENGTH
    sloped_rate = np.array([1 - 4 * s + 3 * s**2, 3 * s**2 - 2 * s])
    found = np.array([shape @ x + sloped @ u, shape @ y + sloped @ v])
    direction = np.array([rate @ x + sloped_rate @ u, rate @ y + sloped_rate @ v])
    return found, direction / np.hypot(*direction)


def run(mbs, tolerance, end=0.4, **keys):
    settings = exu.SimulationSettings()
    settings.timeIntegration.endTime, settings.solution.file.write = end, False
    settings.timeIntegration.numberOfSteps = 100
    outcome = solve_dynamic(mbs, settings, tolerance=tolerance, **keys)
    assert outcome.status is SolverStatus.COMPLETED, outcome.reason
    return outcome


def ends_on(mbs, node, number):
    """The place along the wire at the end, m, after a look whether it is that of the mass."""
    place = mbs.GetObjectOutput(number, exu.OutputVariableType.SlidingCoordinate)
    found = mbs.GetNodeOutput(node, POSITION)[:2]
    assert on_the_wire(place)[0] == pytest.approx(found, abs=1e-7)
    element = mbs.systemData.GetDataCoordinates()[0]
    assert element == place // LENGTH
    return place


def speed_by_height(mbs, node):
    """What its height says the speed of the mass is, m/s."""
    fallen = on_the_wire(START)[0][1] - mbs.GetNodeOutput(node, POSITION)[1]
    return np.sqrt(SPEED**2 + 2.0 * GRAVITY * fallen)


@pytest.mark.parametrize(
    ("dimensions", "keys"),
    [
        (2, {}),
        (2, {"useClassicalFormulation": False}),
        (3, {"constrainRotations": [0, 0, 0]}),
    ],
)
def test_a_mass_slides_down_a_bent_wire(dimensions, keys):
    """Over several elements; it starts with the acceleration to the wire's centre."""
    for tolerance in (1e-3, 1e-5):
        mbs, node, number = sliding(dimensions, **keys)
        run(mbs, tolerance)
        found = np.linalg.norm(mbs.GetNodeOutput(node, VELOCITY))
        place = ends_on(mbs, node, number)
        assert place > 2.0 * LENGTH
        assert found == pytest.approx(speed_by_height(mbs, node), rel=tolerance)


def test_rows_between_steps_tell_the_place_there():
    """Not that at the end of the step."""
    mbs, node, number = sliding()
    keys = {"storeInternal": True, "writeToFile": False}
    along, kind = exu.OutputVariableType.SlidingCoordinate, items.SensorObject
    place = mbs.AddSensor(kind(objectNumber=number, outputVariableType=along, **keys))
    of_node = items.SensorNode(nodeNumber=node, outputVariableType=POSITION, **keys)
    position = mbs.AddSensor(of_node)
    mbs.Assemble()
    run(mbs, 1e-3)
    found = np.array([on_the_wire(row[1])[0] for row in mbs.GetSensorStoredData(place)])
    assert found == pytest.approx(mbs.GetSensorStoredData(position)[:, 1:3], abs=1e-4)


def test_a_step_over_the_end_of_an_element_is_repeated():
    """For an event soon behind it: Exudyn leaves the joint on the next element."""
    start, behind = LENGTH - 3e-5, LENGTH + 1e-6
    mbs, _, number = sliding(start=start)
    data, (x, y) = mbs.systemData, on_the_wire(start)[0]
    unknown = data.GetObjectLTGAE(number)[2]
    off = []

    def passes(mbs, time):
        """Is asked after each try."""
        moved = data.GetODE2Coordinates()[-2:]
        place = data.GetDataCoordinates()[1] + data.GetAECoordinates()[unknown]
        off.append(on_the_wire(place)[0] - (x, y) - moved)
        return float(x + moved[0] - on_the_wire(behind)[0][0])

    outcome = run(mbs, 1e-4, event=passes)
    assert outcome.rejected_steps > 1
    assert np.abs(off).max() < 1e-7
