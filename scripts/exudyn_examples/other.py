"""Friction, contact, first-order equations and user functions."""

import itertools

import exudyn as exu
import exudyn.utilities as items
import numpy as np
from exudyn.utilities import InertiaSphere

from exudyn_examples.example import GRAVITY
from exudyn_examples.planar import bar, pin

__all__ = ["bouncing_ball", "cradle", "hydraulics", "lugre", "maxwell", "stick_slip", "watch"]


def mass_1d(mbs, mass, place=0.0, velocity=0.0):
    """A mass that slides along a line, and markers of its coordinate and of the ground's."""
    node = mbs.AddNode(
        items.Node1D(
            referenceCoordinates=[0.0], initialCoordinates=[place], initialVelocities=[velocity]
        )
    )
    mbs.AddObject(items.ObjectMass1D(mass=mass, nodeNumber=node))
    still = mbs.AddNode(items.NodePointGround())
    return [
        mbs.AddMarker(items.MarkerNodeCoordinate(nodeNumber=number, coordinate=0))
        for number in (still, node)
    ]


def first_order(mbs, start):
    """A node of first-order coordinates."""
    return mbs.AddNode(
        items.NodeGenericODE1(
            referenceCoordinates=[0.0] * len(start),
            initialCoordinates=start,
            numberOfODE1Coordinates=len(start),
        )
    )


def data_variables(mbs, start):
    """A node of data variables, for a connector that has any."""
    return mbs.AddNode(
        items.NodeGenericData(initialCoordinates=start, numberOfDataCoordinates=len(start))
    )


def cylinder(mbs, markers, pressures, **values):
    """Exudyn's hydraulic actuator, whose pressures, Pa, are first-order coordinates."""
    return mbs.AddObject(
        items.ObjectConnectorHydraulicActuatorSimple(
            markerNumbers=markers,
            nodeNumbers=[first_order(mbs, pressures)],
            systemPressure=2e7,
            nominalFlow=2e-5,
            **values,
        )
    )


def open_valves(mbs, actuator, opening):
    """Open one valve of an actuator, and the other one the other way."""
    mbs.SetObjectParameter(actuator, "valveOpening0", opening)
    mbs.SetObjectParameter(actuator, "valveOpening1", -opening)
    return True


def arm_on_cylinder(mbs, ground, length, mass, carried=1.0, **oil):
    """A bar on a hinge, and a cylinder that carries a part of its weight: it, and its length."""
    body, half, _ = bar(mbs, (0.0, 0.0), (length, 0.0), mass)
    pin(mbs, ground, (0.0, 0.0), body, (-half, 0.0))
    low, along, area = 0.25 * length, 0.5 * half, 0.01
    markers = [
        mbs.AddMarker(items.MarkerBodyPosition(bodyNumber=number, localPosition=place))
        for number, place in ((ground, [0.0, -low, 0.0]), (body, [-along, 0.0, 0.0]))
    ]
    reach = np.hypot(low, along)
    pressure = mass * GRAVITY * half * reach / (low * along) / area
    actuator = cylinder(
        mbs,
        markers,
        [2e6 + carried * pressure, 2e6],
        offsetLength=reach,
        strokeLength=0.5 * reach,
        chamberCrossSection0=area,
        chamberCrossSection1=area,
        **oil,
    )
    return actuator, reach


def stick_slip(mbs):
    """A mass on a spring that comes to rest by Exudyn's bristle friction, a data variable."""
    markers = mass_1d(mbs, 2.0, velocity=3.0)
    mbs.AddObject(
        items.ObjectConnectorCoordinateSpringDamperExt(
            markerNumbers=markers,
            nodeNumber=data_variables(mbs, [1.0, 0.0, 0.0]),
            stiffness=100.0,
            dynamicFrictionForce=8.0,
            stickingStiffness=1e5,
            stickingDamping=100.0,
        )
    )


def maxwell(mbs):
    """A mass on two springs; one ends at a damper, in a point without mass."""
    ground, mass = mass_1d(mbs, 1.0, place=0.2)
    _, point = mass_1d(mbs, 0.0)
    for ends, stiffness, damping in (
        ((ground, mass), 50.0, 0.0),
        ((mass, point), 100.0, 0.0),
        ((point, ground), 0.0, 10.0),
    ):
        mbs.AddObject(
            items.ObjectConnectorCoordinateSpringDamper(
                markerNumbers=list(ends), stiffness=stiffness, damping=damping
            )
        )


def regularized(mbs):
    """A mass on a spring, dragged by a band with friction that falls with the speed: stick-slip."""
    markers = mass_1d(mbs, 0.5)
    band, friction, zone = 0.5, 10.0, 1e-2

    def force(mbs, time, item, u, v, k, d, offset, *rest):
        slip = v - band
        return k * u + friction * np.tanh(slip / zone) * (1.0 + np.exp(-abs(slip)))

    mbs.AddObject(
        items.ObjectConnectorCoordinateSpringDamper(
            markerNumbers=markers, stiffness=400.0, springForceUserFunction=force
        )
    )


def bouncing_ball(mbs):
    """A ball that falls on Exudyn's ObjectContactCoordinate and rebounds."""
    markers = mass_1d(mbs, 0.25, place=0.1)
    mbs.AddObject(
        items.ObjectContactCoordinate(
            markerNumbers=markers,
            nodeNumber=data_variables(mbs, [1.0]),
            contactStiffness=1e5,
            contactDamping=10.0,
            offset=0.05,
        )
    )
    mbs.AddLoad(items.LoadCoordinate(markerNumber=markers[1], load=-0.25 * GRAVITY))


def cradle(mbs, balls=3):
    """Newton's cradle: balls on threads, with Exudyn's contact of spheres between them."""
    radius, thread = 0.02, 0.25
    distance, mass = 2.04 * radius, 7800.0 * 4.0 / 3.0 * np.pi * radius**3
    ground, markers = mbs.CreateGround(), []
    for i in range(balls):
        aside = thread if i == balls - 1 else 0.0
        ball = mbs.CreateRigidBody(
            referencePosition=[i * distance + aside, aside, 0.0],
            inertia=InertiaSphere(mass, radius),
            gravity=[0.0, -GRAVITY, 0.0],
        )
        node = mbs.GetObject(ball)["nodeNumber"]
        markers.append(mbs.AddMarker(items.MarkerNodeRigid(nodeNumber=node)))
        mbs.CreateDistanceConstraint(
            itemNumbers=[ground, ball], localPosition0=[i * distance, thread, 0.0]
        )
    for pair in itertools.pairwise(markers):
        mbs.AddObject(
            items.ObjectContactSphereSphere(
                markerNumbers=list(pair),
                nodeNumber=data_variables(mbs, [0.1, 0.0, 0.0, 0.0]),
                spheresRadii=[radius, radius],
                contactStiffness=1e6,
                contactDamping=0.0,
                impactModel=2,
                restitutionCoefficient=0.95,
            )
        )


def lugre(mbs):
    """Canudas de Wit's mass with LuGre friction, drawn by a spring: three first-order equations."""
    stiffness, sigma_0, sigma_2 = 2.0, 1e3, 0.4
    sigma_1 = np.sqrt(sigma_0)

    def rates(mbs, time, item, q):
        x, v, z = q
        g = (1.0 + 0.5 * np.exp(-((v / 0.01) ** 2))) / sigma_0
        z_t = v - z * abs(v) / g
        return [v, stiffness * (0.1 * time - x) - sigma_0 * z - sigma_1 * z_t - sigma_2 * v, z_t]

    node = first_order(mbs, [0.0] * 3)
    mbs.AddObject(items.ObjectGenericODE1(nodeNumbers=[node], rhsUserFunction=rates))


def hydraulics(mbs):
    """A mass between ground and Exudyn's hydraulic actuator, whose pressures are first-order."""
    ground = mbs.CreateGround()
    mass = mbs.CreateMassPoint(referencePosition=[1.0, 0.0, 0.0], mass=100.0)
    markers = [mbs.AddMarker(items.MarkerBodyPosition(bodyNumber=body)) for body in (ground, mass)]
    actuator = cylinder(
        mbs,
        markers,
        [2e6, 2e6],
        offsetLength=0.5,
        strokeLength=1.0,
        chamberCrossSection0=0.02,
        chamberCrossSection1=0.015,
        hoseVolume0=0.01,
        hoseVolume1=0.01,
        oilBulkModulus=1.2e9,
        tankPressure=1e5,
        actuatorDamping=2e4,
    )
    for axis in (1, 2):
        mbs.CreateCoordinateConstraint(itemNumbers=[mass, None], coordinates=[axis, None])

    def valves(mbs, time):
        return open_valves(mbs, actuator, 1.0 if 0.02 < time < 0.2 else 0.0)

    mbs.SetPreStepUserFunction(valves)


def watch(mbs):
    """A balance wheel in milligrams and millimetres on a torsional spring, pushed by a torque."""
    ground = mbs.CreateGround()
    wheel = mbs.CreateRigidBody(
        inertia=exu.utilities.InertiaCylinder(density=8e3, length=1e-4, outerRadius=5e-3, axis=2),
        initialAngularVelocity=[0.0, 0.0, 20.0],
    )
    mbs.CreateRevoluteJoint(itemNumbers=[ground, wheel], position=[0, 0, 0], axis=[0, 0, 1])
    mbs.CreateTorsionalSpringDamper(
        itemNumbers=[ground, wheel], position=[0, 0, 0], axis=[0, 0, 1], stiffness=5e-7
    )
