"""The base of all joints with clearance, a joint's state, and the states over a run."""

from array import array
from collections.abc import Collection, Sequence
from typing import Any

from exu_press.joints.path import Path
from exu_press.numerics.arrays import Array

__all__ = ["GROUND", "SHALLOW", "ClearanceJoint", "JointState", "States"]

Vector = tuple[float, ...]

GROUND = (0.0, 0.0, 0.0)
"""Stands behind all other coordinates of the item for those of the ground in the plane."""

SHALLOW = 0.01
"""Penetration over radius up to which contact laws hold: they are for a contact that is small
beside the radius, and its half-width sqrt(R delta) is then a tenth of it (Johnson 1985, 4.2)."""


class JointState:
    """A joint at one instant, in the global frame: x, y in the plane, x, y, z in space.

    Attributes:
        eccentricity: journal centre - bearing centre, m.
        force: on the journal at its centre, N; the bearing has its opposite.
        velocity: rate of the eccentricity, m/s.
        moments: on the journal, then on the bearing, about their centres, N m; of a revolute joint
            about its axis.
        angular_velocities: the angular velocities that the moments act on, rad/s.
        gap: clearance - |eccentricity|, m: the film's least thickness, or minus the penetration.
        stored_energy: elastic energy of contact and bristles, J.
        stored_power: its rate, W.
    """

    def __init__(
        self,
        eccentricity: Vector,
        force: Vector,
        velocity: Vector,
        moments: Vector,
        angular_velocities: Vector,
        gap: float,
        stored_energy: float,
        stored_power: float,
    ) -> None:
        self.eccentricity = eccentricity
        self.force = force
        self.velocity = velocity
        self.moments = moments
        self.angular_velocities = angular_velocities
        self.gap = gap
        self.stored_energy = stored_energy
        self.stored_power = stored_power

    @property
    def vectors(self) -> tuple[Vector, ...]:
        """Those of its contents that have several numbers."""
        return (
            self.eccentricity,
            self.force,
            self.velocity,
            self.moments,
            self.angular_velocities,
        )

    @property
    def dissipated_power(self) -> float:
        """Heat of contact, friction and film, W."""
        return -self.power - self.stored_power

    @property
    def power(self) -> float:
        """Power of forces and moments on the two bodies, W."""
        pairs = zip(self.force + self.moments, self.velocity + self.angular_velocities, strict=True)
        return sum(load * rate for load, rate in pairs)


class ClearanceJoint:
    """A joint over some of the coordinates of the user force element's item.

    Attributes:
        indices: positions of its coordinates among those of the item.
        clearance: radial clearance, m.
        contact_onset: eccentricity at which its surfaces begin to touch, m, less than the clearance
            where they are rough; infinite where a film alone lies between them.
        largest_eccentricity: up to which its contact laws hold, m; infinite without contact.
        lubricated: whether it has a film.
        path: of the journal.
    """

    def __init__(
        self,
        indices: list[int],
        clearance: float,
        contact_onset: float,
        largest_eccentricity: float,
        lubricated: bool,
    ) -> None:
        self.indices = indices
        self.clearance = clearance
        self.contact_onset = contact_onset
        self.largest_eccentricity = largest_eccentricity
        self.lubricated = lubricated
        self.path = Path()
        self._step = 0.0

    @property
    def outside(self) -> float | None:
        """Eccentricity ratio of the last state if a film's law did not hold there."""
        return None

    @property
    def eccentricity(self) -> Vector:
        """Journal centre - bearing centre at the last `add_force`, m."""
        raise NotImplementedError

    @property
    def relative_velocity(self) -> Vector:
        """Rate of the eccentricity at the last `add_force`, m/s."""
        raise NotImplementedError

    @property
    def force(self) -> Vector:
        """Force on the journal at the last `add_force`, N."""
        raise NotImplementedError

    @property
    def rubbing(self) -> Vector:
        """Normal force of the contact, N, and sliding velocity, m/s, where they can be recorded."""
        return ()

    @property
    def orientation(self) -> Vector:
        """Angle of the eccentricity in the bearing, rad, and power of the pump, W, with grooves."""
        return ()

    @property
    def state(self) -> JointState:
        """The joint's state at the last `add_force`."""
        raise NotImplementedError

    def add_force(self, q: list[float], q_t: list[float], out: list[float]) -> None:
        """Add the joint's generalised forces to `out`."""
        raise NotImplementedError

    def jacobian(self, by_q: float, by_q_t: float) -> list[float] | Array | None:
        """Return -(by_q dQ/dq + by_q_t dQ/dq_t) at the state of the last `add_force`, by rows.

        Over the joint's own coordinates; None where nothing acts.
        """
        raise NotImplementedError

    def contact_depth(self) -> float:
        """Return the penetration at the last `add_force`, m; none where it is not positive."""
        return 0.0

    def contact_memory(self) -> float:
        """Return damping over stiffness of the normal force at the last `add_force`, s."""
        return 0.0

    def begin_step(self, step: float, accepted: bool) -> None:
        """Start a step of size `step` (s), after the last one was accepted or is repeated."""
        if accepted:
            depth = self.contact_depth()
            memory = self.contact_memory() if depth > 0.0 else 0.0
            self.path.go_on(self.eccentricity, self.relative_velocity, self._step, depth, memory)
        self._step = step

    def reset(self) -> None:
        """Forget everything."""
        self.path, self._step = Path(), 0.0

    def memory(self) -> list[Any]:
        """Return the memory of the steps before, numbers in lists."""
        return [self._step, self.path.memory()]

    def recall(self, memory: list[Any]) -> None:
        """Take over the memory of another joint of its kind, in the state of the last forces."""
        self._step = memory[0]
        self.path.recall(memory[1])


class States:
    """Numbers that joints were last asked for at every step's end, one instant behind the other.

    The integration has worked it out: forces and memory need no second pass over the steps.

    Attributes:
        joints: whose states are taken, in the order of the numbers.
        numbers: of each instant (s): itself, then of each joint the numbers of its `JointState`,
            of one whose rubbing is wanted the normal force, N, and the sliding velocity, m/s, and
            of one with grooves the angle of the eccentricity in the bearing, rad, and the power of
            the pump that feeds it, W.
        lengths: of the parts of each joint's numbers.
    """

    def __init__(
        self, joints: Sequence[ClearanceJoint], rubbing: Collection[ClearanceJoint] = ()
    ) -> None:
        """Take the states of joints, and of some the rubbing as well."""
        self.joints = list(joints)
        self.numbers: Any = array("d")
        self.lengths: list[list[int]] = []
        self._rubbing = [joint in rubbing for joint in joints]

    def clear(self) -> None:
        """Forget the instants before."""
        self.numbers = array("d")  # a new one: arrays may be views of the other

    def take(self, time: float) -> None:
        """Take the states of the last forces as those of an instant, s."""
        if not self.joints:
            return
        numbers = [time]
        for i, joint in enumerate(self.joints):
            state = joint.state
            numbers += state.eccentricity
            numbers += state.force
            numbers += state.velocity
            numbers += state.moments
            numbers += state.angular_velocities
            numbers.append(state.gap)
            numbers.append(state.stored_energy)
            numbers.append(state.stored_power)
            rubbing = joint.rubbing if self._rubbing[i] else ()
            numbers += rubbing
            numbers += joint.orientation
            if len(self.lengths) == i:
                lengths = [len(vector) for vector in state.vectors]
                self.lengths.append([*lengths, 1, 1, 1, len(rubbing), len(joint.orientation)])
        self.numbers.fromlist(numbers)
