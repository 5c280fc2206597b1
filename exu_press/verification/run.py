"""A run with the errors of its figures."""

import warnings
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np

from exu_press.errors import DiskFullError
from exu_press.integrate import SolverStatus
from exu_press.model.state import State
from exu_press.quantities import Extreme, Quantity, QuantityAt, quantities_of
from exu_press.quantities.kind import RESULTANT, SHARE
from exu_press.quantities.value import numbers_of
from exu_press.result import Result
from exu_press.result.info import Error, Errors
from exu_press.result.run import run_once
from exu_press.result.windows import at_instant, settled_part, up_to, window
from exu_press.scene import Scene, mechanism_of
from exu_press.verification.divergence import Divergence, divergence
from exu_press.verification.drift import earlier, warmed_on
from exu_press.verification.estimate import converging, of_both, scattered
from exu_press.verification.reading import overshot, smoothed, turned, unbalanced
from exu_press.verification.refinement import RefinementRuns, plan

__all__ = ["errors_of", "simulate_with_errors", "with_errors"]

Numbers = Mapping[float, Mapping[str, float]]
"""Quantities of the run and its refinements, by the ratio of their tolerance to the run's."""

OF_THE_START = 1e-4
"""Least error of loads over themselves where all runs agree: they are from the start then, and what
the first step leaves of accelerations is in all of them."""

OF_READING = 0.75
"""Part of the loss of a quantity by averaging with its neighbours: a peak between steps may be
higher by half of it, one of alternating loads is too high by all of it."""

OF_FLOOR = 3.0
"""Times the least error of a kind: with a smaller error a figure that is nothing is known."""

LATE, INSTANTS = 0.5, 16
"""From this part of a run on, and at so many instants: what swings while surfaces meet, as the
stored energy does, may be as in the other runs at one instant by chance."""

SAME = 1e-9
"""Relative: a figure that has changed by less since the horizon is one from before it."""


def simulate_with_errors(
    scene: Scene,
    *,
    start: State | None = None,
    unfinished: Path | None = None,
    quiet: bool = True,
    beside: bool = True,
    interruptible: bool = False,
) -> Result:
    """Simulate, with refinement runs.

    Args:
        scene: to be simulated.
        start: state of another run, from which this one and its refinements go on.
        unfinished: directory in which the run is while it goes on, see `simulate`.
        quiet: False shows the progress.
        beside: the refinements run in a further process meanwhile; else in this one afterwards, as
            where all cores have their runs already.
        interruptible: Ctrl-C raises KeyboardInterrupt; else it ends the run early, or leaves it
            without errors.

    Returns:
        The result; `info` and summary have `errors`, quantity by quantity, `horizon` and
        `lyapunov_exponent` too. Of a run that stopped early, or was stopped, nothing is known.
    """
    if scene.warms or not beside:  # refinements of films have as many revolutions as they settle in
        run = run_once(scene, start=start, unfinished=unfinished, quiet=quiet, settling=True)
        return with_errors(run, start=start, beside=beside)
    with RefinementRuns(scene, start) as refinements:
        run = run_once(scene, start=start, unfinished=unfinished, quiet=quiet)
        if interruptible and run.info["status"] == SolverStatus.INTERRUPTED.value:
            raise KeyboardInterrupt
        return _beside(run, refinements, interruptible=interruptible)


def with_errors(result: Result, *, start: State | None = None, beside: bool = True) -> Result:
    """Return a result with the errors of its figures, by refinement runs of its scene.

    Args:
        result: of a run.
        start: state of another run from which it went on.
        beside: the refinements run in a further process, else in this one.
    """
    if not result.completed:
        return _told(result, ())
    if not beside:
        runs = ((r, run_once(scene, start=start)) for r, scene in plan(result.scene).items())
        return _told(result, runs)
    with RefinementRuns(result.scene, start) as refinements:
        return _beside(result, refinements)


def _beside(result: Result, refinements: RefinementRuns, *, interruptible: bool = False) -> Result:
    """Return a result with its errors; the run itself is kept without, if refinements have failed.

    A warning says why, or the reason of the result where a disk is full.
    """
    try:
        return _told(result, refinements.results() if result.completed else ())
    except DiskFullError as error:
        without = _told(result, ())
        reason = f"no errors of the quantities are known: {error}"
        return replace(without, info={**without.info, "reason": reason})
    except (RuntimeError, KeyboardInterrupt) as error:
        if interruptible and isinstance(error, KeyboardInterrupt):
            raise
        why = "interrupted" if isinstance(error, KeyboardInterrupt) else str(error)
        warnings.warn(f"no errors of the quantities are known: {why}", stacklevel=3)
        return _told(result, ())


def _told(result: Result, refinements: Iterable[tuple[float, Result]]) -> Result:
    """Return a result that tells its errors."""
    return replace(result, info={**result.info, **errors_of(result, refinements)})


def errors_of(
    result: Result,
    refinements: Iterable[tuple[float, Result]],
    declared: Mapping[str, QuantityAt] | None = None,
) -> Errors:
    """Return a summary's entries of errors.

    Refinement runs that stopped before the run itself did are left out; without any nothing is
    known.

    Args:
        result: of a run.
        refinements: the same at other tolerances or steps, after their ratio to its own; the least
            ratio, whose run is the nearest one, is first.
        declared: quantities by name; those of the scene unless told.
    """
    if declared is None:
        declared = quantities_of(result.scene)
    told = {name: one for name, one in declared.items() if one.quantity.kind.has_error}

    def read(run: Result) -> dict[str, float]:
        return numbers_of(run, told)

    end = float(result.time[-1])
    complete = {r: up_to(run, end) for r, run in refinements if run.time[-1] >= end * (1.0 - 1e-9)}
    if not complete:
        return {"errors": {}, "horizon": None, "lyapunov_exponent": None}
    diverged = divergence(result, complete)
    horizon = end if diverged.growth.horizon is None else diverged.growth.horizon
    runs = {1.0: result, **complete}
    by_end = {t: {r: read(up_to(run, t)) for r, run in runs.items()} for t in {end, horizon}}
    parted = horizon < end
    after = {r: read(window(run, horizon, end)) for r, run in runs.items()} if parted else {}
    ways = (
        (OF_READING, smoothed),
        (OF_READING, overshot),
        (1.0, turned),
        (1.0, unbalanced),
        (1.0, earlier),
        (1.0, warmed_on),
    )
    reads = [(part, read(changed(result))) for part, changed in ways]
    before = by_end[horizon]
    swings = {name: one for name, one in told.items() if _swings(one.quantity)}
    late = _late(runs, horizon, swings) if diverged.distances else []
    errors: dict[str, Error] = {}
    sizes = _sizes(by_end[end][1.0], told)
    arm = mechanism_of(result.scene).size
    for name, value in by_end[end][1.0].items():
        left_open = max(part * abs(value - changed[name]) for part, changed in reads)
        quantity = told[name].quantity
        least = _least(
            quantity, [found[name] for found in by_end[end].values() if name in found], sizes, arm
        )
        left_open += quantity.of_laws(result.scene, told[name].at, value)
        told_values = by_end[end], [before, *late] if name in swings else [before], after
        error = _error(name, quantity.extreme, *told_values, least + left_open, diverged)
        if value >= 0.0 and not quantity.signed:
            error["low"] = max(error["low"], 0.0)
            known = error["error"] <= max(value, OF_FLOOR * least)
            error["determined"] &= known or quantity.kind.may_vanish
        if quantity.kind is SHARE:
            error["high"] = min(error["high"], 1.0)
        errors[name] = error
    for name, error in errors.items():
        above = errors.get(told[name].quantity.at_most)
        if above is not None:
            value = by_end[end][1.0][name]
            error["high"] = max(min(error["high"], above["high"]), value)
            error["error"] = max(error["high"] - value, value - error["low"])
    return {
        "errors": errors,
        "horizon": diverged.growth.horizon,
        "lyapunov_exponent": diverged.growth.rate,
    }


def _error(
    name: str,
    extreme: Extreme,
    now: Numbers,
    before: Sequence[Numbers],
    after: Numbers,
    least: float,
    diverged: Divergence,
) -> Error:
    """Return the error of a quantity.

    Until the horizon an extreme is known, however large the refinements' ones are then; beyond it
    anything is possible that scatters as they do.

    Args:
        name: of the quantity.
        extreme: of what it is an extreme.
        now: of the whole motion.
        before: of the motion until the horizon, where there is one, and until instants before it,
            of which the largest error counts.
        after: of the motion from then on.
        least: least error.
        diverged: how the run has parted from its refinements.
    """
    values = {ratio: found[name] for ratio, found in now.items() if name in found}
    if len(values) < 2:
        return scattered([values[1.0], 0.0])
    begun, *earlier = [{r: found[r].get(name, np.nan) for r in values} for found in before]
    later = {r: found.get(name, np.nan) for r, found in after.items() if r in values}
    swung = [list(found.values()) for found in earlier]
    known = converging(list(begun.values()), list(values), least, diverged.nearest, swung)
    shares = [diverged.distances.get(r, 1.0) for r in values if r != 1.0]
    if later and _is_of_both(extreme, values, begun, later):
        beyond = scattered(list(later.values()), least, shares)
        return of_both(values[1.0], known, beyond, extreme)
    if all(abs(begun[r] - value) <= SAME * abs(value) for r, value in values.items()):
        return known
    return scattered(list(values.values()), least, shares)


def _swings(quantity: Quantity) -> bool:
    """Return whether a quantity is a sum so far that goes up and down."""
    return quantity.cumulative and quantity.signed


def _late(
    runs: Mapping[float, Result], horizon: float, swings: Mapping[str, QuantityAt]
) -> list[Numbers]:
    """Return quantities at instants late in what they are read from, before the horizon (s)."""
    parts = {ratio: settled_part(run) for ratio, run in runs.items()}
    begin, end = parts[1.0].time[0], min(parts[1.0].time[-1], horizon)
    if end <= begin or min(len(part.time) for part in parts.values()) < 4:
        return []
    instants = np.linspace(begin + LATE * (end - begin), end, INSTANTS, endpoint=False)
    return [
        {ratio: numbers_of(at_instant(part, instant), swings) for ratio, part in parts.items()}
        for instant in instants
    ]


def _is_of_both(
    extreme: Extreme,
    values: Mapping[float, float],
    begun: Mapping[float, float],
    later: Mapping[float, float],
) -> bool:
    """Return whether a quantity is the extreme of its values in two parts of every run."""
    found: Callable[[float, float], float] = max if extreme is Extreme.LARGEST else min
    return extreme is not Extreme.NONE and all(
        abs(found(begun[r], later[r]) - value) <= SAME * abs(value) for r, value in values.items()
    )


def _sizes(
    values: Mapping[str, float], told: Mapping[str, QuantityAt]
) -> dict[tuple[str, Extreme], float]:
    """Return the largest value of each unit and extreme in a run; what cancels is left out."""
    found: dict[tuple[str, Extreme], float] = {}
    for name, value in values.items():
        quantity = told[name].quantity
        if quantity.kind is not RESULTANT:
            which = quantity.unit, quantity.extreme
            found[which] = max(found.get(which, 0.0), abs(value))
    return found


def _least(
    quantity: Quantity,
    values: Sequence[float],
    sizes: Mapping[tuple[str, Extreme], float],
    arm: float,
) -> float:
    """Return the least error of a quantity, in its unit.

    Args:
        quantity: as it is declared.
        values: of it, in all runs; the run's own first.
        sizes: the largest values of the run, by their units and extremes.
        arm: size of the mechanism, m.
    """
    if not any(values):
        return 0.0
    kind, size = quantity.kind, abs(values[0])
    relative = kind.relative
    if kind.from_accelerations and max(values) - min(values) <= kind.relative * size:
        relative = OF_THE_START
    largest = kind.of_largest * sizes.get((quantity.unit, quantity.extreme), 0.0)
    forces = kind.of_forces * arm * sizes.get(("N", Extreme.LARGEST), 0.0)
    return max(relative * size, kind.absolute, largest, forces)
