"""Systems by chance, as users write them: scripts for `exudyn_models.py`, one a seed.

Run with: python scripts/random_systems.py FOLDER [--seeds 200]
then: python scripts/exudyn_models.py FOLDER OUT
"""

import argparse
import math
from itertools import pairwise
from pathlib import Path
from random import Random

import exudyn as exu
import exudyn.utilities as items
import numpy as np

from exudyn_examples.example import GRAVITY
from exudyn_examples.flexible import cables, hold, weight
from exudyn_examples.other import mass_1d
from exudyn_examples.planar import bar, pin

SPATIAL = exu.NodeType.RotationEulerParameters, exu.NodeType.RotationRxyz
SCRIPT = """import sys
sys.path.insert(0, {folder!r})
from random_systems import solve
solve({seed})  # by SolveDynamic
"""


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


def chain(by):
    """Bars in space on revolute, spherical and sliding joints, some on springs."""
    last, place, mbs = by.ground, np.zeros(3), by.mbs
    for _ in range(by.randint(1, 4)):
        turned = items.RotationMatrixZ(by.uniform(-1, 1)) @ items.RotationMatrixY(by.uniform(-1, 1))
        along = turned @ [by.size, 0.0, 0.0]
        body, mass = by.body(place + along / 2.0, turned)
        joint = {"itemNumbers": [body, last], "position": list(place), "useGlobalFrame": True}
        kind = by.choice(["revolute", "spherical", "sliding"])
        if kind == "revolute":
            mbs.CreateRevoluteJoint(**joint, axis=list(turned @ by.choice(np.eye(3).tolist())))
        elif kind == "spherical":
            mbs.CreateSphericalJoint(**joint)
        else:
            mbs.CreatePrismaticJoint(**joint, axis=list(along / by.size))
        if kind == "sliding" or by.often(0.3):
            stiffness = mass * by.between(1.0, 1e4)
            mbs.CreateCartesianSpringDamper(
                itemNumbers=[by.ground, body],
                localPosition0=list(place + 0.8 * along),
                localPosition1=[0.3 * by.size, 0.0, 0.0],
                stiffness=[stiffness] * 3,
                damping=[by.choice([0.0, 0.02, 0.5]) * math.sqrt(stiffness * mass)] * 3,
            )
        if by.often(0.4):
            force, way = by.load(mass * GRAVITY * by.between(0.1, 3.0)), by.vector()
            mbs.CreateForce(
                itemNumber=body,
                loadVector=[0.0] * 3,
                loadVectorUserFunction=lambda mbs, t, load, f=force, w=way: [f(t) * x for x in w],
            )
        last, place = body, place + along


def hanging(by):
    """Bodies that spin and fly on springs in space."""
    last, at = by.ground, [0.0] * 3
    for i in range(by.randint(1, 3)):
        place = by.size * np.array([1.0 + 1.5 * i, by.uniform(-1, 1), by.uniform(-1, 1)])
        body, mass = by.body(place, speed=by.vector(2.0), spin=by.vector(by.between(1.0, 60.0)))
        stiffness = mass * by.between(10.0, 1e5)
        by.mbs.CreateSpringDamper(
            itemNumbers=[last, body],
            localPosition0=at,
            localPosition1=[0.3 * by.size, 0.0, 0.0],
            stiffness=stiffness,
            damping=by.choice([0.0, 0.01, 0.3]) * math.sqrt(stiffness * mass),
        )
        last, at = body, [-0.3 * by.size, 0.0, 0.0]


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


def cable(by):
    """A cable of beams, clamped or hung, that falls."""
    damping = by.choice([0.0, 0.001, 0.01]), by.choice([0.0, 0.001])
    nodes, bodies = cables(by.mbs, by.between(1e5, 1e9), *damping, by.choice([2, 4, 8]))
    hold(by.mbs, nodes[0], by.choice([(0, 1), (0, 1, 3)]))
    for body in bodies:
        weight(by.mbs, body)


def top(by):
    """A heavy top."""
    inertia = items.InertiaCylinder(by.density, 0.1 * by.size, 0.5 * by.size, 2)
    turned = items.RotationMatrixX(by.uniform(0.05, 1.0))
    place, spin = turned @ [0, 0, by.size / 2], turned @ [0, 0, by.between(10.0, 500.0)]
    body = by.mbs.CreateRigidBody(
        inertia=inertia,
        referencePosition=list(place),
        referenceRotationMatrix=turned,
        initialVelocity=list(np.cross(spin, place)),
        initialAngularVelocity=list(spin),
        gravity=[0.0, 0.0, -GRAVITY],
        nodeType=by.choice(SPATIAL),
    )
    by.mbs.CreateSphericalJoint(itemNumbers=[by.ground, body], position=[0.0] * 3)


KINDS = chain, hanging, planar, loop, row, coordinates, cable, top


def solve(seed):
    """Build a system and solve it as its user does."""
    by = Chance(seed)
    KINDS[seed % len(KINDS)](by)
    by.mbs.Assemble()
    settings = exu.SimulationSettings()
    settings.timeIntegration.endTime = by.end
    settings.timeIntegration.numberOfSteps = by.choice([500, 1000, 2000])
    settings.timeIntegration.generalizedAlpha.spectralRadius = by.choice([0.5, 0.8, 0.9, 1.0])
    settings.timeIntegration.newton.useModifiedNewton = by.often()
    by.mbs.SolveDynamic(settings)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", type=Path)
    parser.add_argument("--seeds", type=int, default=200)
    options = parser.parse_args()
    folder = options.folder / "main" / "pythonDev" / "Examples"
    folder.mkdir(parents=True, exist_ok=True)
    here = str(Path(__file__).resolve().parent)
    for seed in range(options.seeds):
        kind = KINDS[seed % len(KINDS)].__name__
        script = folder / f"{kind}_{seed:03d}.py"
        script.write_text(SCRIPT.format(folder=here, seed=seed), encoding="utf-8")
    print(f"{options.seeds} scripts in {folder}")


if __name__ == "__main__":
    main()
