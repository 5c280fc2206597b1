"""An assembled Exudyn system as the integration sees it: nodes, states, clearance joints."""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import exudyn as exu
import numpy as np

from exu_press.errors import InputError
from exu_press.joints.user_force import UserForceElement, user_force_of
from exu_press.numerics.arrays import Array
from exu_press.numerics.floats import FloatBuffer

__all__ = ["FLEXIBLE", "MODES", "Node", "State", "System", "modal_item"]

FLEXIBLE = "FFRFreducedOrder"
"""Type of flexible bodies in floating frames, which have modes."""

MODES = "exu_press_modes"
"""Variable of a system that has the number of the item over their modes."""

SPATIAL_BODIES = "RigidBodyEP", "RigidBodyRxyz"
"""Node types whose other coordinates turn a body in space."""

LIE_GROUP = "RigidBodyRotVecLG"

COUNTS_TURNS = "ConnectorTorsionalSpringDamper"
"""Connector whose data variable is its angle beyond a turn, which jumps nowhere."""

RIGID_BODIES = "Ground Mass1D RotationalMass1D MassPoint MassPoint2D RigidBody RigidBody2D"
RIGID_OR_MODAL = *RIGID_BODIES.split(), FLEXIBLE, "ConnectorDistance"
"""Objects whose stiffness and damping, if they have any, belong to modes and do not change.

Constraints have none, and most are joints by their names."""


@dataclass(frozen=True)
class Node:
    """Coordinates that count together in errors, and what they weigh.

    Attributes:
        number: of the node in Exudyn; its name is for messages.
        start: index of the first of its coordinates among the system's; size is their number.
        mass: ratio of kinetic energy to the square of a speed, kg; None is read from the mass
            matrix, infinite is excluded from the norm.
        displacements: number of its first coordinates that are displacements.
        rotations: number of its last coordinates that turn a body in space: four Euler parameters
            or three angles.
        carrier: number of the node whose mass counts for it too, as a flexible body's frame does
            for its modes.
    """

    number: int
    name: str
    start: int
    size: int
    mass: float | None = None
    displacements: int = 0
    rotations: int = 0
    carrier: int | None = None


class State:
    """All coordinates where Exudyn keeps them: what is written here, it goes on from.

    To ask for them costs as much as what is done with them, so that they are asked for once.

    Attributes:
        positions: second-order coordinates, over those of the reference, and their rates.
        multipliers: forces of the constraints.
        first_order: first-order coordinates.
        data: what contacts and friction of Exudyn's remember.
    """

    def __init__(self, data: Any, where: exu.ConfigurationType) -> None:
        """Look at the state of a system's data, current or at the start of the step."""
        self.positions = data.GetODE2Coordinates(where, False)
        self.velocities = data.GetODE2Coordinates_t(where, False)
        self.accelerations = data.GetODE2Coordinates_tt(where, False)
        self.multipliers = data.GetAECoordinates(where, False)
        self.first_order = data.GetODE1Coordinates(where, False)
        self.data = data.GetDataCoordinates(where, False)

    def motion(self) -> list[FloatBuffer]:
        """Return its positions, velocities and accelerations as lists of floats."""
        return [FloatBuffer(v) for v in (self.positions, self.velocities, self.accelerations)]


@dataclass(frozen=True)
class System:
    """The system that is integrated.

    Attributes:
        mbs: Exudyn's system.
        data: of the system, `mbs.systemData`.
        current: state at the end of the step that is tried; start is that at its beginning.
        reference: positions that those of a state are added to.
        nodes: of the second-order coordinates, in their order.
        joints: the system's clearance joints, if it has any.
        modes: whether flexible bodies vibrate at their own frequencies (`follow_modes`).
        modal_stiffness: whether all stiffness is that of flexible bodies' modes.
        contacts: names of Exudyn's own contacts and friction, which have data variables: Exudyn
            iterates on these after Newton's method.
        rates_not_provided: whether Exudyn does not provide the rates of some constraints: where
            user functions prescribe offsets or whole constraints, where coordinates are squared
            (Exudyn squares their velocities), and at rigid markers of flexible bodies.
        length: largest displacement coordinate at the start, m; their last digits are rounded.
    """

    mbs: exu.MainSystem
    data: Any
    current: State
    start: State
    reference: Array
    nodes: tuple[Node, ...]
    joints: UserForceElement | None
    modes: bool
    modal_stiffness: bool
    contacts: tuple[str, ...]
    rates_not_provided: bool
    length: float

    @classmethod
    def of_mbs(
        cls, mbs: exu.MainSystem, bodies: Mapping[int, tuple[str, float]] | None = None
    ) -> "System":
        """Look at an assembled system; bodies are those of `solve_dynamic`.

        Raises:
            InputError: the system is not assembled, or has nodes whose coordinates do not add up.
        """
        if not mbs.systemIsConsistent:
            raise InputError("mbs is not assembled: call mbs.Assemble() first")
        data: Any = mbs.systemData
        objects = [mbs.GetObject(number) for number in range(data.NumberOfObjects())]
        joints, modes = user_force_of(mbs), modal_item(mbs)
        kinds = [item["objectType"] for item in objects]
        elastic = (
            kind
            for number, kind in enumerate(kinds)
            if not kind.startswith("Joint")
            and kind not in RIGID_OR_MODAL
            and number not in (joints.item, modes)
        )
        modal = FLEXIBLE in kinds and all(
            kind.startswith("ConnectorCoordinate") and "Spring" not in kind for kind in elastic
        )
        contacts = [
            f"{item['name']} ({item['objectType']})"
            for number, item in enumerate(objects)
            if item["objectType"] != COUNTS_TURNS and len(data.GetObjectLTGData(number))
        ]
        if mbs.NumberOfGeneralContacts() > 0:
            contacts.append("general contacts")
        markers = (mbs.GetMarker(number) for number in range(data.NumberOfMarkers()))
        rigid_markers = any(marker["markerType"] == "SuperElementRigid" for marker in markers)
        nodes = _nodes(mbs, objects, bodies)
        reference = np.array(data.GetODE2Coordinates(exu.ConfigurationType.Reference))
        return cls(
            mbs=mbs,
            data=data,
            current=State(data, exu.ConfigurationType.Current),
            start=State(data, exu.ConfigurationType.StartOfStep),
            reference=reference,
            nodes=nodes,
            joints=joints if joints.joints else None,
            modes=modes is not None,
            modal_stiffness=modal,
            contacts=tuple(contacts),
            rates_not_provided=rigid_markers or any(map(_lacks_rate, objects)),
            length=_length(data, reference, nodes),
        )

    @property
    def equations(self) -> int:
        """Number of equations that a step solves."""
        now = self.current
        return len(now.positions) + len(now.first_order) + len(now.multipliers)

    @property
    def has_film(self) -> bool:
        """Whether there is a film."""
        return self.joints is not None and self.joints.has_film


def modal_item(mbs: exu.MainSystem) -> int | None:
    """Return the number of the item that `follow_modes` has added."""
    number: int | None = mbs.variables.get(MODES)
    return number


def _lacks_rate(item: dict[str, Any]) -> bool:
    """Return whether Exudyn does not provide the rate of an object's constraint."""
    functions = "constraintUserFunction", "offsetUserFunction"
    squares = "quadraticTermMarker0", "quadraticTermMarker1"
    return any(item.get(name, 0) != 0 for name in functions) or any(
        name in item and np.any(item[name]) for name in squares
    )


def _nodes(
    mbs: exu.MainSystem,
    objects: list[dict[str, Any]],
    bodies: Mapping[int, tuple[str, float]] | None,
) -> tuple[Node, ...]:
    """Return the nodes with second-order coordinates, in the order of these."""
    data: Any = mbs.systemData
    translating = {int(item["nodeNumber"]) for item in objects if item["objectType"] == "Mass1D"}
    carriers = {
        int(item["nodeNumbers"][1]): int(item["nodeNumbers"][0])
        for item in objects
        if item["objectType"] == FLEXIBLE and len(item["nodeNumbers"]) > 1
    }
    nodes = []
    for number in range(data.NumberOfNodes()):
        coordinates = data.GetNodeLTGODE2(number)
        if len(coordinates) == 0:
            continue
        item = mbs.GetNode(number)
        kind = item["nodeType"]
        if kind == LIE_GROUP:
            raise InputError(
                f"node {number} ({item['name']}) is a {kind}: allowed with a tolerance are nodes "
                "whose coordinates add up, as NodeRigidBodyEP or NodeRigidBodyRxyz"
            )
        name, mass = item["name"] or f"node {number}", None
        displacements = int(kind == "1D" and number in translating)
        if kind.startswith(("Point", "RigidBody")):
            displacements = 2 if "2D" in kind else 3
        if bodies is not None:
            frame = carriers.get(number, number)
            name, mass = bodies.get(frame, (name, math.inf))
        nodes.append(
            Node(
                number=number,
                name=name,
                start=int(coordinates[0]),
                size=len(coordinates),
                mass=mass,
                displacements=displacements,
                rotations=len(coordinates) - displacements if kind in SPATIAL_BODIES else 0,
                carrier=carriers.get(number),
            )
        )
    return tuple(sorted(nodes, key=lambda node: node.start))


def _length(data: Any, reference: Array, nodes: tuple[Node, ...]) -> float:
    """Return the largest displacement coordinate at the start, m."""
    # GetODE2CoordinatesTotal(Initial) crashes Exudyn 1.13.6 from about a hundred coordinates on
    positions = np.abs(np.array(data.GetODE2Coordinates(exu.ConfigurationType.Initial)) + reference)
    largest = [positions[n.start : n.start + n.displacements].max(initial=0.0) for n in nodes]
    return float(max(largest, default=0.0))
