"""Small systems of Exudyn's items, with settings."""

import exudyn as exu
import exudyn.utilities as items
import numpy as np

exu.config.suppressWarnings = True


def settings(end, steps, *, period=0.01):
    """Return settings of a run that writes no file."""
    settings = exu.SimulationSettings()
    settings.timeIntegration.endTime = end
    settings.timeIntegration.numberOfSteps = steps
    settings.solution.file.write = False
    settings.solution.sensors.writePeriod = period
    return settings


def coordinate_sensor(mbs, node, *, velocity=False, **options):
    """Add a sensor of a node's coordinates, or of their rates."""
    kind = exu.OutputVariableType.Coordinates_t if velocity else exu.OutputVariableType.Coordinates
    options = {"storeInternal": True, **options}
    return mbs.AddSensor(items.SensorNode(nodeNumber=node, outputVariableType=kind, **options))


def oscillator(*, stiffness=100.0, damping=0.0, start=1.0, force=None, **sensor):
    """Return a mass of 1 kg on a spring to the ground, its spring and its sensor."""
    mbs = exu.SystemContainer().AddSystem()
    node = mbs.AddNode(items.Node1D(referenceCoordinates=[0.0], initialCoordinates=[start]))
    mbs.AddObject(items.ObjectMass1D(nodeNumber=node, mass=1.0))
    ground = mbs.AddNode(items.NodePointGround())
    markers = [
        mbs.AddMarker(items.MarkerNodeCoordinate(nodeNumber=number, coordinate=0))
        for number in (ground, node)
    ]
    options = {} if force is None else {"springForceUserFunction": force}
    spring = mbs.AddObject(
        items.ObjectConnectorCoordinateSpringDamper(
            markerNumbers=markers, stiffness=stiffness, damping=damping, **options
        )
    )
    sensor = coordinate_sensor(mbs, node, **sensor)
    mbs.Assemble()
    return mbs, spring, sensor


def rotor():
    """Return an unbalanced disc on springs that turns at half its critical speed.

    Its angle grows to 1250 rad while its centre moves by millimetres.
    """
    mbs = exu.SystemContainer().AddSystem()
    eccentricity, mass, stiffness = 1e-2, 1.6, 4000.0
    critical = np.sqrt(stiffness / mass)
    node = mbs.AddNode(
        items.NodeRigidBody2D(
            referenceCoordinates=[0.0, eccentricity, 0.0],
            initialVelocities=[0.0, 0.0, 0.5 * critical],
        )
    )
    disc = mbs.AddObject(items.ObjectRigidBody2D(nodeNumber=node, mass=mass, inertia=0.4))
    ground, _centre = mbs.AddObject(items.ObjectGround()), [0.0, -eccentricity, 0.0]
    markers = [
        mbs.AddMarker(items.MarkerBodyPosition(bodyNumber=ground)),
        mbs.AddMarker(
            items.MarkerBodyPosition(bodyNumber=disc, localPosition=[0, -eccentricity, 0])
        ),
    ]
    mbs.AddObject(
        items.ObjectConnectorCartesianSpringDamper(
            markerNumbers=markers, stiffness=[stiffness] * 2 + [0.0], damping=[0.8] * 2 + [0.0]
        )
    )
    mbs.Assemble()
    return mbs, node


def double_pendulum(velocity=0.0):
    """Return two bars that start upside down, a chaotic motion."""
    mbs = exu.SystemContainer().AddSystem()
    ground = mbs.AddObject(items.ObjectGround())
    before, at = ground, [0.0, 0.0, 0.0]
    nodes = []
    for number in range(2):
        nodes.append(
            mbs.AddNode(
                items.NodeRigidBody2D(
                    referenceCoordinates=[0.05, 0.5 + number, 0.5 * np.pi + 0.1 * number],
                    initialVelocities=[0.0, 0.0, velocity],
                )
            )
        )
        body = mbs.AddObject(
            items.ObjectRigidBody2D(nodeNumber=nodes[-1], mass=1.0, inertia=1.0 / 12.0)
        )
        mass = mbs.AddMarker(items.MarkerBodyMass(bodyNumber=body))
        mbs.AddLoad(items.LoadMassProportional(markerNumber=mass, loadVector=[0.0, -9.81, 0.0]))
        markers = [
            mbs.AddMarker(items.MarkerBodyPosition(bodyNumber=one, localPosition=place))
            for one, place in ((before, at), (body, [-0.5, 0.0, 0.0]))
        ]
        mbs.AddObject(
            items.ObjectConnectorCartesianSpringDamper(
                markerNumbers=markers, stiffness=[1e4] * 2 + [0.0], damping=[1.0] * 2 + [0.0]
            )
        )
        before, at = body, [0.5, 0.0, 0.0]
    mbs.Assemble()
    return mbs
