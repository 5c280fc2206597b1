"""Masses along lines, and matrices of them."""

import math

import exudyn as exu
import exudyn.utilities as items
import numpy as np

from exudyn_examples.example import GRAVITY
from exudyn_examples.other import data_variables, first_order, mass_1d

__all__ = ["control", "coordinates", "row", "stops"]


def row(by):
    """Masses in a row, on springs that harden, with friction, pushed."""
    before = by.still
    for _ in range(by.randint(1, 5)):
        mass = by.between(0.05, 5.0)
        _, here = mass_1d(by.mbs, mass, place=0.01, velocity=by.uniform(-1, 1))
        stiffness = mass * by.between(10.0, 1e6)
        damping = by.choice([0.0, 0.01, 0.5]) * math.sqrt(stiffness * mass)
        kind, cubic = by.choice(["linear", "hardening", "friction"]), by.between(1.0, 1e3)
        if kind == "hardening":

            def harden(q, v, k=stiffness, c=damping, cubic=cubic):
                return k * q * (1.0 + cubic * q * q) + c * v

            by.spring(here, harden, before=before)
        else:
            by.spring(here, before=before, stiffness=stiffness, damping=damping)
        if kind == "friction":
            force, slow = mass * GRAVITY * by.uniform(0.01, 0.3), by.between(1e-3, 0.1)
            by.spring(here, lambda q, v, force=force, slow=slow: force * math.tanh(v / slow))
        if by.often(0.4):
            by.push(here, by.load(mass * by.between(0.1, 30.0)))
        before = here


def coordinates(by):
    """Matrices of masses, springs and dampers."""
    count = by.randint(1, 8)
    mixed = np.array([[by.gauss(0.0, 1.0) for _ in range(count)] for _ in range(count)])
    stiffness = mixed @ mixed.T * by.between(10.0, 1e6) + np.eye(count)
    node = by.mbs.AddNode(
        items.NodeGenericODE2(
            numberOfODE2Coordinates=count,
            referenceCoordinates=[0.0] * count,
            initialCoordinates=[by.uniform(-0.1, 0.1) for _ in range(count)],
            initialCoordinates_t=[0.0] * count,
        )
    )
    force, sizes = by.load(1.0), np.array([by.between(0.1, 100.0) for _ in range(count)])
    by.mbs.AddObject(
        items.ObjectGenericODE2(
            nodeNumbers=[node],
            massMatrix=np.diag([by.between(0.1, 10.0) for _ in range(count)]),
            stiffnessMatrix=stiffness,
            dampingMatrix=by.choice([0.0, 1e-4, 1e-3]) * stiffness,
            forceUserFunction=lambda mbs, t, item, q, v: force(t) * sizes,
        )
    )


def stops(by):
    """Masses in a row with Exudyn's stops, bristles, friction and contacts, some pushed."""
    before = by.still
    for _ in range(by.randint(1, 3)):
        mass = by.between(0.1, 5.0)
        _, here = mass_1d(by.mbs, mass, velocity=by.uniform(-2, 2))
        stiffness = mass * by.between(10.0, 1e4)
        connector = {
            "markerNumbers": [before, here],
            "stiffness": stiffness,
            "damping": by.choice([0.0, 0.02]) * math.sqrt(stiffness * mass),
        }
        hard = 100.0 * stiffness
        kind, soft = by.choice(["stops", "bristle", "smooth", "contact"]), math.sqrt(hard * mass)
        slides = mass * by.between(0.1, 5.0)
        if kind == "stops":
            more = {
                "nodeNumber": data_variables(by.mbs, [0.0] * 3),
                "useLimitStops": True,
                "limitStopsUpper": 0.05,
                "limitStopsLower": -0.05,
                "limitStopsStiffness": hard,
                "limitStopsDamping": by.choice([0.0, 0.2]) * soft,
            }
        elif kind == "bristle":
            more = {
                "nodeNumber": data_variables(by.mbs, [0.0] * 3),
                "stickingStiffness": 10.0 * hard,
                "stickingDamping": 0.6 * soft,
                "dynamicFrictionForce": slides,
                "staticFrictionOffsetForce": mass * by.choice([0.0, 1.0]),
                "exponentialDecayStatic": 0.01,
            }
        else:
            more = {
                "dynamicFrictionForce": slides if kind == "smooth" else 0.0,
                "frictionProportionalZone": by.between(1e-3, 0.1),
            }
        by.mbs.AddObject(items.ObjectConnectorCoordinateSpringDamperExt(**connector, **more))
        if kind == "contact":
            by.mbs.AddObject(
                items.ObjectContactCoordinate(
                    markerNumbers=[before, here],
                    nodeNumber=data_variables(by.mbs, [0.0]),
                    contactStiffness=hard,
                    contactDamping=by.choice([0.0, 0.1]) * soft,
                    offset=by.choice([-0.02, -0.005]),
                )
            )
        if by.often(0.6):
            by.push(here, by.load(mass * by.between(0.3, 30.0)))
        before = here


def control(by):
    """Masses that first-order controllers with a lag move."""
    for _ in range(by.randint(1, 3)):
        mass, rate, lag = by.between(0.1, 5.0), by.between(3.0, 100.0), by.between(1e-3, 0.1)
        _, here = mass_1d(by.mbs, mass, place=0.1)
        node, aim = by.mbs.GetMarker(here)["nodeNumber"], by.load(0.1)
        controller = first_order(by.mbs, [0.0, 0.0])

        def read(mbs, number, kind=exu.OutputVariableType.Coordinates):
            return np.atleast_1d(mbs.GetNodeOutput(number, kind))

        def rates(mbs, t, item, state, node=node, lag=lag, aim=aim):
            error = aim(t) - read(mbs, node)[0]
            return [error, (error - state[1]) / lag]

        def force(mbs, t, load, node=node, controller=controller, mass=mass, rate=rate):
            whole, error = read(mbs, controller)
            speed = read(mbs, node, exu.OutputVariableType.Coordinates_t)[0]
            return mass * rate * (rate * (error + 0.3 * rate * whole) - 1.4 * speed)

        by.mbs.AddObject(items.ObjectGenericODE1(nodeNumbers=[controller], rhsUserFunction=rates))
        by.mbs.AddLoad(items.LoadCoordinate(markerNumber=here, load=0.0, loadUserFunction=force))
