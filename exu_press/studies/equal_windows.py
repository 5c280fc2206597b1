"""Runs that are read from equally long windows."""

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

import numpy as np

from exu_press.errors import InputError
from exu_press.quantities.reading import Reading
from exu_press.result import Result
from exu_press.result.windows import up_to

__all__ = ["with_equal_windows"]

NEARLY = 1e-3
"""Revolutions by which windows may differ."""

CURE = "compare runs of the same settle and revolutions"


def with_equal_windows(results: Mapping[str, Result]) -> tuple[Mapping[str, Result], str]:
    """Return runs by label with equal windows, and what was done for that, or nothing.

    Windows are equal where they are as long and begin whole revolutions apart. Others are cut to
    what all runs have, where errors of figures are not known.

    Raises:
        InputError: the runs have no revolutions in common, or one of them has kept no channels.
    """
    windows = [_window(result) for result in results.values()]
    first_begin, first_length = windows[0]
    if all(
        abs(begin - first_begin - round(begin - first_begin)) < NEARLY
        and abs(length - first_length) < NEARLY
        for begin, length in windows
    ):
        return results, ""
    begin = max(begin for begin, _ in windows)
    end = min(begin + length for begin, length in windows)
    if end - begin < NEARLY:
        raise InputError(f"the runs have no revolutions in common; {CURE}")
    text = (
        f"The runs have different windows: figures are read from revolutions {begin:.4g} to "
        f"{end:.4g}, which all have, and their errors are not known. For errors, {CURE}."
    )
    return {label: _restrict(label, run, begin, end) for label, run in results.items()}, text


def _window(run: Result) -> tuple[float, float]:
    """Return begin and length of the revolutions that quantities are read from.

    Of a complete run as its scene asks for them: a motor turns the crank by a little less or more.
    """
    begin, end = Reading(run).span
    if not run.completed or run.scene.warms:
        return begin, end - begin
    first = (float(run["crank_angle"][0]) - run.scene.start_angle) / (2.0 * np.pi)
    settle = max(run.scene.settle_revolutions - first, 0.0)
    return round(first + settle, 9) + 0.0, run.scene.revolutions - settle


def _restrict(label: str, run: Result, begin: float, end: float) -> Result:
    """Return a run that is read from these revolutions, without errors."""
    if "figures" in run.info:
        raise InputError(
            f"{label}: has kept its figures alone, which cannot be read from other revolutions; "
            f"{CURE}"
        )
    angle = run.scene.start_angle + 2.0 * np.pi * end
    record = up_to(run, float(np.interp(angle, run["crank_angle"], run.time)))
    info: Any = {**run.info, "horizon": None}
    info.pop("errors", None)
    scene = run.scene.replace({"settle": begin, "revolutions": end})
    return replace(record, scene=scene, info=info)
