"""The states of joints at the instants of a run, taken while it goes; compiled like the joints."""

from array import array
from collections.abc import Collection, Sequence
from typing import Any

from exu_press.joints.joint import ClearanceJoint

__all__ = ["States"]


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
