"""An assembled Exudyn system as the integration sees it, and what its errors are relative to.

`Problem` has nodes with masses, joints and constraints. `FoundScales` has the scales of errors,
given or found from the motion as it goes.
"""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import exudyn as exu
import numpy as np

from exu_press.errors import InputError
from exu_press.joints import user_force_of
from exu_press.joints.user_force import UserForceElement
from exu_press.numerics.arrays import Array

__all__ = [
    "FLEXIBLE",
    "MODES",
    "ErrorScales",
    "FoundScales",
    "Node",
    "Problem",
    "State",
    "modal_item",
    "weights",
]

FLEXIBLE = "FFRFreducedOrder"
"""Type of flexible bodies in floating frames, which have modes."""

MODES = "exu_press_modes"
"""Variable of a system that has the number of the item over their modes."""

MATERIAL_POINTS = {
    "Point": 3,
    "Point2D": 2,
    "PointSlope1": 3,
    "PointSlope2": 3,
    "PointSlope12": 3,
    "PointSlope23": 3,
    "Point2DSlope1": 2,
    "Point2DSlope12": 2,
    "RigidBody2D": 2,
    "RigidBodyEP": 3,
    "RigidBodyRxyz": 3,
}
"""Node types -> how many of their first coordinates are displacements, m."""

LIE_GROUP = "RigidBodyRotVecLG"

ALONG_CABLES = "JointSliding", "JointSliding2D"
"""Joints one of whose algebraic unknowns is a place along a cable, m."""

RIGID_OR_MODAL = (
    "Ground",
    "Mass1D",
    "RotationalMass1D",
    "MassPoint",
    "MassPoint2D",
    "RigidBody",
    "RigidBody2D",
    FLEXIBLE,
    "ConnectorDistance",
)
"""Objects whose stiffness and damping, if they have any, belong to modes and do not change.

Constraints have none, and most are joints by their names."""


@dataclass(frozen=True)
class Node:
    """Coordinates that count together in errors, and what they weigh.

    Attributes:
        name: in messages.
        start: index of the first of its coordinates among the system's.
        size: how many they are.
        mass: what turns their kinetic energy into the square of a speed, kg; None where they are
            not displacements: their own largest kinetic energy is the scale then. Infinite for what
            has no say.
        displacements: how many of its first coordinates are displacements.
        quaternion: whether its last four coordinates are Euler parameters.
        carrier: number of the node whose mass counts for it too, as a flexible body's frame does
            for its modes.
    """

    number: int
    name: str
    start: int
    size: int
    mass: float | None = None
    displacements: int = 0
    quaternion: bool = False
    carrier: int | None = None


class State:
    """All coordinates where Exudyn keeps them: what is written here, it goes on from.

    To ask for them costs as much as what is done with them, so that they are asked for once.

    Attributes:
        positions: second-order coordinates, over those of the reference.
        velocities: their rates.
        accelerations: the rates of these.
        multipliers: forces of the constraints.
        first_order: first-order coordinates.
        rates: of these.
    """

    def __init__(self, data: Any, where: exu.ConfigurationType) -> None:
        """Look at the state of a system's data, current or at the start of the step."""
        self.positions = data.GetODE2Coordinates(where, False)
        self.velocities = data.GetODE2Coordinates_t(where, False)
        self.accelerations = data.GetODE2Coordinates_tt(where, False)
        self.multipliers = data.GetAECoordinates(where, False)
        self.first_order = data.GetODE1Coordinates(where, False)
        self.rates = data.GetODE1Coordinates_t(where, False)


@dataclass(frozen=True)
class Problem:
    """The problem that is integrated.

    Attributes:
        mbs: the system.
        data: of the system, `mbs.systemData`.
        current: state at the end of the step that is tried.
        start: state at its start.
        reference: positions that those of a state are added to.
        kinds: types of the objects, in their order.
        nodes: of the second-order coordinates, in their order.
        joints: the system's clearance joints, if it has any.
        modes: whether flexible bodies vibrate at their own frequencies (`follow_modes`).
        modal_stiffness: whether all stiffness is that of flexible bodies' modes.
        switching: whether there are data variables or general contacts, which Exudyn iterates on
            after Newton's method.
        untold_rates: whether Exudyn does not tell how fast some constraints are violated: where
            user functions prescribe offsets, whose rates they give not at all or only nearly, or
            whole constraints, and at flexible bodies' rigid markers, whose velocities are no rates
            of their positions.
        length: largest displacement coordinate at the start, m; their last digits are rounded.
    """

    mbs: exu.MainSystem
    data: Any
    current: State
    start: State
    reference: Array
    kinds: tuple[str, ...]
    nodes: tuple[Node, ...]
    joints: UserForceElement | None
    modes: bool
    modal_stiffness: bool
    switching: bool
    untold_rates: bool
    length: float

    @classmethod
    def of(
        cls, mbs: exu.MainSystem, bodies: Mapping[int, tuple[str, float]] | None = None
    ) -> "Problem":
        """Look at an assembled system.

        Args:
            mbs: the system.
            bodies: node number -> name and mass (kg) of the body that it belongs to; nodes that are
                not named have no say in errors. None: all of them have one.

        Raises:
            InputError: the system is not assembled, or has nodes that cannot be stepped with a
                tolerance.
        """
        if not mbs.systemIsConsistent:
            raise InputError("mbs is not assembled: call mbs.Assemble() first")
        data: Any = mbs.systemData
        objects = [mbs.GetObject(number) for number in range(data.NumberOfObjects())]
        joints, modes = user_force_of(mbs), modal_item(mbs)
        kinds = [item["objectType"] for item in objects]
        others = (
            kind
            for number, kind in enumerate(kinds)
            if not kind.startswith("Joint")
            and kind not in RIGID_OR_MODAL
            and number not in (joints.item, modes)
        )
        modal = FLEXIBLE in kinds and all(
            kind.startswith("ConnectorCoordinate") and "Spring" not in kind for kind in others
        )
        _refuse_places(objects)
        nodes = _nodes(mbs, objects, bodies)
        reference = np.array(data.GetODE2Coordinates(exu.ConfigurationType.Reference))
        return cls(
            mbs=mbs,
            data=data,
            current=State(data, exu.ConfigurationType.Current),
            start=State(data, exu.ConfigurationType.StartOfStep),
            reference=reference,
            kinds=tuple(kinds),
            nodes=nodes,
            joints=joints if joints.joints else None,
            modes=modes is not None,
            modal_stiffness=modal,
            switching=data.DataSize() > 0 or mbs.NumberOfGeneralContacts() > 0,
            untold_rates=_untold_rates(mbs, objects),
            length=_length(data, reference, nodes),
        )

    @property
    def lubricated(self) -> bool:
        """Whether there is a film."""
        return self.joints is not None and self.joints.lubricated


def modal_item(mbs: exu.MainSystem) -> int | None:
    """Return the number of the item that `follow_modes` has added."""
    found: int | None = mbs.variables.get(MODES)
    return found


def _refuse_places(objects: list[dict[str, Any]]) -> None:
    """Refuse joints that slide along cables.

    One of their unknowns is a place, which no step change mends; and where it passes from one
    element to the next, steps shrank to nothing.
    """
    for number, item in enumerate(objects):
        kind = item["objectType"]
        if kind in ALONG_CABLES:
            raise InputError(
                f"object {number} ({item['name']}) is a {kind}: allowed with a tolerance are "
                "joints whose unknowns are forces, as JointALEMoving2D"
            )


def _untold_rates(mbs: exu.MainSystem, objects: list[dict[str, Any]]) -> bool:
    """Return whether Exudyn does not tell how fast some constraints are violated."""
    data: Any = mbs.systemData
    kinds = {mbs.GetMarker(number)["markerType"] for number in range(data.NumberOfMarkers())}
    return "SuperElementRigid" in kinds or any(
        item.get(name, 0) != 0
        for item in objects
        for name in ("constraintUserFunction", "offsetUserFunction")
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
    found = []
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
        displacements = MATERIAL_POINTS.get(kind, 0)
        if kind == "1D" and number in translating:
            displacements = 1
        if bodies is not None:
            frame = carriers.get(number, number)
            name, mass = bodies.get(frame, (name, math.inf))
        found.append(
            Node(
                number=number,
                name=name,
                start=int(coordinates[0]),
                size=len(coordinates),
                mass=mass,
                displacements=displacements,
                quaternion=kind == "RigidBodyEP",
                carrier=carriers.get(number),
            )
        )
    return tuple(sorted(found, key=lambda node: node.start))


def _length(data: Any, reference: Array, nodes: tuple[Node, ...]) -> float:
    """Return the largest displacement coordinate at the start, m."""
    # GetODE2CoordinatesTotal(Initial) crashes Exudyn 1.13.6 from about a hundred coordinates on
    places = np.abs(np.array(data.GetODE2Coordinates(exu.ConfigurationType.Initial)) + reference)
    largest = [places[n.start : n.start + n.displacements].max(initial=0.0) for n in nodes]
    return float(max(largest, default=0.0))


@dataclass(frozen=True)
class ErrorScales:
    """Scales of errors; None is found from the motion as it goes.

    Attributes:
        speed: of the bodies, m/s; found: the largest so far.
        force: Newton's method balances forces to a part of it, N; found: what accelerates all
            bodies together, at most so far.
        step: usual size of the longest steps, s; errors that films keep may add up to the tolerance
            within some of them. Found: the largest step.
    """

    speed: float | None = None
    force: float | None = None
    step: float | None = None


class FoundScales:
    """The scales of a run so far.

    A system at rest has no speed yet: what its first accelerations make of it within the largest
    step counts instead, or on their way through the widest clearance. In an equilibrium these are
    rounded forces over masses: what has moved no faster than rounded positions do in the first step
    is still.

    Attributes:
        speed: m/s.
        force: N.
        inertias: of the coordinates, kg where they are displacements.
        length: of the coordinates whose last digits are rounded, m.
        fixed: whether all is given.
        rest: speed up to which the system is still, m/s; 0.0 where that is not known.
        rounded: whether what moves no faster was found to be rounding.
        masses: of the nodes, kg, infinite for what has no say; where the system gives none, the
            node's largest kinetic energy over half the square of `speed`.
    """

    def __init__(
        self,
        given: ErrorScales,
        problem: Problem,
        longest: float,
        first: float = math.inf,
        stir: float = 0.0,
        floor: float = 0.0,
    ) -> None:
        """Take what is given; the rest is found from `begin` on.

        Args:
            given: scales.
            problem: what is solved.
            longest: step, s.
            first: step, s.
            stir: what rounded positions make of accelerations, times the step's square, over the
                length.
            floor: the least scale of speeds, m/s.
        """
        self._given, self._problem, self._longest = given, problem, longest
        self._first, self._stir = first, stir
        self.rest, self.rounded = 0.0, False
        self.length = problem.length
        self.masses: list[float] = []
        self._ends = [node.start + node.size for node in problem.nodes]
        self.inertias: list[float] = []
        self._own: list[bool] = []
        self._energies: list[float] = []  # twice the largest kinetic energy of each node so far
        self.speed = max(given.speed or 0.0, floor)
        self.force = given.force or 0.0
        self.fixed = False

    def begin(self, mass_matrix: Any) -> None:
        """Look at the state from which the run starts, and the mass matrix, (n, n)."""
        problem = self._problem
        self.inertias, masses = weights(problem.nodes, mass_matrix)
        self.masses = masses
        self._own = [mass == 0.0 for mass in masses]
        self._energies = [0.0 for _ in masses]
        positions = (problem.current.positions + problem.reference).tolist()
        known = max(self.length, self.norm(positions))
        self.length = known or 1.0  # where all is zero
        given = self._given.speed, self._given.force
        self.fixed = True not in self._own and None not in given
        if self.fixed:
            return
        velocities = problem.current.velocities.tolist()
        accelerations = problem.current.accelerations.tolist()
        largest, time = self.norm(accelerations), self._longest
        if problem.joints is not None and largest > 0.0:
            time = min(time, math.sqrt(4.0 * problem.joints.widest / largest))
        self.update([time * value for value in accelerations], accelerations)
        self.update(velocities, accelerations)
        if not known and self.speed > 0.0:  # as far as it gets in ten runs of a hundred steps
            self.length = min(1.0, 1e3 * self.speed * self._longest)
        if known and not any(self._own) and self._given.speed is None:
            self.rest = self._stir * known / self._first
            if self._given.force is None:
                weighed = math.hypot(*(mass for mass in masses if mass < math.inf))
                self.force = max(self.force, weighed * self._stir * known / self._longest**2)

    @property
    def resting(self) -> bool:
        """Whether the system moves by less than a billionth of its length in the longest step."""
        return self.speed * self._longest <= 1e-9 * self.length

    @property
    def unseen(self) -> bool:
        """Whether something has moved, but by no more than what rounding moves."""
        return self.rounded and 0.0 < self.speed <= self.rest

    def still(self, velocities: list[float]) -> bool:
        """Return whether nothing has moved yet, in a state either, but what rounding moves."""
        return self.speed <= self.rest and self.norm(velocities) <= self.rest

    def set_out(self, velocities: list[float], accelerations: list[float]) -> None:
        """Be told of a state that a step was tried to, in which a system may have left its rest."""
        self.update([self._longest * value for value in accelerations], accelerations)
        self.update(velocities, accelerations)

    def update(self, velocities: list[float], accelerations: list[float]) -> None:
        """Be told of a state."""
        if self.fixed:
            return
        energies, masses = self._sums(velocities, velocities), self.masses
        speed_2 = 0.0
        for i in range(len(masses)):
            if energies[i] > self._energies[i]:
                self._energies[i] = energies[i]
            if not self._own[i]:
                speed_2 = max(speed_2, energies[i] / masses[i])
        if self._given.speed is None:
            self.speed = max(self.speed, math.sqrt(speed_2))
            if self.speed == 0.0 and True in self._own:
                self.speed = 1.0  # nothing is displaced: any speed will do, energies count
        square = self.speed * self.speed
        for i in range(len(masses)):
            if self._own[i]:
                masses[i] = self._energies[i] / square if square > 0.0 else 0.0
        if self._given.force is None:
            squares = 0.0
            for i in range(len(accelerations)):
                force = self.inertias[i] * accelerations[i]
                squares += force * force
            self.force = max(self.force, math.sqrt(squares))

    def norm(self, vector: list[float]) -> float:
        """Return the largest kinetic norm of a body; what has no say may be no number."""
        largest = 0.0
        for square in self.squares(vector):
            if square > largest:
                largest = square
        return math.sqrt(largest)

    def squares(self, vector: list[float]) -> list[float]:
        """Return the squares of each body's kinetic norm of a vector over all coordinates."""
        squares, masses = self._sums(vector, vector), self.masses
        for i in range(len(squares)):
            mass = masses[i]
            squares[i] = squares[i] / mass if mass > 0.0 else 0.0
        return squares

    def along(self, vector: list[float], velocities: list[float]) -> float:
        """Return the largest part of a vector along a body's velocity, in the kinetic norm."""
        products, squares = self._sums(vector, velocities), self.squares(velocities)
        largest = 0.0
        for product, mass, square in zip(products, self.masses, squares, strict=True):
            if 0.0 < mass < math.inf and square > 0.0:
                largest = max(largest, abs(product) / (mass * math.sqrt(square)))
        return largest

    def _sums(self, one: list[float], other: list[float]) -> list[float]:
        """Return the sum of inertia times both vectors' values over each node's coordinates."""
        found: list[float] = []
        inertias = self.inertias
        i = 0
        for end in self._ends:
            total = 0.0
            while i < end:
                total += inertias[i] * one[i] * other[i]
                i += 1
            found.append(total)
        return found

    def alternating(self, rounding: float, alpha_f: float) -> float:
        """Return what rounded positions make of accelerations, times the step's square, m.

        Args:
            rounding: of positions, over the largest one, in each step.
            alpha_f: generalized-alpha's; its spectral radius is alpha_f / (1 - alpha_f).
        """
        radius = min(alpha_f / (1.0 - alpha_f), 0.95)
        return rounding * self.length / (1.0 - radius) ** 2


def weights(nodes: Sequence[Node], mass_matrix: Any) -> tuple[list[float], list[float]]:
    """Return each coordinate's inertia and each node's mass, 0.0 where that is to be found.

    Euler parameters count with the mean of their four inertias, which no rotation changes.

    Args:
        nodes: of the system, in the order of their coordinates.
        mass_matrix: (n, n).
    """
    inertias = np.array(np.diag(mass_matrix), dtype=float) if nodes else np.zeros(0)
    masses: dict[int, float] = {}
    for node in nodes:
        first, last = node.start, node.start + node.size
        if node.quaternion:
            inertias[last - 4 : last] = inertias[last - 4 : last].mean()
        mass = node.mass
        if mass is None:
            mass = float(inertias[first : first + node.displacements].max(initial=0.0))
            if not inertias[first:last].any():
                mass = math.inf
        masses[node.number] = mass
    for node in nodes:
        if node.mass is None and node.carrier is not None:
            masses[node.number] = masses[node.carrier]
    return inertias.tolist(), [masses[node.number] for node in nodes]
