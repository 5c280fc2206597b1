"""Rigid bodies in space."""

import math

import exudyn as exu
import exudyn.utilities as items
import numpy as np

from exudyn_examples.example import GRAVITY
from systems_by_chance.chance import SPATIAL

__all__ = ["chain", "hanging", "mounted", "rolling", "top", "tree"]


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


def mounted(by):
    """Bodies on mounts, hinges, and joints whose turn is prescribed, one on the other."""
    last, size = by.ground, by.size
    for number in range(by.randint(1, 3)):
        place = size * np.array([1.2 * number + 1.2, by.uniform(-0.3, 0.3), by.uniform(-0.3, 0.3)])
        body, mass = by.body(place, speed=by.vector(0.3), spin=by.vector(by.between(0.1, 2.0)))
        joint = {"itemNumbers": [last, body], "position": list(place - [0.5 * size, 0.0, 0.0])}
        kind = by.choice(["mount", "hinge", "driven"])
        if kind == "mount":
            stiffness = mass * by.between(100.0, 1e5)
            turning = stiffness * size**2 * by.between(0.01, 1.0)
            matrix = np.diag([stiffness] * 3 + [turning] * 3)
            fixed = last == by.ground
            by.mbs.CreateRigidBodySpringDamper(
                itemNumbers=[last, body],
                localPosition0=list(place) if fixed else [0.6 * size, 0.0, 0.0],
                localPosition1=[0.0 if fixed else -0.6 * size, 0.0, 0.0],
                stiffness=matrix,
                damping=by.choice([0.0, 0.02, 0.3]) / math.sqrt(by.between(100.0, 1e5)) * matrix,
                useGlobalFrame=False,
            )
        elif kind == "hinge":
            by.mbs.CreateRevoluteJoint(**joint, axis=by.choice(np.eye(3).tolist()))
        else:
            rate, far = by.between(1.0, 30.0), by.uniform(0.05, 0.5)
            turn = far, rate
            by.mbs.CreateGenericJoint(
                **joint,
                constrainedAxes=by.choice([[1] * 6, [1, 1, 1, 0, 0, 1]]),
                offsetUserFunction=lambda mbs, t, item, given, turn=turn: [
                    *[0.0] * 5,
                    turn[0] * (1.0 - math.cos(turn[1] * t)),
                ],
                offsetUserFunction_t=lambda mbs, t, item, given, turn=turn: [
                    *[0.0] * 5,
                    turn[0] * turn[1] * math.sin(turn[1] * t),
                ],
            )
        last = body


def about_the_origin(by, inertia, turned, place, spin):
    """A body that turns about the origin."""
    return by.mbs.CreateRigidBody(
        inertia=inertia,
        referencePosition=list(place),
        referenceRotationMatrix=turned,
        initialVelocity=list(np.cross(spin, place)),
        initialAngularVelocity=list(spin),
        gravity=[0.0, 0.0, -GRAVITY],
        nodeType=by.choice(SPATIAL),
    )


def rolling(by):
    """A disc that rolls, or slips on a stiff ground, upright or not, some of them pushed."""
    radius, speed, tilt = 0.5 * by.size, by.between(0.2, 5.0), by.uniform(-0.3, 0.3)
    inertia = items.InertiaCylinder(by.density, 0.1 * by.size, radius, 0)
    turned = items.RotationMatrixY(by.choice([0.0, tilt]))
    place = turned @ [0.0, 0.0, radius]
    spin = turned @ [-speed / radius, 0.0, by.uniform(-1, 1)]
    body = about_the_origin(by, inertia, turned, place, spin)
    disc = {"bodyNumbers": [by.ground, body], "axisPosition": [0.0] * 3, "discRadius": radius}
    if by.often():
        by.mbs.CreateRollingDisc(**disc)
    else:
        stiffness = inertia.mass * by.between(1e3, 1e5)
        by.mbs.CreateRollingDiscPenalty(
            **disc,
            contactStiffness=stiffness,
            contactDamping=by.choice([0.02, 0.2]) * math.sqrt(stiffness * inertia.mass),
            dryFriction=[by.uniform(0.1, 0.8)] * 2,
            dryFrictionProportionalZone=by.between(1e-3, 0.05),
        )
    if by.often(0.4):
        force = by.load(inertia.mass * by.between(0.1, 5.0))
        by.mbs.CreateForce(
            itemNumber=body,
            loadVector=[0.0] * 3,
            loadVectorUserFunction=lambda mbs, t, load: [0.0, force(t), 0.0],
        )


def top(by):
    """A heavy top."""
    inertia = items.InertiaCylinder(by.density, 0.1 * by.size, 0.5 * by.size, 2)
    turned = items.RotationMatrixX(by.uniform(0.05, 1.0))
    place, spin = turned @ [0, 0, by.size / 2], turned @ [0, 0, by.between(10.0, 500.0)]
    body = about_the_origin(by, inertia, turned, place, spin)
    by.mbs.CreateSphericalJoint(itemNumbers=[by.ground, body], position=[0.0] * 3)


def tree(by):
    """A robot of minimal coordinates: links that controllers hold or move, or that hang."""
    joints, links = exu.JointType, []
    for number in range(by.randint(1, 5)):
        sides = [by.size, 0.2 * by.size, 0.15 * by.size]
        inertia = items.InertiaCuboid(by.density, sides).Translated([0.5 * by.size, 0.0, 0.0])
        kind = by.choice([joints.RevoluteX, joints.RevoluteY, joints.RevoluteZ, joints.PrismaticX])
        stiffness = inertia.mass * GRAVITY * by.size * by.between(1.0, 1e3)
        held = kind == joints.PrismaticX or by.often()
        control = stiffness, stiffness * by.choice([0.02, 0.1, 0.5])
        start = [by.size if number else 0.0, 0.0, by.uniform(-0.2, 0.2) * by.size]
        links.append(
            items.TreeLink(
                linkInertia=inertia,
                jointType=kind,
                jointHT=items.HTtranslate(start),
                PDcontrol=control if held else (0.0, 0.0),
            )
        )
    number = by.mbs.CreateKinematicTree(
        listOfTreeLinks=links,
        initialCoordinates=[by.uniform(-0.5, 0.5) for _ in links],
        initialCoordinates_t=[by.uniform(-1, 1) for _ in links],
        gravity=[0.0, 0.0, -GRAVITY],
    )
    if by.often():
        rate = by.between(0.5, 10.0)

        def aim(mbs, time):
            for name, value in (
                ("jointPositionOffsetVector", 0.5 * math.sin(rate * time)),
                ("jointVelocityOffsetVector", 0.5 * rate * math.cos(rate * time)),
            ):
                mbs.SetObjectParameter(number, name, [value] * len(links))
            return True

        by.mbs.SetPreStepUserFunction(aim)
