"""A lubricated joint in an Exudyn model that knows no press: a pendulum in its bearing."""

import exudyn as exu
import exudyn.utilities as items
import numpy as np

from exu_press import add_joint_sensor, add_lubricated_revolute, solve_dynamic
from exu_press.laws.film import finite

mbs = exu.SystemContainer().AddSystem()
ground = mbs.AddObject(items.ObjectGround())
node = mbs.AddNode(items.NodeRigidBody2D(referenceCoordinates=[0.5, 0.0, 0.0]))
pendulum = mbs.AddObject(items.ObjectRigidBody2D(nodeNumber=node, mass=10.0, inertia=10.0 / 12))
mass = mbs.AddMarker(items.MarkerBodyMass(bodyNumber=pendulum))
mbs.AddLoad(items.LoadMassProportional(markerNumber=mass, loadVector=[0.0, -9.81, 0.0]))
journal, bearing = (pendulum, (-0.5, 0.0)), (ground, (0.0, 0.0))  # bodies, points in their frames
film = {"length": 0.03, "viscosity": 0.1, "law": finite(0.03 / 0.04)}  # m, Pa s, L/D
joint = add_lubricated_revolute(mbs, journal, bearing, radius=0.02, clearance=5e-5, **film)
sensor = add_joint_sensor(mbs, joint)
mbs.Assemble()
settings = exu.SimulationSettings()
settings.timeIntegration.endTime, settings.solution.file.write = 1.0, False
settings.solution.sensors.writePeriod = 0.0  # every step
print(solve_dynamic(mbs, settings, tolerance=1e-4).status.value)
record = np.asarray(mbs.GetSensorStoredData(sensor))
force = np.hypot(record[:, 3], record[:, 4])
print(f"least film thickness {record[:, -2].min() * 1e6:.1f} um, largest force {force.max():.0f} N")
