"""How far two runs are apart, quantity by quantity, each in its own norm.

Quantities, in this order: displacements of nodes, their rotations, coordinates of nodes without
displacement, first-order coordinates, values of sensors, and when the runs ended.
"""

from typing import Any

import numpy as np
from numpy.linalg import norm

from exu_press.exudyn_systems.samples import Samples, Variables
from exu_press.numerics.arrays import Array

__all__ = ["at_peaks", "common", "differences", "excess_step", "scales_of"]

SMALLEST = 1e-6  # scale over the largest one of its like: rounding alone moves what is smaller
LARGEST_TURN = 0.5  # angle by which a body may turn in a step of a level that decides, rad
STEPS_IN_PERIOD = 10.0  # fewest steps in a period of a coordinate in a level that decides


def common(first: Samples, second: Samples) -> tuple[Any, Any]:
    """Return the numbers of the instants that two runs have in common, in either run."""
    close = 1e-7 * (second.times[-1] - second.times[0])
    theirs = np.searchsorted(second.times[:-1], first.times - close)
    ours = np.flatnonzero(np.abs(second.times[theirs] - first.times) <= close)
    return ours, theirs[ours]


def differences(first: Samples, second: Samples, variables: Variables) -> Array:
    """Return the differences of two runs at their common instants, (instants, quantities)."""
    ours, theirs = common(first, second)

    def change(name: str) -> Any:
        return getattr(first, name)[ours] - getattr(second, name)[theirs]

    coordinates, sensors = change("coordinates"), np.abs(change("sensors"))
    angles = np.char.endswith(variables.kinds, ".Rotation")
    sensors[:, angles] = np.abs((sensors[:, angles] + np.pi) % (2.0 * np.pi) - np.pi)
    plain = [norm(coordinates[:, variables.spans[node]], axis=-1) for node in variables.plain]
    parts = [
        norm(change("displacements"), axis=-1),
        _angles(change("rotations")),
        np.reshape(plain, (len(plain), len(ours))).T,
        np.abs(change("first_order")),
        sensors,
        np.full((len(ours), 1), abs(first.times[-1] - second.times[-1])),
    ]
    return np.asarray(np.nan_to_num(np.concatenate(parts, axis=1), nan=np.inf))


def at_peaks(first: Samples, second: Samples, apart: Array) -> Array:
    """Return, of all differences, those of sensors where either run peaks: a bound of peaks'."""
    ours, theirs = common(first, second)
    sizes = np.abs(first.sensors[ours]), np.abs(second.sensors[theirs])
    peaks = np.any([~(size < size.max(axis=0)) for size in sizes], axis=0)
    of_sensors = apart[:, -1 - peaks.shape[1] : -1]
    return np.asarray(of_sensors.max(axis=0, where=peaks, initial=0.0))


def scales_of(samples: Samples, variables: Variables, duration: float) -> Array:
    """Return the scale of each quantity in a run of a duration, s, (quantities,); 1 if it is 0."""
    moved = norm(samples.displacements - samples.displacements[0], axis=-1).max(initial=0.0)
    turned = _angles(samples.rotations - samples.rotations[0]).max(initial=0.0)
    change = samples.coordinates - samples.coordinates[0]
    plain = [norm(change[:, variables.spans[node]], axis=-1).max() for node in variables.plain]
    coordinates = np.concatenate([plain, np.abs(samples.first_order).max(axis=0)])
    sensors = np.abs(samples.sensors).max(axis=0)
    for kind in set(variables.kinds):
        alike = variables.kinds == kind
        sensors[alike] = np.maximum(sensors[alike], SMALLEST * sensors[alike].max())
    nodes = [moved] * len(variables.placed) + [turned] * len(variables.turning)
    least = SMALLEST * np.abs(change).max(initial=0.0)
    scales = np.concatenate([nodes, np.maximum(coordinates, least), sensors, [duration]])
    return np.where(scales > 0.0, scales, 1.0)


def excess_step(
    samples: Samples, step: float, variables: Variables, scales: Array, tolerance: float
) -> float:
    """Return a step (s) over the longest one of a level that decides.

    A period is read from the root mean squares of a coordinate and of its velocity, which do not
    depend on how often they are sampled; a linear trend is no oscillation. Oscillations smaller
    than the tolerance do not count.
    """
    plain = len(variables.placed) + len(variables.turning)
    first = plain + len(variables.plain)
    turned = _angles(samples.rotations - samples.rotations[0]).max(axis=0)
    planar = {node for node, angle in zip(variables.turning, turned, strict=True) if angle > 0.0}
    scale = np.ones(samples.coordinates.shape[1])  # that of angles and Euler parameters
    for i, node in enumerate(variables.placed):
        start, stop = variables.spans[node].start, variables.spans[node].stop
        size = 2 if stop - start == 3 and node in planar else 3
        scale[start : min(start + size, stop)] = scales[i]
    for i, node in enumerate(variables.plain):
        scale[variables.spans[node]] = scales[plain + i]
    values = np.concatenate([samples.coordinates, samples.first_order], axis=1)
    rates = np.concatenate([samples.velocities, samples.rates], axis=1)
    since = samples.times - samples.times.mean()
    slope = since @ (values - values.mean(axis=0)) / (since @ since)
    amplitude = (values - np.outer(since, slope)).std(axis=0)
    scale = np.concatenate([scale, scales[first : first + samples.first_order.shape[1]]])
    counts = amplitude > tolerance * scale
    frequency = (rates.std(axis=0)[counts] / amplitude[counts]).max(initial=0.0)
    fastest = norm(samples.angular_velocities, axis=-1).max(initial=0.0)
    in_period = frequency * STEPS_IN_PERIOD / (2.0 * np.pi)
    return float(step * max(in_period, fastest / LARGEST_TURN))


def _angles(changes: Array) -> Array:
    """Return the angles between rotation matrices from their differences, rad."""
    chord = np.sqrt(np.sum(changes**2, axis=(-2, -1)) / 8.0)
    return np.asarray(2.0 * np.arcsin(np.minimum(chord, 1.0)))
