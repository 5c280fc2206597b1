"""A friction law of your own in an Exudyn model: a pendulum whose pin brakes it."""

import exudyn as exu
import exudyn.utilities as items
import numpy as np

from exu_press import add_dry_revolute, solve_dynamic
from exu_press.laws.contact import hertz, hunt_crossley


def arctangent(mu, softness):
    """Return a law: coefficient and its derivative from the sliding velocity, m/s."""
    return lambda velocity: (
        2.0 / np.pi * mu * np.arctan(velocity / softness),
        2.0 / np.pi * mu * softness / (softness**2 + velocity**2),
    )


def end_angle(mu):
    """Return the pendulum's angle after 0.6 s, rad."""
    mbs = exu.SystemContainer().AddSystem()
    ground = mbs.AddObject(items.ObjectGround())
    node = mbs.AddNode(items.NodeRigidBody2D(referenceCoordinates=[0.5, 0.0, 0.0]))
    rod = mbs.AddObject(items.ObjectRigidBody2D(nodeNumber=node, mass=10.0, inertia=10.0 / 12))
    mass = mbs.AddMarker(items.MarkerBodyMass(bodyNumber=rod))
    mbs.AddLoad(items.LoadMassProportional(markerNumber=mass, loadVector=[0.0, -9.81, 0.0]))
    laws = {"contact": hunt_crossley(hertz(1e10), 0.5), "friction": arctangent(mu, 1e-3)}
    ends = (rod, (-0.5, 0.0)), (ground, (0.0, 0.0))
    add_dry_revolute(mbs, *ends, radius=0.05, clearance=1e-4, **laws)
    mbs.Assemble()
    settings = exu.SimulationSettings()
    settings.timeIntegration.endTime, settings.solution.file.write = 0.6, False
    solve_dynamic(mbs, settings).check()
    return mbs.GetNodeOutput(node, exu.OutputVariableType.Coordinates)[2]


angles = {mu: end_angle(mu) for mu in (0.0, 0.1, 0.3)}
print(*(f"mu {mu}: {np.degrees(angle):.2f} deg" for mu, angle in angles.items()), sep="\n")
