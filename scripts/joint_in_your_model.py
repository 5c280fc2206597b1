"""A lubricated joint in an Exudyn model that knows nothing of the press: a pendulum in its bearing.

Run with: python scripts/joint_in_your_model.py
"""

import exudyn as exu
import numpy as np
from exudyn.itemInterface import (
    LoadMassProportional,
    MarkerBodyMass,
    NodeRigidBody2D,
    ObjectGround,
    ObjectRigidBody2D,
)

from exu_press import add_joint_sensor, add_lubricated_revolute
from exu_press.laws.film import finite

mbs = exu.SystemContainer().AddSystem()
ground = mbs.AddObject(ObjectGround())
node = mbs.AddNode(NodeRigidBody2D(referenceCoordinates=[0.5, 0.0, 0.0]))
pendulum = mbs.AddObject(ObjectRigidBody2D(nodeNumber=node, mass=10.0, inertia=10.0 / 12))
mass = mbs.AddMarker(MarkerBodyMass(bodyNumber=pendulum))
mbs.AddLoad(LoadMassProportional(markerNumber=mass, loadVector=[0.0, -9.81, 0.0]))

radius, length = 0.02, 0.03
joint = add_lubricated_revolute(
    mbs,
    journal=(pendulum, (-0.5, 0.0)),
    bearing=(ground, (0.0, 0.0)),
    radius=radius,
    clearance=5e-5,
    length=length,
    viscosity=0.1,
    law=finite(length / (2 * radius)),
)
sensor = add_joint_sensor(mbs, joint)
mbs.Assemble()
settings = exu.SimulationSettings()
settings.timeIntegration.endTime = 1.0
settings.timeIntegration.numberOfSteps = 2000
settings.timeIntegration.verboseMode = 0
settings.solution.file.write = False
settings.solution.sensors.writePeriod = 0.0
mbs.SolveDynamic(settings)

record = np.asarray(mbs.GetSensorStoredData(sensor))
print(f"least film thickness {record[:, -2].min() * 1e6:.1f} um")
print(f"largest force {np.hypot(record[:, 3], record[:, 4]).max():.0f} N")
