"""A crank that spins in its bearings bulges as NGSolve's own solid does under centrifugal force."""

import exudyn as exu
import numpy as np
import pytest
import scipy.sparse as sp
from exudyn.itemInterface import (
    MarkerBodyRigid,
    MarkerNodeCoordinate,
    NodePointGround,
    ObjectConnectorCoordinate,
    ObjectJointGeneric,
    ObjectJointSpherical,
)
from independent.solid import displaced
from stand_in_system import settings

from exu_press.integrate import SolverStatus, solve_dynamic
from exu_press.mechanism import Body, Motion
from exu_press.model.rigid_body import PivotedBody
from fe_models import add_flexible_body

SPEED = 100.0  # rad/s
HELD = {"journal A": [0, 1, 2], "journal B": [0, 1], "flange": [5]}


def bulged(model):
    """Return the mean motion (6,) of the pin: (K - w^2 M) u = w^2 M x across the axis."""
    across = sp.kron(model.nodal_mass, sp.diags([1.0, 1.0, 0.0]), format="csr")
    rows = sp.vstack([model.faces[face].rows[numbers] for face, numbers in HELD.items()])
    matrix = model.stiffness - SPEED**2 * across
    force = SPEED**2 * (across @ model.nodes.ravel())
    return model.faces["pin"].rows @ displaced(matrix, rows, force)


def spun(part):
    """Return how the pin of the reduced crank has moved in the turning frame, (2,), m."""
    mbs = exu.SystemContainer().AddSystem()
    pin = part.interface("pin")
    faces = {
        face: (0.0, 0.0, float(part.interface(face).centre[2]))
        for face in ("journal A", "journal B")
    }
    faces["pin"] = tuple(pin.centre)
    body = add_flexible_body(
        mbs,
        part,
        angular_velocity=(0.0, 0.0, SPEED),
        damping_ratio=0.7,
        points={face: (face, place) for face, place in faces.items()},
    )
    ground = mbs.CreateGround()
    for face, axes in (("journal A", [1, 1, 1]), ("journal B", [1, 1, 0])):
        seat = mbs.AddMarker(MarkerBodyRigid(bodyNumber=ground, localPosition=list(faces[face])))
        ends = [body.add_point_marker(mbs, face), seat]
        mbs.AddObject(ObjectJointSpherical(markerNumbers=ends, constrainedAxes=axes))
    turning = Motion(np.zeros((1, 3)), np.array([[0.0, 0.0, SPEED]]), np.zeros((1, 3)))
    disc = PivotedBody(mbs, Body("drive", 1.0, 1.0), turning, (0.0, 0.0), (0.0, 0.0))
    mbs.AddObject(
        ObjectJointGeneric(
            markerNumbers=[
                mbs.AddMarker(MarkerBodyRigid(bodyNumber=disc.number)),
                body.add_marker(mbs, "flange"),
            ],
            constrainedAxes=[0, 0, 0, 0, 0, 1],
        )
    )
    still = mbs.AddMarker(
        MarkerNodeCoordinate(nodeNumber=mbs.AddNode(NodePointGround()), coordinate=0)
    )
    angle = mbs.AddMarker(MarkerNodeCoordinate(nodeNumber=disc.node, coordinate=0))
    mbs.AddObject(
        ObjectConnectorCoordinate(markerNumbers=[still, angle], velocityLevel=True, offset=SPEED)
    )
    marker = body.add_point_marker(mbs, "pin")
    mbs.Assemble()
    chosen = settings(0.03, 60, generalizedAlpha__spectralRadius=0.8)
    outcome = solve_dynamic(mbs, chosen, tolerance=1e-6)
    assert outcome.status is SolverStatus.COMPLETED, outcome.reason
    x, y, _ = mbs.GetMarkerOutput(marker, exu.OutputVariableType.Position)
    turn = float(mbs.GetNodeOutput(disc.node, exu.OutputVariableType.Coordinates))
    c, s = np.cos(turn), np.sin(turn)
    return np.array([c * x + s * y, c * y - s * x]) - pin.centre[:2]


def test_centrifugal_deflection_of_the_pin_is_that_of_the_solid(crank_model, reduced_crank):
    expected = bulged(crank_model)[:2]
    moved = spun(reduced_crank)
    assert moved == pytest.approx(expected, rel=1e-5, abs=2e-10)
