"""The energy balance of a run: what the drive and the load put in, what is stored, what is lost."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import cumulative_trapezoid

from exu_press.mechanism import Body

__all__ = ["mechanical_energy", "work"]

Array = NDArray[np.float64]


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


def work(time: Array, power: Array) -> Array:
    """Return the work of a power since the start, (n,), J, by the trapezoidal rule."""
    return np.asarray(cumulative_trapezoid(power, time, initial=0.0))
