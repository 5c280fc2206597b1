"""The energy balance of a run, and the energies that recorders need for it."""

from collections.abc import Iterable, Mapping

import numpy as np

from exu_press.mechanism import Body, Motion
from exu_press.numerics.arrays import Array
from exu_press.result.channel import OWN, Declaration, Declarations
from exu_press.result.recording import Record, Recording

__all__ = ["CHANNELS", "mechanical_energy", "record", "work"]

CHANNELS = Declarations(
    Declaration("energy_input", "J", "work of drive, loads and pumps since the start", unless=OWN),
    Declaration("energy_stored", "J", "change of stored energy", unless=OWN),
    Declaration("energy_dissipated", "J", "energy dissipated since the start", unless=OWN),
)


def record(run: Recording) -> Record:
    """Return the sums of all preceding recorders; none with own items, whose energy is unknown."""
    if run.model.own_items:
        return Record({})
    supplied, stored, dissipated = map(
        np.asarray, (run.so_far.supplied, run.so_far.stored, run.so_far.dissipated)
    )
    return Record(
        CHANNELS.record(
            energy_input=supplied, energy_stored=stored - stored[0], energy_dissipated=dissipated
        )
    )


def mechanical_energy(
    bodies: Iterable[Body], motions: Mapping[str, Motion], gravity: float
) -> Array:
    """Return kinetic plus potential energy of bodies over time, (n,), J, by all bodies' motions."""
    energy = np.zeros(len(next(iter(motions.values())).position))
    for body in bodies:
        motion = motions[body.name]
        v_x, v_y, omega = motion.velocity.T
        energy += 0.5 * body.mass * (v_x * v_x + v_y * v_y) + 0.5 * body.inertia * omega * omega
        energy += body.mass * gravity * motion.position[:, 1]
    return energy


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
