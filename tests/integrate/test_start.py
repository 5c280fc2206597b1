"""A start that fits the constraints, whatever Exudyn and the drawing have."""

import exudyn as exu
import exudyn.utilities as items
import numpy as np
import pytest

from exu_press import Status, solve_dynamic

CURRENT = exu.ConfigurationType.Current


def swing(offset=None, place=(1.0, 0.0), velocity=(0.0, 0.0), load=-9.81):
    """A point mass at a metre from the ground, or with a first coordinate that is prescribed."""
    mbs = exu.SystemContainer().AddSystem()
    ground = mbs.AddObject(items.ObjectGround())
    node = mbs.AddNode(
        items.NodePoint2D(referenceCoordinates=list(place), initialVelocities=list(velocity))
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


def settings(end=0.5):
    chosen = exu.SimulationSettings()
    chosen.timeIntegration.endTime, chosen.solution.file.write = end, False
    return chosen


def states(mbs, **keys):
    """Positions, velocities and accelerations at the start, and the outcome."""
    found = []

    def record(mbs, time):
        data = mbs.systemData
        of = data.GetODE2CoordinatesTotal, data.GetODE2Coordinates_t, data.GetODE2Coordinates_tt
        found.append([np.array(part(CURRENT)) for part in of])
        return True

    mbs.SetPostStepUserFunction(record)
    outcome = solve_dynamic(mbs, settings(), **keys)
    return found[0], outcome, found


def test_a_prescribed_motion_starts_as_it_is_prescribed():
    """x = 1 - cos(5 t) + 2 t: at 2 m/s and 25 m/s^2, of which Exudyn knows nothing."""
    mbs = swing(offset=lambda mbs, time, item, offset: 1.0 - np.cos(5.0 * time) + 2.0 * time)
    (_, velocity, acceleration), outcome, found = states(mbs)
    assert outcome.status is Status.COMPLETED
    assert velocity == pytest.approx([2.0, 0.0], rel=1e-6, abs=1e-6)
    assert acceleration == pytest.approx([25.0, -9.81], rel=1e-4)
    speed = found[-1][1][0]
    assert speed == pytest.approx(2.0 + 5.0 * np.sin(2.5), abs=5e-3)
    assert outcome.steps < 200


def test_a_system_at_rest_that_is_set_moving_later():
    mbs = swing(offset=lambda mbs, time, item, offset: 0.1 * max(time - 0.2, 0.0) ** 2, load=0.0)
    _, outcome, found = states(mbs)
    assert outcome.status is Status.COMPLETED, outcome.reason
    assert found[-1][1][0] == pytest.approx(0.06, rel=5e-3)


def test_a_drawing_of_few_digits_is_put_together():
    """Off by 20 um, and by a millimetre a second: a first step of 10 us would make 4 m/s of it."""
    mbs = swing(place=(0.6, 0.80002), velocity=(0.001, 0.0))
    (place, velocity, _), outcome, _ = states(mbs)
    assert outcome.status is Status.COMPLETED
    assert np.hypot(*place) == pytest.approx(1.0, abs=1e-9)
    assert place @ velocity == pytest.approx(0.0, abs=1e-6)
    assert outcome.steps < 200


def test_a_start_that_fits_is_left_alone():
    mbs = swing(place=(0.6, 0.8), velocity=(0.8, -0.6))
    (place, velocity, _), _, _ = states(mbs)
    assert place.tolist() == [0.6, 0.8] and velocity.tolist() == [0.8, -0.6]
