"""The one place where laws become an Exudyn item: a massless object over the bodies' own nodes.

Exudyn differentiates connectors numerically, so that a Python law is called a dozen times for each
Jacobian. An ObjectGenericODE2 without mass, laid over the nodes of the joined bodies, takes forces
and an analytic Jacobian instead. All clearance joints of a system share one such item, since each
item costs a call of its own.
"""

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from typing import Any

import exudyn as exu
import numpy as np
from exudyn.itemInterface import ObjectGenericODE2, VObjectGenericODE2
from numpy.typing import NDArray

from exu_press.errors import InputError, error_prefix
from exu_press.joints.joint import GROUND, SHALLOW, ClearanceJoint, JointState

__all__ = ["StepWatch", "UserForceElement", "add_massless_item", "holds_joints", "user_force_of"]

REGISTRY = "exu_press_joints"

START = exu.ConfigurationType.StartOfStep

Block = list[float] | NDArray[np.float64] | None
"""A joint's Jacobian over its own coordinates, by rows; None where nothing acts."""


class StepWatch:
    """Tells from the times at which an item is asked for forces when a step begins.

    Attributes:
        tried: start and end of the last try of a step, s; None before the first one.
    """

    def __init__(self, mbs: exu.MainSystem) -> None:
        self._data: Any = mbs.systemData
        self.tried: tuple[float, float] | None = None

    def new_step(self, time: float) -> tuple[float, bool] | None:
        """Return the size of a step to a time, s, and whether the last one was accepted.

        None where the step is under way already.
        """
        tried = self.tried
        if tried is not None and tried[1] == time:
            return None
        start = float(self._data.GetTime(START))
        self.tried = start, time
        return time - start, tried is None or start != tried[0] or start == tried[1]


class UserForceElement:
    """The clearance joints of one Exudyn system, as one massless item.

    Attributes:
        joints: in the order in which they were added.
        evaluations: how often forces were asked for.
        item: Exudyn's object number.
        nodes: node number -> where its coordinates start among the item's.
        size: number of the item's coordinates.
    """

    def __init__(self, mbs: exu.MainSystem) -> None:
        self.joints: list[ClearanceJoint] = []
        self.evaluations = 0
        self.item: int | None = None
        self._mbs = mbs
        self._data: Any = mbs.systemData
        self.nodes: dict[int, int] = {}
        self.size = 0
        self._steps = StepWatch(mbs)
        self._jacobian_time: float | None = None
        self._last: tuple[Any, Any] = None, None
        self._time = 0.0  # of it, s
        self._idle: list[list[float]] = []
        self._moving: list[int] | None = None  # entries of the Jacobian that are not the ground's
        self._triplets: NDArray[np.float64] = np.zeros((0, 3))
        self._matrix = exu.MatrixContainer()
        self._within: list[tuple[NDArray[np.intp], NDArray[np.intp], int]] = []
        self._silent = False
        self._started = False
        self._blocks: list[Block] = []
        self._by_q_t = 1.0

    def index_of(self, node: int | None) -> int:
        """Return where a node's coordinates start; a node that is new is taken in.

        The ground has no coordinates: three zeros behind all others stand for it.
        """
        if node is None:
            return -len(GROUND)
        if node not in self.nodes:
            self.nodes[node] = self.size
            self.size += len(self._mbs.GetNodeParameter(node, "referenceCoordinates"))
        return self.nodes[node]

    def add(self, joint: ClearanceJoint) -> None:
        """Take in a joint whose ends' indices come from `index_of`."""
        self.joints.append(joint)
        nodes = list(self.nodes)
        entries = [
            (row, column)
            for joint in self.joints
            for row in joint.indices
            for column in joint.indices
        ]
        self._idle = [[0.0] * len(joint.indices) ** 2 for joint in self.joints]
        moving = [i for i, (row, column) in enumerate(entries) if row >= 0 and column >= 0]
        self._moving = moving if len(moving) < len(entries) else None
        self._triplets = np.zeros((3, len(moving))).T
        self._triplets[:, :2] = [entries[i] for i in moving]
        if self.item is None:
            self.item = add_massless_item(self._mbs, nodes, self._forces, self._jacobian)
        else:
            self._mbs.SetObjectParameter(self.item, "nodeNumbers", nodes)

    def state(self, joint: ClearanceJoint) -> JointState:
        """Return a joint's state when forces were last asked for."""
        q, q_t = self._last
        if q is None:
            q = q_t = [0.0] * self.size
        return _state_in(joint, q, q_t)

    def refuse_start(self, called: Callable[[ClearanceJoint], str]) -> None:
        """Refuse initial values with which a joint starts further out than its laws hold.

        Args:
            called: a joint -> its name in messages.

        Raises:
            InputError: a joint does; its message has the joint, its eccentricity, its clearance and
                what is allowed.
        """
        data: Any = self._mbs.systemData
        q = self._of_item(data.GetODE2Coordinates(exu.ConfigurationType.Initial))
        self._check_start(q, called)

    def _of_item(self, values: Any) -> list[float]:
        """Return the item's part of all coordinates of the system."""
        q = [0.0] * self.size
        for node, start in self.nodes.items():
            index = self._mbs.GetNodeODE2Index(node)
            for i in range(len(self._mbs.GetNodeParameter(node, "referenceCoordinates"))):
                q[start + i] = float(values[index + i])
        return q

    def memory(self) -> dict[str, Any]:
        """Return the memory of all joints, for a run that goes on from here."""
        tried = self._steps.tried
        return {"step": tried and list(tried), "joints": [joint.memory() for joint in self.joints]}

    def recall(self, memory: Mapping[str, Any]) -> None:
        """Go on from the memory of a system like this one, in the initial state.

        Raises:
            InputError: a joint is of another kind.
        """
        data: Any = self._mbs.systemData
        q = self._of_item(data.GetODE2Coordinates(exu.ConfigurationType.Initial))
        q_t = self._of_item(data.GetODE2Coordinates_t(exu.ConfigurationType.Initial))
        for joint in self.joints:
            _state_in(joint, q, q_t)
        self._last = q, q_t
        self._steps.tried = memory["step"] and tuple(memory["step"])
        for joint, joint_memory in zip(self.joints, memory["joints"], strict=True):
            with error_prefix(f"{self.number(joint)}: "):
                joint.recall(joint_memory)

    def _check_start(self, q: list[float], called: Callable[[ClearanceJoint], str]) -> None:
        """Raise InputError for a joint that is further out in a state than its laws hold."""
        self._started = True
        going_on = self._last[0] == q  # where the last run ended: joints keep their memory
        q_t = self._last[1] if going_on else [0.0] * self.size
        for joint in self.joints:
            state = _state_in(joint, q, q_t)
            spent = joint.outside is not None
            e = math.hypot(*state.eccentricity) if spent else joint.clearance - state.gap
            if not going_on:
                joint.reset()
            if not spent and e <= joint.largest_eccentricity:
                continue
            allowed = (
                "less, where its film's law gives numbers: a film ends where the surfaces touch "
                "(one with contact= goes on)"
                if spent
                else f"{joint.largest_eccentricity:.4g} m, a penetration of {SHALLOW:.0%} of the "
                "radius, up to which contact laws hold"
            )
            raise InputError(
                f"{called(joint)} starts with an eccentricity of {e:.4g} m at a clearance of "
                f"{joint.clearance:.4g} m: allowed is {allowed}"
            )

    def number(self, joint: ClearanceJoint) -> str:
        """Return a joint by its number, in the order in which they were added."""
        return f"clearance joint {self.joints.index(joint)}"

    @property
    def has_film(self) -> bool:
        """Return whether any joint has a film."""
        return any(joint.lubricated for joint in self.joints)

    @property
    def widest(self) -> float:
        """The largest clearance, m; 0.0 without joints."""
        return max((joint.clearance for joint in self.joints), default=0.0)

    @property
    def damping(self) -> float:
        """The most that any force changed with a speed, N s/m, in the last Jacobian.

        The force's point of attack counts: a speed moves it within the step.
        """
        largest = (float(np.abs(block).max()) for block in self._blocks if block is not None)
        return max(largest, default=0.0) / self._by_q_t

    @contextmanager
    def left_out(self) -> Iterator[None]:
        """Keep the joints out of the Jacobians that Exudyn computes meanwhile."""
        self._silent = True
        try:
            yield
        finally:
            self._silent = False

    def add_partials(self, matrix: NDArray[np.float64], by_q: float, by_q_t: float) -> None:
        """Add -(by_q dQ/dq + by_q_t dQ/dq_t) to a matrix over all coordinates of the system.

        Q are the forces that the joints were last asked for.

        Args:
            matrix: (m, m) in one piece, m >= n, the coordinates first.
            by_q: factor.
            by_q_t: factor, s.
        """
        if not self._within:
            self._within = [self._entries_within(joint, matrix.shape[1]) for joint in self.joints]
        entries = matrix.reshape(-1)
        q, q_t = self._last
        blocks = self._partials(self._time, q, q_t, by_q, by_q_t)
        for joint, block, (moving, within, first) in zip(
            self.joints, blocks, self._within, strict=True
        ):
            if block is None:
                continue
            if first >= 0:
                size = len(joint.indices)
                matrix[first : first + size, first : first + size] += np.reshape(
                    block, (size, size)
                )
            else:
                entries[within] += np.asarray(block)[moving]  # no entry is there twice

    def _entries_within(
        self, joint: ClearanceJoint, size: int
    ) -> tuple[NDArray[np.intp], NDArray[np.intp], int]:
        """Return which entries of a joint's block count, and where in a matrix of the system.

        The third is where they begin on its diagonal if they are one piece of it, else -1.
        """
        at = np.zeros(self.size, dtype=np.intp)
        for node, start in self.nodes.items():  # a later one overwrites what is behind this one
            at[start:] = self._mbs.GetNodeODE2Index(node) + np.arange(self.size - start)
        indices = np.array(joint.indices)
        rows, columns = (axis.ravel() for axis in np.meshgrid(indices, indices, indexing="ij"))
        moving = np.flatnonzero((rows >= 0) & (columns >= 0))  # all but the ground's
        together = bool((indices >= 0).all()) and bool((np.diff(at[indices]) == 1).all())
        first = int(at[indices[0]]) if together else -1
        return moving, at[rows[moving]] * size + at[columns[moving]], first

    def _forces(self, mbs: exu.MainSystem, time: float, item: int, q: Any, q_t: Any) -> Any:
        """Return the generalised forces of all joints, a list as Exudyn passes and takes it.

        Not a number where a state is so far out that a law overflows.
        """
        self.evaluations += 1
        if not self._started:  # of Exudyn's own solvers, which would end without a word
            self._check_start(q, self.number)
        if step := self._steps.new_step(time):
            for joint in self.joints:
                joint.begin_step(*step)
        self._last, self._time = (q, q_t), time
        size = len(q)
        q, q_t = [*q, *GROUND], [*q_t, *GROUND]
        out = [0.0] * (size + 3)
        try:
            for joint in self.joints:
                joint.add_force(q, q_t, out)
        except OverflowError:  # Newton's method went astray, and is told so
            return [math.nan] * size
        return out[:size]

    def _jacobian(
        self,
        mbs: exu.MainSystem,
        time: float,
        item: int,
        q: Any,
        q_t: Any,
        by_q: float,
        by_q_t: float,
    ) -> Any:
        """Return the Jacobian of the left-hand side: rows, columns and values; doubles add up."""
        if self._silent:
            self._matrix.SetWithSparseMatrix(np.zeros((0, 3)), self.size, self.size)
            return self._matrix
        values: list[float] = []
        blocks = self._partials(time, q, q_t, by_q, by_q_t)
        for i, block in enumerate(blocks):
            if block is None:
                values += self._idle[i]
            elif isinstance(block, list):
                values += block
            else:
                values += block.tolist()
        moving = self._moving
        self._triplets[:, 2] = values if moving is None else [values[i] for i in moving]
        self._matrix.SetWithSparseMatrix(self._triplets, self.size, self.size)
        return self._matrix

    def _partials(self, time: float, q: Any, q_t: Any, by_q: float, by_q_t: float) -> list[Block]:
        """Return each joint's part of the Jacobian of the left-hand side in a state."""
        # Forces asked for twice in one state leave a joint with nothing but its tangent: the right
        # thing for all but a step's first Jacobian, which may use where the last step ended.
        if time == self._jacobian_time or self._last != (q, q_t):
            self._forces(self._mbs, time, 0, q, q_t)
        self._jacobian_time = time
        try:
            self._blocks = [joint.jacobian(by_q, by_q_t) for joint in self.joints]
        except OverflowError:
            self._blocks = [None] * len(self.joints)
        self._by_q_t = by_q_t
        return self._blocks


def _state_in(joint: ClearanceJoint, q: Any, q_t: Any) -> JointState:
    """Return a joint's state in a state of the item, whose forces are asked for."""
    joint.add_force([*q, *GROUND], [*q_t, *GROUND], [0.0] * (len(q) + len(GROUND)))
    return joint.state


def add_massless_item(mbs: exu.MainSystem, nodes: Sequence[int], forces: Any, jacobian: Any) -> int:
    """Lay an item without mass over nodes, which exerts forces on them; return its number.

    Args:
        mbs: not yet assembled.
        nodes: whose coordinates it takes, in their order.
        forces: Exudyn's user function of the generalised forces.
        jacobian: that of the Jacobian of minus these.
    """
    item = ObjectGenericODE2(
        nodeNumbers=list(nodes),
        forceUserFunction=forces,
        jacobianUserFunction=jacobian,
        visualization=VObjectGenericODE2(show=False),
    )
    return int(mbs.AddObject(item))


def user_force_of(mbs: exu.MainSystem) -> UserForceElement:
    """Return the user force element of a system, kept with the system's own variables."""
    user_force = mbs.variables.get(REGISTRY)
    if user_force is None:
        user_force = mbs.variables[REGISTRY] = UserForceElement(mbs)
    return user_force


def holds_joints(mbs: exu.MainSystem) -> bool:
    """Return whether a system has clearance joints of this package."""
    return REGISTRY in mbs.variables and bool(user_force_of(mbs).joints)
