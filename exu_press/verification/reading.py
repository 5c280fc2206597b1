"""The error of reading loads at steps, which all runs share."""

from collections.abc import Callable

import numpy as np

from exu_press.numerics.arrays import Array
from exu_press.quantities.alternating import LOADS, beside_line
from exu_press.quantities.energy import has_balance
from exu_press.result import Result
from exu_press.result.windows import settled_part

__all__ = ["OF_FIRST_STEP", "overshot", "smoothed", "turned", "unbalanced"]

SPEEDS = frozenset({"m/s", "rad/s"})
"""Units of the channels whose peaks lie between steps, too; positions are read as cubics there."""

OF_FIRST_STEP = 0.25
"""Overshoot over a load's change in the first step: 0.07 to 0.18 were measured with films."""

BESIDE = 0.07
"""Force across, over the change of one that turns round within a step: 0.02 to 0.07 were measured
of a mixed film behind a blanking pulse, in steps of 0.1 us."""

AT_ONCE = 1e-6
"""Part of the first step: an instant so soon after the start."""


def smoothed(run: Result) -> Result:
    """Return a run with loads and speeds averaged, at each step, with the line of its neighbours.

    The constraints of generalized-alpha leave loads that alternate from step to step, most so at
    the start and in the small steps of impacts; this takes the alternating part away. Of a peak
    that lies between steps it takes twice what it may be higher than the steps say. So the
    difference of a figure of the two is what reading it leaves open.
    """
    return _with(run, LOADS | SPEEDS, _averaged)


def overshot(run: Result) -> Result:
    """Return a run with a further instant, just after the start, at which films have their loads.

    Within the first step they take them up, none can tell when, with an overshoot that its end does
    not show: OF_FIRST_STEP of what it changes.
    """
    if len(run.time) < 2:
        return run
    soon = AT_ONCE * (run.time[1] - run.time[0])

    def begun(name: str, values: Array) -> Array:
        more = np.concatenate([values[:1], values])
        if name == "time":
            more[1] += soon
        return more

    return _with(run.map_values(begun), LOADS, _overshot)


def turned(run: Result) -> Result:
    """Return a run with larger forces where they turn round within a step.

    A film whose load is reversed passes it to its other side within microseconds, which no speed
    feels and no step resolves. The force need not go through zero on its way: BESIDE of its change
    may act across.
    """
    return _with(run, LOADS, _turned)


def unbalanced(run: Result) -> Result:
    """Return a run that is put in as much more energy as its balance misses at worst.

    The energy put in is the integral of a power that is read at steps. Where it flows back and
    forth, as over whole revolutions, errors cancel at the end, which is luck. The drive's power is
    more by as much in the mean.
    """
    if not has_balance(run):
        return run
    run = settled_part(run)
    given = run["energy_input"]
    missed = np.abs(given - run["energy_stored"] - run["energy_dissipated"]).max()
    changed = {"energy_input": np.concatenate([given[:1], given[1:] + missed])}
    if len(run.time) > 1:
        changed["drive_power"] = run["drive_power"] + missed / (run.time[-1] - run.time[0])
    return run.with_values(changed)


def _with(run: Result, units: frozenset[str], change: Callable[[Array, Array], Array]) -> Result:
    """Return a run with other channels of these units: change(time (n,), values (n, ...))."""
    time, of = run.time, run.units
    return run.map_values(lambda name, old: change(time, old) if of[name] in units else old)


def _averaged(time: Array, values: Array) -> Array:
    """Return values (n, ...) averaged with their neighbours', but for the first.

    What alternates has the other sign at the last one, which has one neighbour only.
    """
    if len(time) < 3:
        return values
    taken = 0.5 * beside_line(time, values)
    last = values[-1:] + taken[-1:]
    return np.concatenate([values[:1], values[1:-1] - taken, last])


def _turned(_: Array, values: Array) -> Array:
    """Return vectors (n, k), each component larger where they turn round within a step."""
    if values.ndim != 2 or values.shape[1] < 2:
        return values
    jump = np.linalg.norm(np.diff(values, axis=0), axis=1)
    round_ = np.sum(values[1:] * values[:-1], axis=1) < 0.0
    open_ = np.where(round_, BESIDE * jump, 0.0)
    larger = np.maximum(np.append(open_, 0.0), np.insert(open_, 0, 0.0))[:, None]
    return np.asarray(values + np.copysign(larger, values))


def _overshot(_: Array, values: Array) -> Array:
    """Return values (n, ...) whose second one is the third one, and more."""
    second = values[2] + OF_FIRST_STEP * (values[2] - values[0])
    return np.concatenate([values[:1], second[None], values[2:]])
