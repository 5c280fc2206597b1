"""Solvers on a system of a test's, without files and without a word; its bodies."""

import exudyn as exu
from exudyn.itemInterface import NodeRigidBody2D, ObjectRigidBody2D, SensorNode

from exu_press.integrate import SolverStatus, solve_dynamic


def solve(mbs, settings):
    """Solve an assembled system; sensors record every step, in memory."""
    settings.timeIntegration.verboseMode = 0
    settings.solution.file.write = False
    settings.solution.sensors.writePeriod = 0.0
    exu.config.printToConsole = False
    try:
        mbs.SolveDynamic(settings)
    finally:
        exu.config.printToConsole = True


def fixed_steps(duration, step):
    """Return settings with steps of one size."""
    settings = exu.SimulationSettings()
    settings.timeIntegration.numberOfSteps = round(duration / step)
    settings.timeIntegration.endTime = duration
    settings.timeIntegration.generalizedAlpha.spectralRadius = 0.9
    return settings


def completed(mbs, end, steps=200, tolerance=1e-4):
    """Solve an assembled system to a tolerance, up to its end."""
    settings = exu.SimulationSettings()
    settings.timeIntegration.endTime = end
    settings.timeIntegration.numberOfSteps = steps
    settings.timeIntegration.verboseMode = 0
    settings.solution.file.write = False
    settings.solution.sensors.writePeriod = 0.0
    outcome = solve_dynamic(mbs, settings, tolerance=tolerance)
    assert outcome.status is SolverStatus.COMPLETED, outcome.reason


def planar_body(mbs, mass, inertia, place=(0.0, 0.0, 0.0), velocity=(0.0, 0.0, 0.0), **node):
    """Add a body at x, y and angle; return its number and its node's."""
    node = NodeRigidBody2D(referenceCoordinates=place, initialVelocities=velocity, **node)
    number = int(mbs.AddNode(node))
    body = ObjectRigidBody2D(nodeNumber=number, mass=mass, inertia=inertia)
    return mbs.AddObject(body), number


def recorded(mbs, node, output):
    """Add a sensor in memory of what exu.OutputVariableType calls `output`."""
    kind = getattr(exu.OutputVariableType, output)
    return mbs.AddSensor(SensorNode(nodeNumber=node, storeInternal=True, outputVariableType=kind))
