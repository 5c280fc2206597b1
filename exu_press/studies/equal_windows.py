"""Runs that are read from the same revolutions."""

import warnings
from collections.abc import Iterator, Mapping
from dataclasses import replace
from typing import Any

import numpy as np

from exu_press.errors import InputError
from exu_press.quantities.reading import Reading
from exu_press.result import Result
from exu_press.result.windows import NEARLY, interpolated_window, whole_revolutions
from exu_press.scene import Scene
from exu_press.verification.side_by_side import simulate_side_by_side

__all__ = ["require_common_window", "simulate_equal_windows", "with_equal_windows"]

CURE = "compare runs of the same settle (above 0 where a motor's crank lags) and revolutions"

Span = tuple[float, float]
"""First and last revolution that are read."""


def require_common_window(items: Mapping[str, Scene | Result]) -> None:
    """Raise InputError unless scenes and results by label have revolutions in common."""
    _common_span(
        {
            label: (item.settle_revolutions, item.revolutions)
            if isinstance(item, Scene)
            else Reading(item).span
            for label, item in items.items()
        }
    )


def simulate_equal_windows(
    scenes: Mapping[str, Scene], *, errors: bool = True, quiet: bool = True
) -> Iterator[tuple[str, Result]]:
    """Yield label and result of each scene, as `simulate_side_by_side` does.

    Scenes whose oil warms are first: where revolutions are added until films have settled, all
    other scenes with a `settle` get as many, with a warning, so that all are read from the same.
    A scene whose films have settled in fewer comes again.
    """
    warming = {label: scene for label, scene in scenes.items() if scene.warms}
    added: dict[str, int] = {}
    for label, run in simulate_side_by_side(warming, errors=errors, quiet=quiet):
        added[label] = run.info.get("added_revolutions", 0)
        yield label, run
    most = max(added.values(), default=0)
    remaining = {label: scene for label, scene in scenes.items() if added.get(label) != most}
    longer = {
        label: scene.read_later(most)
        for label, scene in remaining.items()
        if most and scene.settle_revolutions
    }
    if longer:
        warnings.warn(
            f"{', '.join(longer)}: {most} revolution{'s' * (most > 1)} more than asked for, as "
            "films of the runs beside them settle in as many",
            stacklevel=2,
        )
    yield from simulate_side_by_side(remaining | longer, errors=errors, quiet=quiet)


def with_equal_windows(results: Mapping[str, Result]) -> tuple[Mapping[str, Result], str]:
    """Return runs by label that are read from the same revolutions, and what was cut for that.

    The text is empty where nothing was. Of runs that are cut the errors of figures are not known.
    Presses that start or stop, each in as many revolutions as it takes, are read to their ends.

    Raises:
        InputError: the runs have no revolutions in common, or one of them has kept no channels.
    """
    spans = {label: Reading(result).span for label, result in results.items()}
    asked = [_asked_span(run) for run in results.values()]
    if asked[0] is not None and all(span == asked[0] for span in asked):
        return results, ""
    begin, end = common = _common_span(spans)
    cut = [label for label, span in spans.items() if not np.allclose(span, common, 0.0, NEARLY)]
    if not cut:
        return results, ""
    text = (
        f"The runs have different windows: figures are read from revolutions {begin:.4g} to "
        f"{end:.4g}, which all have. Errors of {', '.join(cut)} are not known, as these are cut. "
        f"For errors, {CURE}."
    )
    return {
        label: _restrict(label, run, begin, end) if label in cut else run
        for label, run in results.items()
    }, text


def _common_span(spans: Mapping[str, Span]) -> Span:
    """Return the revolutions that all runs by label have; whole ones behind a settled start."""
    begin, end = max(begin for begin, _ in spans.values()), min(end for _, end in spans.values())
    if end - begin < NEARLY:
        texts = [
            f"{label} is read from {first:g} to {last:g}" for label, (first, last) in spans.items()
        ]
        raise InputError(f"the runs have no revolutions in common: {', '.join(texts)}; {CURE}")
    if begin < NEARLY:
        return 0.0, end
    whole = whole_revolutions(end - begin)
    return begin, begin + whole if whole else end


def _asked_span(run: Result) -> Span | None:
    """Return the revolutions that are asked of a press that starts or stops, None of others."""
    reading = Reading(run)
    if not reading.starts_or_stops or not run.completed:
        return None
    first = reading.span[0]
    return first, first + run.scene.revolutions


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
