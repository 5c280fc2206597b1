"""Ends of joints on Exudyn's bodies: which coordinates they have, and where the point is."""

import math
from collections.abc import Sequence

import exudyn as exu
import numpy as np

from exu_press.errors import InputError
from exu_press.joints.ends import NODES, BodyEnd, FlexiblePoint
from exu_press.joints.planar import PlanarEnd
from exu_press.joints.user_force import user_force_of

__all__ = ["BodyPoint", "in_plane", "planar_end", "spatial_end"]

BodyPoint = tuple[int, Sequence[float]] | FlexiblePoint
"""Object number of a body and a point in its frame (m), or an interface of a flexible body."""


def in_plane(mbs: exu.MainSystem, point: BodyPoint) -> bool:
    """Return whether a point belongs to a planar body or, in the plane, to the ground."""
    if isinstance(point, FlexiblePoint):
        return False
    kind = mbs.GetObject(point[0])["objectType"]
    planar = kind in ("RigidBody2D", "Mass1D", "RotationalMass1D")
    return planar or (kind == "Ground" and (len(point[1]) < 3 or point[1][2] == 0))


def planar_end(mbs: exu.MainSystem, point: BodyPoint) -> PlanarEnd:
    """Return the end on a planar body or the ground.

    Raises:
        InputError: a body of one coordinate is tilted, or moves neither along x nor along y.
    """
    assert not isinstance(point, FlexiblePoint)
    body, centre = point
    item = mbs.GetObject(body)
    local = (float(centre[0]), float(centre[1]))
    user_force = user_force_of(mbs)
    still = user_force.index_of(None)
    indices = still, still + 1, still + 2
    if item["objectType"] == "Ground":
        x, y, _ = (float(value) for value in item["referencePosition"])
        return PlanarEnd(indices, (x, y, 0.0), local)
    node = int(item["nodeNumber"])
    first = user_force.index_of(node)
    start = [float(v) for v in mbs.GetNodeParameter(node, "referenceCoordinates")]
    if item["objectType"] == "RigidBody2D":
        x, y, angle = start
        return PlanarEnd((first, first + 1, first + 2), (x, y, angle), local)
    rotation = np.array(item["referenceRotation"])
    if rotation[2, 2] != 1.0:
        raise InputError(f"body {body} is tilted: allowed in the plane is its z along the global z")
    x, y, _ = (float(value) for value in item["referencePosition"])
    angle = math.atan2(rotation[1, 0], rotation[0, 0])
    if item["objectType"] == "RotationalMass1D":
        return PlanarEnd((indices[0], indices[1], first), (x, y, angle + start[0]), local)
    reference = x + start[0] * float(rotation[0, 0]), y + start[0] * float(rotation[1, 0]), angle
    if tuple(rotation[:2, 0]) == (1.0, 0.0):
        return PlanarEnd((first, indices[1], indices[2]), reference, local)
    if tuple(rotation[:2, 0]) == (0.0, 1.0):
        return PlanarEnd((indices[0], first, indices[2]), reference, local)
    raise InputError(f"body {body} moves at {math.degrees(angle):g} deg: allowed are 0 (x), 90 (y)")


def spatial_end(mbs: exu.MainSystem, point: BodyPoint) -> BodyEnd:
    """Return the end on a body of any kind."""
    flexible = point if isinstance(point, FlexiblePoint) else None
    body, centre = (
        (point.body, point.centre) if isinstance(point, FlexiblePoint) else (point[0], point[1])
    )
    item = mbs.GetObject(body)
    local = np.zeros(3)
    local[: len(centre)] = centre
    kind = item["objectType"]
    if kind == "Ground":
        local += item["referencePosition"]
        return BodyEnd("Ground", 0, np.zeros(0), local)
    if flexible is not None and kind == "FFRFreducedOrder":
        rigid, modal = (int(node) for node in item["nodeNumbers"])
    elif flexible is None and kind in ("RigidBody", "RigidBody2D"):
        rigid, modal = int(item["nodeNumber"]), None
    else:
        raise InputError(
            f"body {body} is a {kind}: allowed are RigidBody, RigidBody2D, Ground and, between "
            "bodies in the plane, Mass1D and RotationalMass1D with a point of theirs, and "
            "FFRFreducedOrder with a FlexiblePoint"
        )
    node_kind = mbs.GetNode(rigid)["nodeType"]
    if node_kind not in NODES:
        raise InputError(f"body {body} has a {node_kind} node: allowed are {', '.join(NODES)}")
    reference = np.array(mbs.GetNodeParameter(rigid, "referenceCoordinates"), dtype=float)
    index = user_force_of(mbs).index_of(rigid)
    if flexible is None or modal is None:
        return BodyEnd(node_kind, index, reference, local)
    modes = (user_force_of(mbs).index_of(modal), flexible.translation, flexible.rotation)
    return BodyEnd(node_kind, index, reference, local, modes)
