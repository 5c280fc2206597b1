"""The energy balance of a run: mechanical energy, and work of loads."""

from collections.abc import Sequence

import numpy as np

from exu_press.mechanism import Body
from exu_press.numerics.arrays import Array

__all__ = ["mechanical_energy", "work"]


def mechanical_energy(
    bodies: Sequence[Body], position: Array, velocity: Array, gravity: float
) -> Array:
    """Return kinetic plus potential energy over time, (n,), J, from (n, bodies, 3) arrays."""
    mass = np.array([body.mass for body in bodies])
    inertia = np.array([body.inertia for body in bodies])
    speed_2, spin_2 = (velocity[:, :, :2] ** 2).sum(axis=2), velocity[:, :, 2] ** 2
    return np.asarray(
        0.5 * (speed_2 @ mass + spin_2 @ inertia) + gravity * (position[:, :, 1] @ mass)
    )


def work(time: Array, load: Array, rate: Array) -> Array:
    """Return the work of loads since the start, (n,), J.

    Each step adds h times mean load times mean rate, as Newmark's formulas do, while the
    mean of the powers differs by h (change of load) (change of rate) / 4, a lot in an impact.

    Args:
        time: (n,), s.
        load: (n,) or (n, k) forces or moments, N or N m.
        rate: the velocities they act on, same shape, m/s or rad/s.
    """
    load, rate = load.reshape(len(time), -1), rate.reshape(len(time), -1)
    means = 0.25 * (load[1:] + load[:-1]) * (rate[1:] + rate[:-1])
    return np.concatenate([[0.0], np.cumsum(np.diff(time) * means.sum(axis=1))])
