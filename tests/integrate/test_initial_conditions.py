"""Consistent initial conditions: a start is moved onto its constraints, or refused."""

import exudyn as exu
import exudyn.utilities as items
import numpy as np
import pytest
from stand_in_system import settings

from exu_press import InputError
from exu_press.integrate import SolverStatus, solve_dynamic

CURRENT = exu.ConfigurationType.Current


def swing(offset=None, position=(1.0, 0.0), velocity=(0.0, 0.0), load=-9.81):
    """A point mass at a metre from the ground, or with a first coordinate that is prescribed."""
    mbs = exu.SystemContainer().AddSystem()
    ground = mbs.AddObject(items.ObjectGround())
    node = mbs.AddNode(
        items.NodePoint2D(referenceCoordinates=list(position), initialVelocities=list(velocity))
    )
    mbs.AddObject(items.ObjectMassPoint2D(nodeNumber=node, mass=2.0))
    at = mbs.AddMarker(items.MarkerNodePosition(nodeNumber=node))
    if offset is None:
        centre = mbs.AddMarker(items.MarkerBodyPosition(bodyNumber=ground))
        mbs.AddObject(items.ObjectConnectorDistance(markerNumbers=[centre, at], distance=1.0))
    else:
        still = mbs.AddNode(items.NodePointGround())
        ends = [
            mbs.AddMarker(items.MarkerNodeCoordinate(nodeNumber=number, coordinate=0))
            for number in (still, node)
        ]
        mbs.AddObject(
            items.ObjectConnectorCoordinate(markerNumbers=ends, offsetUserFunction=offset)
        )
    mbs.AddLoad(items.LoadForceVector(markerNumber=at, loadVector=[0.0, 2.0 * load, 0.0]))
    mbs.Assemble()
    return mbs


def states(mbs, **keys):
    """Positions, velocities and accelerations at the start, the outcome, and all such states."""
    recorded = []

    def record(mbs, time):
        data = mbs.systemData
        of = data.GetODE2CoordinatesTotal, data.GetODE2Coordinates_t, data.GetODE2Coordinates_tt
        recorded.append([np.array(quantity(CURRENT)) for quantity in of])
        return True

    mbs.SetPostStepUserFunction(record)
    outcome = solve_dynamic(mbs, settings(0.5), **keys)
    return recorded[0], outcome, recorded


def test_a_prescribed_motion_starts_as_it_is_prescribed():
    """x = 1 - cos(5 t) + 2 t: at 2 m/s and 25 m/s^2, of which Exudyn knows nothing."""
    mbs = swing(offset=lambda mbs, time, item, offset: 1.0 - np.cos(5.0 * time) + 2.0 * time)
    (_, velocity, acceleration), outcome, recorded = states(mbs)
    assert outcome.status is SolverStatus.COMPLETED
    assert velocity == pytest.approx([2.0, 0.0], rel=1e-6, abs=1e-6)
    assert acceleration == pytest.approx([25.0, -9.81], rel=1e-4)
    assert recorded[-1][1][0] == pytest.approx(2.0 + 5.0 * np.sin(2.5), abs=5e-3)
    assert outcome.steps < 250


@pytest.mark.filterwarnings("error::UserWarning")
def test_a_drawing_of_few_digits_is_put_together():
    """Off by 20 um, and by a millimetre a second: a first step of 10 us would make 4 m/s of it."""
    mbs = swing(position=(0.6, 0.80002), velocity=(0.001, 0.0))
    (position, velocity, _), outcome, _ = states(mbs)
    assert outcome.status is SolverStatus.COMPLETED
    assert np.hypot(*position) == pytest.approx(1.0, abs=1e-9)
    assert position @ velocity == pytest.approx(0.0, abs=1e-6)
    assert outcome.steps < 200


def test_a_joint_in_space_that_starts_off_is_put_together():
    """Its directions in Exudyn's Jacobian are not those of its violation: it takes iterations."""
    mbs = exu.SystemContainer().AddSystem()
    turned = items.RotationMatrixX(0.6) @ items.RotationMatrixY(0.5) @ items.RotationMatrixZ(0.08)
    body = mbs.CreateRigidBody(
        inertia=items.InertiaCuboid(1000.0, [0.3, 0.2, 0.1]),
        referenceRotationMatrix=turned,
        initialAngularVelocity=[1.0, 2.0, 3.0],
    )
    bodies = mbs.CreateGround(), body
    ends = [mbs.AddMarker(items.MarkerBodyRigid(bodyNumber=number)) for number in bodies]
    joint = items.ObjectJointGeneric(markerNumbers=ends, constrainedAxes=[1, 1, 1, 0, 0, 1])
    number = mbs.AddObject(joint)
    mbs.Assemble()
    with pytest.warns(UserWarning, match="start did not fit"):
        _, outcome, _ = states(mbs)
    assert outcome.status is SolverStatus.COMPLETED
    assert outcome.steps < 400
    angles = mbs.GetObjectOutput(number, exu.OutputVariableType.Rotation)
    assert np.sin(angles[2]) == pytest.approx(0.0, abs=1e-6)


def test_a_start_that_is_far_off_is_refused():
    """Which position is meant is not known."""
    mbs = swing(position=(0.6, 0.6))
    before = mbs.systemData.GetODE2Coordinates_t()
    message = r"0\.15 off what .* \(ConnectorDistance\) holds.*positions"
    with pytest.raises(InputError, match=message):
        states(mbs)
    assert mbs.systemData.GetODE2Coordinates_t().tolist() == before.tolist()


@pytest.mark.parametrize(
    ("position", "velocity", "changed", "errors"),
    [
        ((1.0, 0.0), (0.5, 2.0), "up to 0 m, velocities by up to 0.5 m/s", False),
        ((0.99, 0.0), (0.0, 2.0), "up to 0.01 m, velocities by up to 0 m/s", True),
    ],
)
def test_a_start_that_is_moved_by_much_is_reported(position, velocity, changed, errors):
    mbs = swing(position=position, velocity=velocity)
    message = f"start did not fit joints .* by {changed}"
    with pytest.warns(UserWarning, match=message) as caught:
        _, outcome, _ = states(mbs, errors=errors)
    assert outcome.status is SolverStatus.COMPLETED
    assert [warning.filename for warning in caught] == [__file__]


@pytest.mark.filterwarnings("error::UserWarning")
def test_a_start_that_fits_is_left_alone():
    mbs = swing(position=(0.6, 0.8), velocity=(0.8, -0.6))
    (position, velocity, _), _, _ = states(mbs)
    assert position.tolist() == [0.6, 0.8] and velocity.tolist() == [0.8, -0.6]
