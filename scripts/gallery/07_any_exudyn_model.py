"""A tolerance for any Exudyn model, instead of a step: a mass on a spring, and its true motion."""

import exudyn as exu
import exudyn.utilities as items
import numpy as np

from exu_press import solve_dynamic

MASS, STIFFNESS, START = 2.0, 5000.0, 0.01  # kg, N/m, m


def build():
    """Return the assembled system; its sensor 0 has the position."""
    mbs = exu.SystemContainer().AddSystem()
    ground = mbs.AddNode(items.NodePointGround())
    node = mbs.AddNode(items.Node1D(referenceCoordinates=[0.0], initialCoordinates=[START]))
    mbs.AddObject(items.ObjectMass1D(mass=MASS, nodeNumber=node))
    ends = [
        mbs.AddMarker(items.MarkerNodeCoordinate(nodeNumber=n, coordinate=0))
        for n in (ground, node)
    ]
    mbs.AddObject(items.CoordinateSpringDamper(markerNumbers=ends, stiffness=STIFFNESS))
    position = exu.OutputVariableType.Coordinates
    mbs.AddSensor(
        items.SensorNode(nodeNumber=node, storeInternal=True, outputVariableType=position)
    )
    mbs.Assemble()
    return mbs


settings = exu.SimulationSettings()
settings.timeIntegration.endTime, settings.solution.file.write = 1.0, False
outcome = solve_dynamic(build, settings, tolerance=1e-4)
record = np.asarray(outcome.mbs.GetSensorStoredData(0))
deviation = abs(record[-1, 1] - START * np.cos(np.sqrt(STIFFNESS / MASS) * record[-1, 0]))
bound = float(outcome.error.sensors[0][0])
print(f"{outcome.steps} steps, off by {deviation:.1e} m; stated is {bound:.1e} m")
