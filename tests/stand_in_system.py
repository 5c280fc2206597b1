"""A system without an Exudyn system behind it, in a given state; and small ones of Exudyn."""

from types import SimpleNamespace

import exudyn as exu
import exudyn.utilities as items
import numpy as np

from exu_press import add_dry_revolute, add_lubricated_revolute
from exu_press.integrate.system import State, System
from exu_press.laws.contact import hertz, step_damping
from exu_press.laws.film import finite
from exu_press.laws.friction import no_friction

PLACE = exu.OutputVariableType.Coordinates
VELOCITY = exu.OutputVariableType.Coordinates_t


def system_at(nodes, velocities, accelerations=None, joints=None, length=1.0):
    """Return a system of nodes that are at zero, and at rest unless velocities are given."""
    zeros, none = np.zeros(len(velocities)), np.zeros(0)
    rates = np.array(velocities, dtype=float)
    second_rates = zeros if accelerations is None else np.array(accelerations, dtype=float)
    data = SimpleNamespace(
        GetODE2Coordinates=lambda *_: zeros,
        GetODE2Coordinates_t=lambda *_: rates,
        GetODE2Coordinates_tt=lambda *_: second_rates,
        GetAECoordinates=lambda *_: none,
        GetODE1Coordinates=lambda *_: none,
        GetDataCoordinates=lambda *_: none,
    )
    state = State(data, exu.ConfigurationType.Current)
    return System(
        mbs=None,
        data=data,
        current=state,
        start=state,
        reference=zeros,
        nodes=tuple(nodes),
        joints=joints,
        modes=False,
        modal_stiffness=False,
        contacts=(),
        rates_not_provided=False,
        length=length,
    )


def settings(end=1.0, steps=100, period=None, **changes):
    """Exudyn's settings of a run that writes no solution file.

    Args:
        end: s.
        steps: of the largest size.
        period: between what sensors record, s; 0 for every step, None for Exudyn's own.
        changes: of the time integration.
    """
    chosen = exu.SimulationSettings()
    integration = chosen.timeIntegration
    integration.endTime, integration.numberOfSteps = end, steps
    chosen.solution.file.write = False
    if period is not None:
        chosen.solution.sensors.writePeriod = period
    for name, value in changes.items():
        *path, last = name.split("__")
        owner = integration
        for attribute in path:
            owner = getattr(owner, attribute)
        setattr(owner, last, value)
    return chosen


def planar_body(mbs, mass, inertia, place=(0.0, 0.0, 0.0), velocity=(0.0, 0.0, 0.0), **node):
    """Add a body at x, y and angle; return its number and its node's."""
    node = items.NodeRigidBody2D(referenceCoordinates=place, initialVelocities=velocity, **node)
    number = int(mbs.AddNode(node))
    body = items.ObjectRigidBody2D(nodeNumber=number, mass=mass, inertia=inertia)
    return mbs.AddObject(body), number


def recorded(mbs, node, output):
    """Add a sensor in memory of what exu.OutputVariableType calls `output`."""
    kind = getattr(exu.OutputVariableType, output)
    return mbs.AddSensor(
        items.SensorNode(nodeNumber=node, storeInternal=True, outputVariableType=kind)
    )


def oscillator(
    *, stiffness=100.0, damping=0.0, start=1.0, speed=0.0, force=None, kind=PLACE, **sensor
):
    """Return a mass of 1 kg on a spring to the ground, its spring and a sensor of its own."""
    mbs = exu.SystemContainer().AddSystem()
    initial = {"initialCoordinates": [start], "initialVelocities": [speed]}
    node = mbs.AddNode(items.Node1D(referenceCoordinates=[0.0], **initial))
    mbs.AddObject(items.ObjectMass1D(nodeNumber=node, mass=1.0))
    ends = [
        mbs.AddMarker(items.MarkerNodeCoordinate(nodeNumber=number, coordinate=0))
        for number in (mbs.AddNode(items.NodePointGround()), node)
    ]
    options = {"markerNumbers": ends, "stiffness": stiffness, "damping": damping}
    if force is not None:
        options["springForceUserFunction"] = force
    spring = mbs.AddObject(items.ObjectConnectorCoordinateSpringDamper(**options))
    options = {"storeInternal": True, **sensor}
    sensor = mbs.AddSensor(items.SensorNode(nodeNumber=node, outputVariableType=kind, **options))
    mbs.Assemble()
    return mbs, spring, sensor


def mass_on_spring(frequency=20.0, position=1.0, force=None):
    """A kilogram on a spring (rad/s), displaced by 1 m; its system, with a sensor of its speed."""
    return oscillator(stiffness=frequency**2, start=position, force=force, kind=VELOCITY)[0]


def pendulum(bearing, torque=None, speed=0.0):
    """Ten kilograms that hang in a bearing with clearance, or in an ideal joint (None).

    Args:
        bearing: "dry", "lubricated" or None.
        torque: function of Exudyn's of the moment on the rod, N m.
        speed: of the rod at the start, rad/s.
    """
    mbs = exu.SystemContainer().AddSystem()
    ground = mbs.AddObject(items.ObjectGround())
    place, velocity = [0.0, -0.5, 0.0], [0.5 * speed, 0.0, speed]
    body, node = planar_body(mbs, 10.0, 10.0 / 12.0, place, velocity)
    mass = mbs.AddMarker(items.MarkerBodyMass(bodyNumber=body))
    mbs.AddLoad(items.LoadMassProportional(markerNumber=mass, loadVector=[0.0, -9.81, 0.0]))
    ends = (body, (0.0, 0.5)), (ground, (0.0, 0.0))
    size = {"radius": 0.02, "clearance": 5e-5}
    if bearing == "lubricated":
        add_lubricated_revolute(mbs, *ends, **size, length=0.03, viscosity=0.1, law=finite(0.75))
    elif bearing == "dry":
        contact = step_damping(hertz(2.5e10), 2.5e6, 1e-5)
        add_dry_revolute(mbs, *ends, **size, contact=contact, friction=no_friction())
    else:
        markers = [
            mbs.AddMarker(items.MarkerBodyRigid(bodyNumber=number, localPosition=[*point, 0.0]))
            for number, point in reversed(ends)
        ]
        mbs.AddObject(items.ObjectJointRevolute2D(markerNumbers=markers))
    if torque is not None:
        turned = mbs.AddMarker(items.MarkerNodeCoordinate(nodeNumber=node, coordinate=2))
        load = {"load": 0.0, "loadUserFunction": torque}
        mbs.AddLoad(items.LoadCoordinate(markerNumber=turned, **load))
    mbs.Assemble()
    return mbs
