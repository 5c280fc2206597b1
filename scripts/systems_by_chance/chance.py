"""Numbers by chance, and what all systems have."""

import math
from random import Random

import exudyn as exu
import exudyn.utilities as items
import numpy as np

from exudyn_examples.example import GRAVITY

__all__ = ["SPATIAL", "Chance"]

SPATIAL = exu.NodeType.RotationEulerParameters, exu.NodeType.RotationRxyz


class Chance(Random):
    """Numbers by chance, and what all systems have."""

    def __init__(self, seed):
        super().__init__(seed)
        self.mbs = exu.SystemContainer().AddSystem()
        self.ground = self.mbs.CreateGround()
        self.end = self.choice([0.5, 1.0, 2.0])
        self.size = self.between(0.03, 2.0)
        self.density = self.between(500.0, 8000.0)
        self.still = self.coordinate(self.mbs.AddNode(items.NodePointGround()), 0)

    def between(self, low, high):
        """Any order of magnitude is as likely as another."""
        return math.exp(self.uniform(math.log(low), math.log(high)))

    def often(self, part=0.5):
        return self.random() < part

    def vector(self, size=1.0):
        return [size * self.uniform(-1.0, 1.0) for _ in range(3)]

    def load(self, size):
        """A function of time: a sine, a step, a ramp."""
        w, start = self.between(3.0, 100.0), self.uniform(0.0, self.end)
        shapes = (
            lambda t: math.sin(w * t),
            lambda t: float(t > start),
            lambda t: min(1.0, t / self.end),
        )
        shape = self.choice(shapes)
        return lambda t: size * shape(t)

    def coordinate(self, node, number):
        return self.mbs.AddMarker(items.MarkerNodeCoordinate(nodeNumber=node, coordinate=number))

    def body(self, place, turned=None, speed=(0.0,) * 3, spin=(0.0,) * 3):
        """A bar along its x-axis, its number and its mass."""
        sides = [self.size, self.size * self.uniform(0.05, 0.3), self.size * 0.1]
        inertia = items.InertiaCuboid(density=self.density, sideLengths=sides)
        body = self.mbs.CreateRigidBody(
            inertia=inertia,
            referencePosition=list(place),
            referenceRotationMatrix=np.eye(3) if turned is None else turned,
            initialVelocity=list(speed),
            initialAngularVelocity=list(spin),
            gravity=[0.0, -GRAVITY, 0.0],
            nodeType=self.choice(SPATIAL),
        )
        return body, inertia.mass

    def spring(self, here, force=None, before=None, **values):
        """Between coordinates, the first one of the ground's unless given."""
        if force is not None:
            values["springForceUserFunction"] = lambda mbs, t, item, q, v, *given: force(q, v)
        ends = [self.still if before is None else before, here]
        self.mbs.AddObject(
            items.ObjectConnectorCoordinateSpringDamper(markerNumbers=ends, **values)
        )

    def push(self, here, force):
        self.mbs.AddLoad(
            items.LoadCoordinate(
                markerNumber=here, load=0.0, loadUserFunction=lambda mbs, t, load: force(t)
            )
        )
