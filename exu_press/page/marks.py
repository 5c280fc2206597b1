"""Marks on the curves: impacts, dead centres, peaks with their errors."""

from collections.abc import Iterable
from typing import Any

import numpy as np

from exu_press.numerics.arrays import Array, lengths
from exu_press.page.curves import Curve
from exu_press.quantities.alternating import LOADS, remove_alternation
from exu_press.quantities.dead_centre import bottom_dead_centres
from exu_press.quantities.joints import contact_onsets
from exu_press.quantities.value import values_of
from exu_press.result import Result
from exu_press.result.windows import NEARLY, settled_part
from exu_press.scene import mechanism_of

__all__ = ["dead_centres", "impacts", "peaks", "values_on"]

MOST_IMPACTS = 5000
"""Those with the largest forces; a page with more would not open."""


def impacts(result: Result) -> tuple[list[dict[str, Any]], int]:
    """Return the impacts of all joints in their order, and how many more there were.

    An impact begins where surfaces begin to touch and ends where they part, and has the largest
    force in between (N); times in s.
    """
    impact_list: list[dict[str, Any]] = []
    for name in result.clearance_joints:
        joint, described = result.joints[name], result.scene.joints[name]
        if described.onset is None:
            continue
        depth, size = described.onset - joint.gap, lengths(joint.force)
        apart = np.append(np.flatnonzero(depth <= 0.0), len(depth))
        for begin in contact_onsets(depth):
            end = apart[np.searchsorted(apart, begin)]
            peak = begin + int(np.argmax(size[begin:end]))
            impact_list.append(
                {
                    "joint": name,
                    "from": float(result.time[begin]),
                    "to": float(result.time[min(end, len(size) - 1)]),
                    "peak": float(result.time[peak]),
                    "force": float(size[peak]),
                }
            )
    largest = sorted(impact_list, key=lambda impact: -impact["force"])[:MOST_IMPACTS]
    return sorted(largest, key=lambda impact: impact["from"]), len(impact_list) - len(largest)


def dead_centres(result: Result) -> list[dict[str, Any]]:
    """Return the top dead centres of the ideal slider and the run's own bottom ones, in s."""
    ends = mechanism_of(result.scene).dead_centres
    if ends is None or len(result.time) < 2:
        return []
    angle = result["crank_angle"]
    turns = np.arange(np.ceil((angle[0] - ends[0]) / (2 * np.pi) - NEARLY), angle[-1] / 6.0 + 2)
    tops = ends[0] + 2 * np.pi * turns
    times = np.interp(tops[tops <= angle[-1] + 2 * np.pi * NEARLY], angle, result.time)
    marks: list[dict[str, Any]] = [{"kind": "TDC", "at": float(time)} for time in times]
    if {"slider_position", "slider_velocity"} <= set(result.channels):
        marks += [{"kind": "BDC", "at": centre.time} for centre in bottom_dead_centres(result)]
    return sorted(marks, key=lambda mark: float(mark["at"]))


def values_on(result: Result, curve: Curve, *, as_read: bool = False) -> Array:
    """Return a curve's values, (n,), SI; as peaks are read from them, if asked for."""
    values = result[curve.channel]
    if as_read and result.channels[curve.channel].unit in LOADS:
        values = remove_alternation(result.time, values)
    if curve.body is not None:
        values = values[:, curve.body]
    if values.ndim == 2:
        chosen = values[:, list(curve.columns)]
        single = len(curve.columns) == 1
        values = chosen[:, 0] if single else lengths(chosen)
    return np.asarray(curve.offset + curve.factor * values)


def peaks(result: Result, curves: Iterable[Curve]) -> dict[str, dict[str, Any]]:
    """Return, by curve, the peak that a quantity states, with its error and its bounds, SI.

    It is in the part of the run from which quantities are read.
    """
    values_by_name = values_of(result)
    read = settled_part(result).time
    inside = (result.time >= read[0]) & (result.time <= read[-1])
    marks = {}
    for curve in curves:
        value = values_by_name.get(curve.peak)
        if value is None or value.value is None:
            continue
        values = values_on(result, curve, as_read=True)
        sizes = -values if curve.least else np.abs(values)
        at = int(np.argmax(np.where(inside, sizes, -np.inf)))
        sign = -1.0 if values[at] < 0.0 <= value.value else 1.0
        marks[curve.name] = {
            "at": float(result.time[at]),
            "value": sign * float(value.value),
            "low": None if value.low is None else sign * float(value.low),
            "high": None if value.high is None else sign * float(value.high),
            "error": value.error,
            "determined": value.determined,
            "quantity": value.name,
        }
    return marks
