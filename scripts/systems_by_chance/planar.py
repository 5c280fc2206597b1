"""Mechanisms in the plane."""

import math
from itertools import pairwise

import exudyn as exu
import exudyn.utilities as items
import numpy as np

from exudyn_examples.example import GRAVITY
from exudyn_examples.other import arm_on_cylinder, open_valves
from exudyn_examples.planar import bar, pin

__all__ = ["actuator", "loop", "planar"]


def planar(by):
    """Pendulums of bars with friction, stops and loads."""
    place, last, at = np.zeros(2), by.ground, (0.0, 0.0)
    for _ in range(by.randint(1, 4)):
        angle, mass = by.uniform(-3, 3), by.density * by.size**3 * 0.01
        end = place + by.size * np.array([math.cos(angle), math.sin(angle)])
        body, half, node = bar(by.mbs, place, end, mass)
        pin(by.mbs, last, at, body, (-half, 0.0))
        turn, torque = by.coordinate(node, 2), mass * GRAVITY * by.size * by.between(0.01, 10.0)
        kind, slow = by.choice(["free", "friction", "stop", "spring", "load"]), by.between(0.01, 1)
        if kind == "friction":
            by.spring(turn, lambda q, v, torque=torque, slow=slow: torque * math.tanh(v / slow))
        elif kind == "stop":

            def stop(q, v, torque=torque):
                return 100.0 * torque * (q - 0.5 + 0.01 * v) if q > 0.5 else 0.0

            by.spring(turn, stop)
        elif kind == "spring":
            by.spring(turn, stiffness=torque, damping=0.02 * torque)
        elif kind == "load":
            by.push(turn, by.load(torque))
        last, at, place = body, (half, 0.0), end


def loop(by):
    """A four-bar, pushed or driven."""
    mbs, size, angle = by.mbs, by.size, by.uniform(0.2, 2.8)
    crank, rest = 0.3 * size * np.array([math.cos(angle), math.sin(angle)]), np.array([size, 0.0])
    along = (rest - crank) / np.linalg.norm(rest - crank)
    joint = (crank + rest) / 2.0 + by.uniform(0.4, 0.9) * size * np.array([-along[1], along[0]])
    last, at = by.ground, (0.0, 0.0)
    mass, nodes = by.density * size**3 * 0.01, []
    for start, end in pairwise([np.zeros(2), crank, joint, rest]):
        body, half, node = bar(mbs, start, end, mass)
        pin(mbs, last, at, body, (-half, 0.0))
        last, at = body, (half, 0.0)
        nodes.append(node)
    pin(mbs, last, at, by.ground, (size, 0.0))
    turn, rate = by.coordinate(nodes[0], 2), by.between(3.0, 30.0)
    if by.often():
        by.push(turn, by.load(mass * GRAVITY * size * by.between(0.3, 10.0)))
        return
    mbs.AddObject(
        items.ObjectConnectorCoordinate(
            markerNumbers=[by.still, turn],
            offsetUserFunction=lambda mbs, t, item, given: rate * t * t / (t + 0.1),
        )
    )


def actuator(by):
    """An arm on a hydraulic cylinder, which holds it, lets it sink, or moves it."""
    cylinder, reach = arm_on_cylinder(
        by.mbs,
        by.ground,
        by.size + 0.5,
        by.between(10.0, 500.0),
        carried=by.choice([1.0, 0.5]),
        hoseVolume0=by.between(1e-3, 1.0),
        hoseVolume1=by.between(1e-3, 1.0),
        oilBulkModulus=by.between(1e8, 1e10),
        actuatorDamping=by.between(1e3, 2e5),
    )
    if by.often(0.7):
        rate = by.between(1.0, 10.0)

        def valves(mbs, time):
            now = mbs.GetObjectOutput(cylinder, exu.OutputVariableType.Distance)
            far = reach * (1.0 + 0.02 * math.sin(rate * time)) - now
            return open_valves(mbs, cylinder, 2.0 * far)

        by.mbs.SetPreStepUserFunction(valves)
