"""The record of a joint over the steps of a run."""

from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from exu_press.joints.joint import ClearanceJoint, States
from exu_press.numerics.arrays import Array

__all__ = ["JointHistory", "history"]


@dataclass(frozen=True)
class JointHistory:
    """A joint at n instants: the contents of `JointState`, instant by instant.

    Attributes:
        eccentricity: journal centre - bearing centre, (n, 2 or 3), m.
        force: on the journal at its centre, (n, 2 or 3), N; the bearing has its opposite.
        velocity: rate of the eccentricity, (n, 2 or 3), m/s.
        moments: on the journal, then on the bearing, (n, 2 or 6), N m.
        angular_velocities: that the moments act on, (n, 2 or 6), rad/s.
        gap: (n,), m.
        stored_energy: (n,), J.
        stored_power: (n,), W.
        rubbing: normal force of the contact, N, and sliding velocity, m/s, (n, 2); (0, 2) unless
            asked for.
        orientation: angle of the eccentricity in the bearing, rad, and power of the pump that feeds
            it, W, (n, 2); (n, 0) without grooves.
    """

    eccentricity: Array
    force: Array
    velocity: Array
    moments: Array
    angular_velocities: Array
    gap: Array
    stored_energy: Array
    stored_power: Array
    rubbing: Array
    orientation: Array

    @property
    def dissipated_power(self) -> Array:
        """Heat of contact, friction and film, (n,), W."""
        lost = -self.power - self.stored_power
        return lost + self.pump_power if self.orientation.size else lost

    @property
    def pump_power(self) -> Array:
        """Power of the pump that feeds grooves, (n,), W."""
        return self.orientation[:, 1] if self.orientation.size else np.zeros_like(self.gap)

    @property
    def power(self) -> Array:
        """Power of forces and moments on the two bodies, (n,), W."""
        total = np.zeros_like(self.gap)
        for loads, rates in ((self.force, self.velocity), (self.moments, self.angular_velocities)):
            for load, rate in zip(loads.T, rates.T, strict=True):
                total += load * rate
        return total

    @property
    def moments_in_plane(self) -> Array:
        """Moments on journal and bearing about the z axis, (n, 2), N m; a ball's have three."""
        return self.moments[:, self._about_z]

    @property
    def turning(self) -> Array:
        """Angular velocities of journal and bearing about the z axis, (n, 2), rad/s."""
        return self.angular_velocities[:, self._about_z]

    @property
    def _about_z(self) -> list[int]:
        return [self.moments.shape[1] // 2 - 1, -1]


def history(states: States, joint: ClearanceJoint, time: Array) -> JointHistory:
    """Return the record of a joint at instants (n,), s, that were taken."""
    number = states.joints.index(joint)
    lengths = states.lengths[number]
    first = 1 + sum(map(sum, states.lengths[:number]))
    table = np.frombuffer(states.numbers).reshape(-1, 1 + sum(map(sum, states.lengths)))
    if len(table) != len(time):  # Exudyn's sensors leave out what is next to no step
        table = table[np.searchsorted(table[:, 0], time)]
    ends = first + np.cumsum([0, *lengths])
    parts = [np.array(table[:, begin:end]) for begin, end in pairwise(ends.tolist())]
    eccentricity, force, velocity, moments, turning, gap, energy, power, rubbing, *rest = parts
    gap, energy, power = (column[:, 0] for column in (gap, energy, power))
    rubbing = rubbing if lengths[-2] else np.zeros((0, 2))
    return JointHistory(
        eccentricity, force, velocity, moments, turning, gap, energy, power, rubbing, *rest
    )
