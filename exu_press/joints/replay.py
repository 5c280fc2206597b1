"""A joint goes through the steps of a run again; compiled like the joints."""

from exu_press.joints.interface import InterfaceJoint
from exu_press.joints.joint import ClearanceJoint

__all__ = ["replayed"]


def replayed(
    joint: ClearanceJoint,
    steps: list[float],
    q: list[float],
    q_t: list[float],
    rubbing: list[float] | None,
) -> tuple[list[float], list[int]]:
    """Return the numbers of the joint's states, one state behind the other, and their lengths.

    Args:
        joint: remembers the steps before.
        steps: that end at the instants, s.
        q: coordinates of the user force element's item, the ground's behind them, one instant
            behind the other: thousands of lists would let Python look for garbage among all of its
            objects.
        q_t: their rates.
        rubbing: where normal force, N, and sliding velocity, m/s, are wanted, they are added here.
    """
    numbers: list[float] = []
    lengths: list[int] = []
    state, begin_step = joint.state, joint.begin_step
    width = len(q) // len(steps)
    for i in range(len(steps)):
        begin_step(steps[i], True)
        found = state(q[i * width : (i + 1) * width], q_t[i * width : (i + 1) * width])
        if not lengths:
            lengths = [len(part) if isinstance(part, tuple) else 1 for part in found]
        eccentricity, force, velocity, moments, turning, gap, energy, power = found
        numbers += eccentricity
        numbers += force
        numbers += velocity
        numbers += moments
        numbers += turning
        numbers.append(gap)
        numbers.append(energy)
        numbers.append(power)
        if rubbing is not None and isinstance(joint, InterfaceJoint):
            rubbing += joint.rubbing
    return numbers, lengths
