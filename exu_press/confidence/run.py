"""A run with the errors of its figures."""

import warnings
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import replace

import numpy as np

from exu_press.confidence.companions import Companions, plan
from exu_press.confidence.estimate import (
    AMPLIFIED,
    ROUNDING,
    SAFETY,
    SAFETY_OF_STEPS,
    converging,
    scattered,
)
from exu_press.confidence.figures import figures
from exu_press.confidence.parting import Parting, parting
from exu_press.confidence.reading import LOADS, overshot, smoothed, unbalanced
from exu_press.confidence.windows import until, window
from exu_press.result import Result
from exu_press.result.info import Error, Errors
from exu_press.scene import Scene
from exu_press.simulation import simulate

__all__ = ["errors_of", "simulate_with_errors", "with_errors"]

Figures = Mapping[float, Mapping[str, float]]
"""Of the run and its companions, by the ratio of their tolerance to the run's."""

OF_LOADS = 1e-5
"""Least error of figures that follow from accelerations, over themselves."""

OF_THE_START = 1e-4
"""The same where all runs agree to OF_LOADS: the figure is from the start then, and what the first
step leaves of accelerations is in all of them."""

OF_READING = 0.75
"""Of what averaging with the neighbours takes of a figure: a peak between steps may be higher by
half of it, one of alternating loads is too high by all of it."""

OF_SHARES = 1e-4
"""Least error of a share of time: touches are told apart by steps, which in free flight are the
longest ones allowed in all runs."""

OF_ENERGY = 1e-6
"""Least error of what is stored or dissipated, over the largest energy of the run's balance."""

OF_ARMS = 1e-7
"""Least error of a guide's moment over the largest force, m: balanced forces leave as much."""

OF_SUMS = 2e-8
"""Least error of a shaking force over the largest force: what cancels in the sum leaves as much in
steps of a microsecond, by the rounding of positions (1e-8 was measured at 1 rpm)."""

SIGNED = (
    *("bottom_dead_centre", "strokes.mean", "mean_torque", "mean_power"),
    *("energy.input", "energy.stored"),
)
"""Ends of the names of figures that may be below zero; others are magnitudes and counts."""

SAME = 1e-9
"""Relative: a figure that has changed by less since the horizon is one from before it."""


Read = Callable[[Result], Mapping[str, float]]
"""Returns the figures of a record, by name."""


def _of_summary(run: Result) -> dict[str, float]:
    """Return the figures of a run's summary."""
    return figures(run.summary())


def simulate_with_errors(scene: Scene, *, quiet: bool = True, beside: bool = True) -> Result:
    """Do what `simulate` does, with companion runs.

    Args:
        scene: what to simulate.
        quiet: False shows the progress.
        beside: the companions run in a further process meanwhile; else in this one afterwards, as
            where all cores have their runs already.

    Returns:
        The result; `info` and summary have `errors`, figure by figure, `errors_from` and
        `amplification` too. Of a run that stopped early, or was stopped, nothing is known.
    """
    if not beside:
        return with_errors(simulate(scene, quiet=quiet), beside=False)
    with Companions(scene) as companions:
        return _beside(simulate(scene, quiet=quiet), companions)


def with_errors(result: Result, *, beside: bool = True) -> Result:
    """Return a result with the errors of its figures, by companion runs of its scene.

    Args:
        result: of a run.
        beside: the companions run in a further process, else in this one.
    """
    if not result.completed:
        return _told(result, ())
    if not beside:
        return _told(result, ((r, simulate(scene)) for r, scene in plan(result.scene).items()))
    with Companions(result.scene) as companions:
        return _beside(result, companions)


def _beside(result: Result, companions: Companions) -> Result:
    """Return a result with its errors; without, with a warning, if the companions have failed."""
    try:
        return _told(result, companions.results() if result.completed else ())
    except RuntimeError as error:
        warnings.warn(f"no errors of the figures are known: {error}", stacklevel=3)
        return _told(result, ())


def _told(result: Result, companions: Iterable[tuple[float, Result]]) -> Result:
    """Return a result that tells its errors."""
    return replace(result, info={**result.info, **errors_of(result, companions)})


def errors_of(
    result: Result, companions: Iterable[tuple[float, Result]], read: Read = _of_summary
) -> Errors:
    """Return what a summary says of errors.

    Companions that stopped before the run itself did are left out; without any nothing is known.
    Each is read as it comes, while the next one may still be on its way.

    Args:
        result: of a run.
        companions: the same at other tolerances or steps, after their ratio to its own; the least
            ratio, whose run is the nearest one, is first.
        read: returns the figures of a record, by name; those of its summary unless told.
    """
    end = float(result.time[-1])
    parted: Parting | None = None
    by_end: dict[float, dict[float, Mapping[str, float]]] = {}
    after: dict[float, Mapping[str, float]] = {}
    for ratio, companion in companions:
        if companion.time[-1] < end * (1.0 - 1e-9):
            continue
        run = until(companion, end)
        if parted is None:
            parted = parting(result, run, ratio)
            beside, horizon = (
                end if instant is None else instant
                for instant in (parted.beside, parted.growth.horizon)
            )
            by_end = {at: {1.0: read(until(result, at))} for at in (end, beside, horizon)}
            after = {1.0: read(window(result, horizon, end))} if horizon < end else {}
            reads = [read(changed(result)) for changed in (smoothed, overshot, unbalanced)]
        for instant, found in by_end.items():
            found[ratio] = read(until(run, instant))
        if after:
            after[ratio] = read(window(run, horizon, end))
    if parted is None:
        return {"errors": {}, "errors_from": None, "amplification": None}
    solver = result.scene.solver
    safety = SAFETY if solver is not None and solver.step is None else SAFETY_OF_STEPS
    until_then = {safety: by_end[beside], AMPLIFIED * safety: by_end[horizon]}
    errors: dict[str, Error] = {}
    for name, value in by_end[end][1.0].items():
        left_open = max(abs(value - changed[name]) for changed in reads)
        errors[name] = told = _error(name, by_end[end], until_then, after, left_open)
        if value >= 0.0 and not name.endswith(SIGNED):
            told["low"] = max(told["low"], 0.0)
    return {
        "errors": errors,
        "errors_from": parted.growth.horizon,
        "amplification": parted.growth.rate,
    }


def _error(
    name: str, now: Figures, until_then: Mapping[float, Figures], after: Figures, read: float
) -> Error:
    """Return the error of a figure.

    Beyond the horizon, an extreme is that of the run continued as each companion goes on: what
    companions did before, where the run is right, does not widen its bounds.

    Args:
        name: of the figure.
        now: of the whole motion.
        until_then: safety of errors that go with the tolerance or the step -> the figures until the
            instant up to which it is enough; the last one is the horizon.
        after: of the motion from the horizon on, where there is one.
        read: what reading the figure at the run's steps leaves open.
    """
    values = {ratio: found[name] for ratio, found in now.items() if name in found}
    if len(values) < 2:
        return scattered([values[1.0], 0.0])
    least = _least(name, list(values.values()), now[1.0]) + OF_READING * read
    for safety, before in until_then.items():
        begun = {r: before[r].get(name, np.nan) for r in values}
        if all(abs(begun[r] - value) <= SAME * abs(value) for r, value in values.items()):
            return converging(list(values.values()), list(values), least, safety)
    later = {r: found.get(name, np.nan) for r, found in after.items() if r in values}
    extreme = _extreme(name, values, begun, later) if later else None
    if extreme is None:
        return scattered(list(values.values()), least)
    known = converging(list(begun.values()), list(values), least, safety)
    continued = [extreme(begun[1.0], value) for value in later.values()]
    of_before = abs(begun[1.0] - values[1.0]) <= SAME * abs(values[1.0])
    told = scattered(continued, known["error"] if of_before else least)
    if extreme is max:
        told["low"] = max(told["low"], known["low"])
    else:
        told["high"] = min(told["high"], known["high"])
    return told


def _extreme(
    name: str,
    values: Mapping[float, float],
    begun: Mapping[float, float],
    later: Mapping[float, float],
) -> Callable[[float, float], float] | None:
    """Return max or min, if the figure is that of its values in two parts of every run."""
    for extreme in (max, min):
        if not name.endswith(SIGNED) and all(
            abs(extreme(begun[r], later[r]) - value) <= SAME * abs(value)
            for r, value in values.items()
        ):
            return extreme
    return None


def _least(name: str, values: Sequence[float], run: Mapping[str, float]) -> float:
    """Return the least error of a figure, in its unit.

    Args:
        name: of the figure.
        values: of it, in all runs.
        run: all figures of the run.
    """
    size = abs(values[0])
    if not any(values):
        return 0.0
    if name.endswith(("dissipated", "stored")):
        energies = [abs(run[k]) for k in run if k.startswith("energy.")]
        return OF_ENERGY * max(energies, default=size)
    force = max((abs(run[k]) for k in run if k.endswith("peak_force")), default=0.0)
    if name.endswith("peak_moment"):
        return OF_ARMS * force
    if ".share_" in name:
        return OF_SHARES
    if not any(word in name for word in LOADS):
        return ROUNDING * size
    alike = max(values) - min(values) <= OF_LOADS * size
    of_sum = OF_SUMS * force if name.startswith("shaking.") else 0.0
    return max((OF_THE_START if alike else OF_LOADS) * size, of_sum)
