"""Flexible bodies of Exudyn's own."""

from functools import cache

import exudyn.utilities as items
import numpy as np

from exudyn_examples.example import GRAVITY

__all__ = ["ancf_cable", "beam", "cantilever", "ffrf_pendulum"]

SIDE = 0.05  # of the square cross sections, m


def weight(mbs, body):
    marker = mbs.AddMarker(items.MarkerBodyMass(bodyNumber=body))
    mbs.AddLoad(items.LoadMassProportional(markerNumber=marker, loadVector=[0.0, -GRAVITY, 0.0]))


def hold(mbs, node, coordinates, **how):
    """Fix coordinates of a node to the ground, or hold them otherwise; the constraints' numbers."""
    still = mbs.AddMarker(
        items.MarkerNodeCoordinate(nodeNumber=mbs.AddNode(items.NodePointGround()), coordinate=0)
    )
    held = []
    for coordinate in coordinates:
        marker = mbs.AddMarker(items.MarkerNodeCoordinate(nodeNumber=node, coordinate=coordinate))
        constraint = items.ObjectConnectorCoordinate(markerNumbers=[still, marker], **how)
        held.append(mbs.AddObject(constraint))
    return held


def cables(mbs, modulus, bending=0.0, axial=0.0, elements=4):
    """ANCF elements along a metre of the x-axis, with damping times in s: nodes and bodies."""
    length = 1.0 / elements
    nodes = [
        mbs.AddNode(items.NodePoint2DSlope1(referenceCoordinates=[i * length, 0.0, 1.0, 0.0]))
        for i in range(elements + 1)
    ]
    bodies = [
        mbs.AddObject(
            items.ObjectANCFCable2D(
                nodeNumbers=nodes[i : i + 2],
                length=length,
                massPerLength=2.5,
                bendingStiffness=modulus * SIDE**4 / 12.0,
                axialStiffness=modulus * SIDE**2,
                bendingDamping=bending * modulus * SIDE**4 / 12.0,
                axialDamping=axial * modulus * SIDE**2,
            )
        )
        for i in range(elements)
    ]
    return nodes, bodies


def ancf_cable(mbs):
    """A soft cable of ANCF elements that hangs on a hinge and falls."""
    nodes, bodies = cables(mbs, 2.1e7, 0.02, 0.002)
    for body in bodies:
        weight(mbs, body)
    hold(mbs, nodes[0], (0, 1))


def cantilever(mbs):
    """A clamped beam of ANCF elements without damping that vibrates under a sudden tip load."""
    nodes, _ = cables(mbs, 2.1e8)
    hold(mbs, nodes[0], (0, 1, 3))
    tip = mbs.AddMarker(items.MarkerNodePosition(nodeNumber=nodes[-1]))
    mbs.AddLoad(items.LoadForceVector(markerNumber=tip, loadVector=[0.0, -20.0, 0.0]))


def beam(mbs, elements=4):
    """A clamped geometrically exact beam under a tip load that comes within 50 ms."""
    modulus, length = 2.1e9, 0.5 / elements
    nodes = [
        mbs.AddNode(items.NodeRigidBody2D(referenceCoordinates=[i * length, 0.0, 0.0]))
        for i in range(elements + 1)
    ]
    area = SIDE**2
    for i in range(elements):
        mbs.AddObject(
            items.ObjectBeamGeometricallyExact2D(
                nodeNumbers=nodes[i : i + 2],
                length=length,
                massPerLength=1000.0 * area,
                crossSectionInertia=1000.0 * SIDE**4 / 12.0,
                bendingStiffness=modulus * SIDE**4 / 12.0,
                axialStiffness=modulus * area,
                shearStiffness=modulus * area / 2.6,
                bendingDamping=2e-4 * modulus * SIDE**4 / 12.0,
                axialDamping=2e-4 * modulus * area,
                shearDamping=2e-4 * modulus * area / 2.6,
            )
        )
    hold(mbs, nodes[0], (0, 1, 2))
    tip = mbs.AddMarker(items.MarkerNodePosition(nodeNumber=nodes[-1]))

    def load(mbs, time, vector):
        return [0.0, -500.0 * (1.0 - np.cos(np.pi * min(time / 0.05, 1.0))), 0.0]

    mbs.AddLoad(
        items.LoadForceVector(
            markerNumber=tip, loadVector=[0.0, -500.0, 0.0], loadVectorUserFunction=load
        )
    )


@cache
def reduced_bar():
    """A bar of NGSolve's tetrahedra with its lowest free modes, and the nodes of its left end."""
    import ngsolve as ngs
    from exudyn.FEM import FEMinterface, ObjectFFRFreducedOrderInterface
    from netgen.occ import Box, OCCGeometry, Pnt

    box = Box(Pnt(0.0, -0.5 * SIDE, -0.5 * SIDE), Pnt(1.0, 0.5 * SIDE, 0.5 * SIDE))
    mesh = ngs.Mesh(OCCGeometry(box).GenerateMesh(maxh=0.05))
    fem = FEMinterface()
    fem.ImportMeshFromNGsolve(mesh, density=1000.0, youngsModulus=5e7, poissonsRatio=0.3)
    fem.ComputeEigenmodes(4, excludeRigidBodyModes=6, useSparseSolver=True)
    left = fem.GetNodesInPlane([0.0, 0.0, 0.0], [1.0, 0.0, 0.0])
    return ObjectFFRFreducedOrderInterface(fem), left


def ffrf_pendulum(mbs):
    """A soft bar in a floating frame of reference, hinged at its left end, that falls."""
    reduced, left = reduced_bar()
    body = reduced.AddObjectFFRFreducedOrder(
        mbs,
        positionRef=[0.0, 0.0, 0.0],
        gravity=[0.0, -GRAVITY, 0.0],
        stiffnessProportionalDamping=2e-3,
    )
    hinge = mbs.AddMarker(
        items.MarkerSuperElementRigid(
            bodyNumber=body["oFFRFreducedOrder"],
            meshNodeNumbers=np.array(left),
            weightingFactors=np.full(len(left), 1.0 / len(left)),
        )
    )
    still = mbs.AddMarker(items.MarkerBodyRigid(bodyNumber=mbs.CreateGround()))
    mbs.AddObject(
        items.ObjectJointGeneric(markerNumbers=[still, hinge], constrainedAxes=[1, 1, 1, 1, 1, 0])
    )
