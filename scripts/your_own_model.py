"""A four-bar linkage of your own, solved to a tolerance; then with a worn pin.

Run with: python scripts/your_own_model.py
"""

import argparse

import exudyn as exu
import exudyn.utilities as items
import numpy as np

from exu_press import SolverStatus, add_dry_revolute, solve_dynamic
from exu_press.laws.contact import hertz, hunt_crossley
from exu_press.laws.friction import no_friction

argparse.ArgumentParser(description=__doc__).parse_args()

FRAME = [(0.0, 0.0), (0.3, 0.0)]  # the two pivots, m
CRANK_PIN, ROCKER_PIN = (0.0, 0.1), (0.25, 0.25)  # in the drawing, m
SPEED, REVOLUTIONS = 20.0, 2.0  # rad/s


def four_bar(clearance=None):
    """The assembled system, and the sensor of the force in the pin between coupler and rocker."""
    mbs = exu.SystemContainer().AddSystem()
    ground = mbs.AddObject(items.ObjectGround())

    def bar(start, end, velocity):
        """A uniform steel bar from point to point: its object, half its vector, its angle."""
        (x0, y0), (x1, y1) = start, end
        half, angle = 0.5 * np.hypot(x1 - x0, y1 - y0), np.arctan2(y1 - y0, x1 - x0)
        mass = 7850.0 * 0.03 * 0.02 * 2.0 * half
        node = mbs.AddNode(
            items.NodeRigidBody2D(
                referenceCoordinates=[0.5 * (x0 + x1), 0.5 * (y0 + y1), angle],
                initialVelocities=velocity,
            )
        )
        inertia = mass * (2.0 * half) ** 2 / 12.0
        body = mbs.AddObject(items.ObjectRigidBody2D(nodeNumber=node, mass=mass, inertia=inertia))
        centre = mbs.AddMarker(items.MarkerBodyMass(bodyNumber=body))
        mbs.AddLoad(items.LoadMassProportional(markerNumber=centre, loadVector=[0.0, -9.81, 0.0]))
        return body, half, node

    # at this instant the crank pin moves to the left: the coupler's angular velocity is w_2,
    # the rocker's w_3, from v(rocker pin) = v(crank pin) + w_2 x coupler = w_3 x rocker
    crank, coupler, rocker = (
        np.subtract(CRANK_PIN, FRAME[0]),
        np.subtract(ROCKER_PIN, CRANK_PIN),
        np.subtract(ROCKER_PIN, FRAME[1]),
    )
    pin = SPEED * np.array([-crank[1], crank[0]])
    w_2, w_3 = np.linalg.solve([[-coupler[1], rocker[1]], [coupler[0], -rocker[0]]], -pin)
    first = bar(FRAME[0], CRANK_PIN, [*0.5 * pin, SPEED])
    middle = pin + 0.5 * w_2 * np.array([-coupler[1], coupler[0]])
    second = bar(CRANK_PIN, ROCKER_PIN, [*middle, w_2])
    third = bar(FRAME[1], ROCKER_PIN, [*0.5 * w_3 * np.array([-rocker[1], rocker[0]]), w_3])

    def joint(first, at_first, second, at_second):
        markers = [
            mbs.AddMarker(items.MarkerBodyRigid(bodyNumber=body, localPosition=[*at, 0.0]))
            for body, at in ((first, at_first), (second, at_second))
        ]
        return mbs.AddObject(items.ObjectJointRevolute2D(markerNumbers=markers))

    joint(ground, FRAME[0], first[0], (-first[1], 0.0))
    joint(first[0], (first[1], 0.0), second[0], (-second[1], 0.0))
    pivot = joint(ground, FRAME[1], third[0], (-third[1], 0.0))
    ends = (second[0], (second[1], 0.0)), (third[0], (third[1], 0.0))
    if clearance is None:
        joint(*ends[0], *ends[1])
    else:
        laws = {"contact": hunt_crossley(hertz(1e10), 0.7), "friction": no_friction()}
        add_dry_revolute(mbs, *ends, radius=0.01, clearance=clearance, **laws)
    node = mbs.AddNode(items.NodePointGround())
    turned = [
        mbs.AddMarker(items.MarkerNodeCoordinate(nodeNumber=number, coordinate=coordinate))
        for number, coordinate in ((node, 0), (first[2], 2))
    ]
    mbs.AddObject(
        items.ObjectConnectorCoordinate(markerNumbers=turned, velocityLevel=True, offset=SPEED)
    )
    sensor = mbs.AddSensor(
        items.SensorObject(
            objectNumber=pivot, storeInternal=True, outputVariableType=exu.OutputVariableType.Force
        )
    )
    mbs.Assemble()
    return mbs, sensor


def solve(clearance, tolerance):
    """Largest force in the rocker's pivot, N, and the outcome."""
    mbs, sensor = four_bar(clearance)
    settings = exu.SimulationSettings()
    settings.timeIntegration.endTime = REVOLUTIONS * 2.0 * np.pi / SPEED
    settings.solution.file.write, settings.solution.sensors.writePeriod = False, 0.0
    outcome = solve_dynamic(mbs, settings, tolerance=tolerance)
    assert outcome.status is SolverStatus.COMPLETED, outcome.reason
    return np.linalg.norm(mbs.GetSensorStoredData(sensor)[:, 1:], axis=1).max(), outcome


for clearance in (None, 1e-5):
    print("ideal joints" if clearance is None else f"{1e6 * clearance:.0f} um in the rocker pin")
    for tolerance in (1e-2, 1e-3, 1e-4):
        force, outcome = solve(clearance, tolerance)
        print(f"  tolerance {tolerance:g}: {force:.5g} N, {outcome.steps} steps")
