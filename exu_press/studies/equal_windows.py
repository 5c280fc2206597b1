"""Runs that are read from equally long windows."""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from exu_press.errors import InputError
from exu_press.quantities.reading import Reading
from exu_press.result import Result
from exu_press.result.windows import interpolated_window
from exu_press.scene import Scene

__all__ = ["require_common_window", "with_equal_windows"]

NEARLY = 1e-3
"""Revolutions by which windows may differ."""

CURE = "compare runs of the same settle and revolutions"


def require_common_window(items: Mapping[str, Scene | Result]) -> None:
    """Raise InputError unless scenes and results by label have revolutions in common."""
    spans = {
        label: (item.settle_revolutions, item.revolutions)
        if isinstance(item, Scene)
        else Reading(item).span
        for label, item in items.items()
    }
    if not _are_equal(list(spans.values())):
        _common_span(spans)


def with_equal_windows(results: Mapping[str, Result]) -> tuple[Mapping[str, Result], str]:
    """Return runs by label with equal windows, and what was done for that, or nothing.

    Windows are equal where they are as long and begin whole revolutions apart, as they were read or
    as scenes ask for them: a motor turns the crank by a little less or more. Others are cut to what
    all runs have, where errors of figures are not known.

    Raises:
        InputError: the runs have no revolutions in common, or one of them has kept no channels.
    """
    spans = [Reading(result).span for result in results.values()]
    if _are_equal(spans) or _are_equal(list(map(_asked_span, results.values(), spans))):
        return results, ""
    begin, end = _common_span(dict(zip(results, spans, strict=True)))
    text = (
        f"The runs have different windows: figures are read from revolutions {begin:.4g} to "
        f"{end:.4g}, which all have, and their errors are not known. For errors, {CURE}."
    )
    return {label: _restrict(label, run, begin, end) for label, run in results.items()}, text


def _common_span(spans: Mapping[str, tuple[float, float]]) -> tuple[float, float]:
    """Return the revolutions that all runs by label have."""
    begin, end = max(begin for begin, _ in spans.values()), min(end for _, end in spans.values())
    if end - begin < NEARLY:
        texts = [
            f"{label} is read from {first:g} to {last:g}" for label, (first, last) in spans.items()
        ]
        raise InputError(f"the runs have no revolutions in common: {', '.join(texts)}; {CURE}")
    return begin, end


def _are_equal(spans: Sequence[tuple[float, float]]) -> bool:
    """Return whether spans of revolutions are as long and begin whole ones apart."""
    first, last = spans[0]
    shifts = [begin - first for begin, _ in spans]
    changes = [end - last for _, end in spans]
    return all(
        abs(shift - change) < NEARLY and abs(shift - round(shift)) < NEARLY
        for shift, change in zip(shifts, changes, strict=True)
    )


def _asked_span(run: Result, span: tuple[float, float]) -> tuple[float, float]:
    """Return the revolutions that a run's scene asks for; those of its span where it stopped."""
    if not run.completed:
        return span
    first = (float(run["crank_angle"][0]) - run.scene.start_angle) / (2.0 * np.pi)
    return max(run.scene.settle_revolutions, first), first + run.scene.revolutions


def _restrict(label: str, run: Result, begin: float, end: float) -> Result:
    """Return a run that is read from these revolutions, without errors."""
    if "figures" in run.info:
        raise InputError(
            f"{label}: has kept its figures alone, which cannot be read from other revolutions; "
            f"{CURE}"
        )
    angle = run.scene.start_angle + 2.0 * np.pi * end
    last = float(np.interp(angle, run["crank_angle"], run.time))
    record = interpolated_window(run, float(run.time[0]), last)
    info: Any = {**run.info, "horizon": None}
    info.pop("errors", None)
    scene = run.scene.replace({"settle": begin, "revolutions": end})
    return replace(record, scene=scene, info=info)
