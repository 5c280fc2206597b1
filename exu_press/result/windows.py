"""Parts of a run's record."""

import math

import numpy as np

from exu_press.errors import InputError
from exu_press.numerics.arrays import Array
from exu_press.numerics.piecewise import evaluate, spline
from exu_press.result.result import Result

__all__ = [
    "NEARLY",
    "at_instant",
    "interpolated_window",
    "interval",
    "revolutions_of",
    "settled_part",
    "up_to",
    "whole_revolutions",
    "window",
]

NEARLY = 1e-3
"""Revolutions that a whole one may lack, and by which equal windows may differ: a flexible crank
twists, and one that a motor turns lags."""


def whole_revolutions(turns: float) -> int:
    """Return how many whole revolutions there are in some.

    >>> whole_revolutions(1.99999), whole_revolutions(1.99), whole_revolutions(-0.5)
    (2, 1, 0)
    """
    return max(0, math.floor(turns + NEARLY))


def window(run: Result, begin: float, end: float) -> Result:
    """Return a run's record between two instants, s, both of them included."""
    first = int(np.searchsorted(run.time, begin * (1.0 - 1e-12)))
    last = int(np.searchsorted(run.time, end * (1.0 + 1e-12), side="right"))
    return run.map_values(lambda _, values: values[first:last])


def interval(result: Result, start: float | None, stop: float | None) -> tuple[float, float]:
    """Return begin and end of the shown part, s; those of the record where none are given.

    Raises:
        InputError: they lie outside the record, or in another order.
    """
    first, last = float(result.time[0]), float(result.time[-1])
    for option, value in (("--from", start), ("--to", stop)):
        if value is not None and not first <= value <= last:
            raise InputError(f"{option} {value:g}: the record goes from {first:g} to {last:g} s")
    begin, end = first if start is None else start, last if stop is None else stop
    if not begin < end and first < last:
        raise InputError(f"--from {begin:g} --to {end:g}: allowed is --from before --to")
    return begin, end


def settled_part(run: Result) -> Result:
    """Return the part from which quantities are read: whole revolutions after those of `settle`.

    The whole run where nothing settles, or where it ends before that. Energies count from the
    part's begin. An incomplete revolution at the end is left out, unless it is the only one.
    """
    settle_revolutions, start = run.scene.settle_revolutions, run.scene.start_angle
    angle = run["crank_angle"]
    if not settle_revolutions or len(angle) < 2:
        return run
    completed = (angle[-1] - start) / (2.0 * np.pi)
    if completed <= settle_revolutions:
        return run
    settle_revolutions = max(settle_revolutions, (angle[0] - start) / (2.0 * np.pi))
    whole = whole_revolutions(completed - settle_revolutions)
    last = settle_revolutions + whole if whole else completed
    begin, end = np.interp(
        start + 2.0 * np.pi * np.array([settle_revolutions, last]), angle, run.time
    )
    settled = interpolated_window(run, float(begin), float(end))
    energies = [name for name, unit in run.units.items() if unit == "J"]
    return settled.map_values(
        lambda name, values: values - values[0] if name in energies else values
    )


def interpolated_window(run: Result, begin: float, end: float) -> Result:
    """Return a run's record between two instants, s, at which channels are interpolated."""
    time, near = run.time, 1e-9 * (end - begin)
    first, last = np.searchsorted(time, [begin + near, end - near])
    bounds = [(max(i, 1), instant) for i, instant in ((first, begin), (last, end))]

    def interpolate(values: Array) -> Array:
        ends = []
        for i, instant in bounds:
            share = (instant - time[i - 1]) / (time[i] - time[i - 1])
            ends.append(values[i - 1] + share * (values[i] - values[i - 1]))
        return np.concatenate([ends[0][None], values[first:last], ends[1][None]])

    return run.map_values(lambda _, values: interpolate(values))


def up_to(run: Result, end: float) -> Result:
    """Return a run's record up to an instant, s."""
    return window(run, float(run.time[0]), end)


def at_instant(run: Result, instant: float) -> Result:
    """Return a run's record of one instant, s, by a cubic spline through the samples about it.

    Linear interpolation of an energy over long steps would exceed the run's error. The run has four
    samples at least.
    """
    first = int(np.clip(np.searchsorted(run.time, instant) - 2, 0, len(run.time) - 4))
    about = slice(first, first + 4)
    time = run.time[about]

    def then(_: str, values: Array) -> Array:
        return evaluate(time, spline(time, np.moveaxis(values[about], 0, -1)), instant)[None]

    return run.map_values(then)


def revolutions_of(run: Result) -> list[Result]:
    """Return the records of a run's whole revolutions."""
    period = 60.0 / run.scene.speed_rpm
    count = whole_revolutions(float(run.time[-1] - run.time[0]) / period)
    return [window(run, k * period, (k + 1) * period) for k in range(count)]
