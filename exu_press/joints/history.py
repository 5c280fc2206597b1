"""The record of a joint over the steps of a run."""

from collections.abc import Callable, Collection, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from exu_press.joints.joint import GROUND, ClearanceJoint
from exu_press.joints.replay import replayed
from exu_press.numerics.arrays import Array

__all__ = ["JointHistory", "histories"]

AT_ONCE = 4096
"""Instants whose states are put into arrays together: a state in Python takes ten times the
memory."""


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

    @property
    def dissipated_power(self) -> Array:
        """Heat of contact, friction and film, (n,), W."""
        return -self.power - self.stored_power

    @property
    def power(self) -> Array:
        """Power of forces and moments on the two bodies, (n,), W."""
        found = np.zeros_like(self.gap)
        for loads, rates in ((self.force, self.velocity), (self.moments, self.angular_velocities)):
            for load, rate in zip(loads.T, rates.T, strict=True):
                found += load * rate
        return found

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


def histories(
    joints: Mapping[str, ClearanceJoint],
    time: Array,
    q: Array,
    q_t: Array,
    begun: Callable[[ClearanceJoint], list[Any] | None] = lambda joint: None,
    rubbing: Collection[str] = (),
) -> dict[str, JointHistory]:
    """Return the records of joints over recorded steps.

    Args:
        joints: go through the steps again; afterwards their memory is that of before.
        time: (n,), s.
        q: (n, m) coordinates of the user force element's item.
        q_t: (n, m) their rates.
        begun: a joint -> its memory at the first one, or None.
        rubbing: joints whose rubbing is wanted.
    """
    ended = {name: joint.memory() for name, joint in joints.items()}
    for joint in joints.values():
        joint.reset()
        memory = begun(joint)
        if memory is not None:
            joint.state([*q[0].tolist(), *GROUND], [*q_t[0].tolist(), *GROUND])
            joint.recall(memory)
    parts: dict[str, list[list[Array]]] = {name: [] for name in joints}
    rubbed: dict[str, list[float] | None] = {
        name: [] if name in rubbing else None for name in joints
    }
    steps = np.diff(time, prepend=time[0])
    ground = np.zeros((min(len(time), AT_ONCE), len(GROUND)))
    for first in range(0, len(time), AT_ONCE):
        part = slice(first, first + AT_ONCE)
        of_steps = steps[part].tolist()
        rows, rows_t = (
            np.hstack([each[part], ground[: len(of_steps)]]).ravel().tolist() for each in (q, q_t)
        )
        for name, joint in joints.items():
            numbers, lengths = replayed(joint, of_steps, rows, rows_t, rubbed[name])
            table = np.array(numbers).reshape(len(of_steps), -1)
            ends = np.cumsum(lengths)[:-1].tolist()
            parts[name].append(np.split(table, ends, axis=1))
    for name, joint in joints.items():
        joint.recall(ended[name])
    return {name: _history(found, rubbed[name]) for name, found in parts.items()}


def _history(parts: list[list[Array]], rubbing: list[float] | None) -> JointHistory:
    """Return the record of a joint from its states, part by part."""
    eccentricity, force, velocity, moments, turning, *numbers = (
        np.concatenate(columns) for columns in zip(*parts, strict=True)
    )
    gap, energy, power = (column[:, 0] for column in numbers)
    rubbed = np.array(rubbing or []).reshape(-1, 2)
    return JointHistory(eccentricity, force, velocity, moments, turning, gap, energy, power, rubbed)
