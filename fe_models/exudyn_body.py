"""A reduced part as a body of an Exudyn system, with markers on its interfaces.

It is an ObjectFFRFreducedOrder; without modes an ObjectRigidBody of the same mass. A marker's cost
goes with its nodes. Three virtual nodes, which move with the mean motion of a bearing face, give
the same to 4e-11 as all nodes of the face at a twentieth of the cost; they follow the nodes of the
surface in the body's mesh.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import exudyn as exu
import numpy as np
from exudyn.graphics import FromPointsAndTrigs
from exudyn.itemInterface import (
    LoadMassProportional,
    MarkerBodyMass,
    MarkerBodyRigid,
    MarkerSuperElementPosition,
    MarkerSuperElementRigid,
    NodeGenericODE2,
    ObjectFFRFreducedOrder,
    ObjectRigidBody,
    VObjectFFRFreducedOrder,
    VObjectRigidBody,
)
from exudyn.rigidBodyUtilities import GetRigidBodyNode
from numpy.typing import ArrayLike, NDArray
from scipy.spatial.transform import Rotation

from fe_models.errors import InputError
from fe_models.reduced import ReducedPart

__all__ = ["FlexibleBody", "add_flexible_body"]

COLOUR = (0.45, 0.55, 0.65, 1.0)
VIRTUAL = 3


@dataclass(frozen=True)
class FlexibleBody:
    """The numbers of a body's items in its mbs, and where its interfaces are.

    node_modes is None for a rigid body (0 modes). `virtual_nodes` are mesh node numbers by face.
    """

    reduced: ReducedPart
    object_number: int
    node_rigid: int
    node_modes: int | None
    virtual_nodes: dict[str, list[int]]
    points: dict[str, int]
    point_positions: Mapping[str, Sequence[float]]

    @property
    def nodes(self) -> list[int]:
        """Numbers of its nodes: of the frame, and of the modes if there are any."""
        return [self.node_rigid, *([] if self.node_modes is None else [self.node_modes])]

    def add_point_marker(self, mbs: Any, *points: str) -> int:
        """Add a position marker on one of the body's `points`, or their mean.

        It has one mesh node each, so that it costs a sixth of `add_marker`, and no orientation.
        """
        if self.node_modes is None:
            mean = np.mean([self.point_positions[point] for point in points], axis=0)
            position = [float(value) for value in mean]
            marker: Any = MarkerBodyRigid(bodyNumber=self.object_number, localPosition=position)
        else:
            marker = MarkerSuperElementPosition(
                bodyNumber=self.object_number,
                meshNodeNumbers=[self.points[point] for point in points],
                weightingFactors=[1.0 / len(points)] * len(points),
            )
        return int(mbs.AddMarker(marker))

    def add_marker(self, mbs: Any, face: str, offset: Sequence[float] = (0.0, 0.0, 0.0)) -> int:
        """Add a rigid-body marker that follows the mean motion of an interface; return its number.

        Args:
            mbs: the body's system.
            face: name of the interface.
            offset: from the interface's centre, in the body frame, (3,), m.

        Raises:
            InputError: the part has no such interface.
        """
        interface = self.reduced.interface(face)
        if self.node_modes is None:
            point = np.asarray(interface.centre) + np.asarray(offset, dtype=float)
            marker: Any = MarkerBodyRigid(bodyNumber=self.object_number, localPosition=list(point))
        else:
            marker = MarkerSuperElementRigid(
                bodyNumber=self.object_number,
                meshNodeNumbers=self.virtual_nodes[face],
                weightingFactors=[1.0 / VIRTUAL] * VIRTUAL,
                offset=list(offset),
            )
        return int(mbs.AddMarker(marker))


def add_flexible_body(
    mbs: Any,
    reduced: ReducedPart,
    *,
    position: Sequence[float] = (0.0, 0.0, 0.0),
    rotation: ArrayLike | None = None,
    velocity: Sequence[float] = (0.0, 0.0, 0.0),
    angular_velocity: Sequence[float] = (0.0, 0.0, 0.0),
    gravity: Sequence[float] = (0.0, 0.0, 0.0),
    damping_ratio: float = 0.02,
    initial_modes: ArrayLike | None = None,
    initial_modes_t: ArrayLike | None = None,
    points: Mapping[str, tuple[str, Sequence[float]]] | None = None,
    name: str = "",
) -> FlexibleBody:
    """Add a reduced part to an Exudyn MainSystem.

    Args:
        mbs: exudyn.MainSystem, not yet assembled.
        reduced: from `reduced_part`; one with 0 modes becomes a rigid body.
        position: origin of the body frame, global, (3,), m.
        rotation: from the body to the global frame, (3, 3); by default the identity.
        velocity: of the body frame's origin, global components, (3,), m/s.
        angular_velocity: global components, (3,), rad/s.
        gravity: (3,), m/s^2; zero adds no load.
        damping_ratio: of critical, the same for every mode.
        initial_modes: (n,) modal coordinates at the start, sqrt(kg) m.
        initial_modes_t: (n,) their rates.
        points: name -> (face, position (3,) in the body frame, m): points that move with the mean
            motion of a face, for `add_point_marker`.
        name: of the object; its nodes become "<name> frame" and "<name> modes".

    Raises:
        InputError: a damping ratio outside 0 to 1, a face that the part does not have, or initial
            values of a wrong shape.
    """
    damping = reduced.damping_matrix(damping_ratio)
    start, start_t = _start(reduced, initial_modes), _start(reduced, initial_modes_t)
    node_item = GetRigidBodyNode(
        nodeType=exu.NodeType.RotationEulerParameters,
        position=list(position),
        velocity=list(velocity),
        rotationParameters=_euler_parameters(rotation),
        angularVelocity=list(angular_velocity),
    )
    node_item.name = f"{name} frame" if name else ""
    node = int(mbs.AddNode(node_item))
    if reduced.mode_count == 0:
        rigid = _add_rigid(mbs, reduced, node, name)
        positions = {point: position for point, (_, position) in (points or {}).items()}
        body = FlexibleBody(reduced, rigid, node, None, {}, {}, positions)
    else:
        modes_node = int(
            mbs.AddNode(
                NodeGenericODE2(
                    name=f"{name} modes" if name else "",
                    numberOfODE2Coordinates=reduced.mode_count,
                    referenceCoordinates=[0.0] * reduced.mode_count,
                    initialCoordinates=start,
                    initialCoordinates_t=start_t,
                )
            )
        )
        body = _add_flexible(mbs, reduced, (node, modes_node), damping, points or {}, name)
    if any(gravity):
        carrier = mbs.AddMarker(MarkerBodyMass(bodyNumber=body.object_number))
        mbs.AddLoad(LoadMassProportional(markerNumber=carrier, loadVector=list(gravity)))
    return body


def _euler_parameters(rotation: ArrayLike | None) -> list[float]:
    """Return Euler parameters; Exudyn's own are 1e-8 off within 1e-8 of half a turn.

    With Tait-Bryan angles, which Exudyn 1.13.6 takes, a free spinning body loses 4 % of its energy.
    """
    turned = Rotation.from_matrix(np.eye(3) if rotation is None else np.asarray(rotation))
    x, y, z, e = (float(value) for value in turned.as_quat())
    return [e, x, y, z]


def _add_rigid(mbs: Any, reduced: ReducedPart, node: int, name: str) -> int:
    """Add the part as a rigid body, its reference point the frame's origin."""
    j = reduced.inertia
    graphics = FromPointsAndTrigs(reduced.nodes, reduced.triangles, color=list(COLOUR))
    item = ObjectRigidBody(
        name=name,
        nodeNumber=node,
        mass=reduced.mass,
        inertia=[j[0, 0], j[1, 1], j[2, 2], j[1, 2], j[0, 2], j[0, 1]],
        centerOfMass=list(reduced.centre_of_mass),
        visualization=VObjectRigidBody(graphicsData=[graphics]),
    )
    return int(mbs.AddObject(item))


def _add_flexible(
    mbs: Any,
    reduced: ReducedPart,
    nodes: tuple[int, int],
    damping: NDArray[np.float64],
    points: Mapping[str, tuple[str, Sequence[float]]],
    name: str,
) -> FlexibleBody:
    """Add the part with its modes; mesh nodes: the surface, then three for each interface."""
    virtual = [interface.virtual_nodes() for interface in reduced.interfaces]
    virtual += [reduced.interface(face).moved_point(position) for face, position in points.values()]
    positions = np.vstack([reduced.nodes, *(points for points, _ in virtual)])
    modes = np.vstack([reduced.modes, *(modes for _, modes in virtual)])
    first = len(reduced.nodes)
    numbers = {
        interface.face: list(range(first + VIRTUAL * i, first + VIRTUAL * (i + 1)))
        for i, interface in enumerate(reduced.interfaces)
    }
    terms: dict[str, Any] = dict(reduced.couplings)
    if len(reduced.stress):
        padding = np.zeros((6 * (len(positions) - first), reduced.mode_count))
        # Exudyn wants one row per node and the six components of each mode side by side
        by_node = np.vstack([reduced.stress, padding]).reshape(-1, 6, reduced.mode_count)
        terms |= {
            "outputVariableModeBasis": by_node.transpose(0, 2, 1).reshape(len(by_node), -1),
            "outputVariableTypeModeBasis": exu.OutputVariableType.StressLocal,
        }
    item = ObjectFFRFreducedOrder(
        name=name,
        nodeNumbers=list(nodes),
        massMatrixReduced=_container(reduced.mass_matrix),
        stiffnessMatrixReduced=_container(reduced.stiffness_matrix),
        dampingMatrixReduced=_container(damping),
        modeBasis=modes,
        referencePositions=positions.ravel(),
        mass=reduced.mass,
        inertia=reduced.inertia,
        centerOfMass=list(reduced.centre_of_mass),
        computeFFRFterms=True,
        visualization=VObjectFFRFreducedOrder(
            triangleMesh=reduced.triangles, color=list(COLOUR), showNodes=False
        ),
        **terms,
    )
    alone = first + VIRTUAL * len(reduced.interfaces)
    numbered = {point: alone + i for i, point in enumerate(points)}
    point_positions = {point: position for point, (_, position) in points.items()}
    body = int(mbs.AddObject(item))
    return FlexibleBody(reduced, body, nodes[0], nodes[1], numbers, numbered, point_positions)


def _container(matrix: NDArray[np.float64]) -> Any:
    container = exu.MatrixContainer()
    container.SetWithDenseMatrix(matrix, useDenseMatrix=False)
    return container


def _start(reduced: ReducedPart, values: ArrayLike | None) -> list[float]:
    """Return initial modal values, zero by default."""
    start = np.zeros(reduced.mode_count) if values is None else np.asarray(values, dtype=float)
    if start.shape != (reduced.mode_count,):
        raise InputError(
            f"{reduced.name}: {start.shape} initial modal values for {reduced.mode_count}"
        )
    return [float(value) for value in start]
