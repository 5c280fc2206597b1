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
from exu_press.quantities.joints import IMPACTS
from exu_press.quantities.kind import COUNT, RESULTANT, SHARE
from exu_press.quantities.reading import Reading
from exu_press.quantities.value import numbers_of
from exu_press.result import Result
from exu_press.result.info import Error, Errors
from exu_press.result.run import run_once
from exu_press.result.windows import at_instant, settled_part, up_to, window
from exu_press.scene import Scene, mechanism_of
from exu_press.verification.divergence import Divergence, divergence
from exu_press.verification.estimate import (
    OF_COUNTS,
    convergent_error,
    error_ratio,
    extreme_over_parts,
    prediction_interval,
    whole_error,
)
from exu_press.verification.impacts import are_doubtful
from exu_press.verification.reading import (
    add_energy_residual,
    add_start_overshoot,
    add_work_between_steps,
    average_neighbours,
    enlarge_reversing_forces,
    read_a_revolution_earlier,
    with_next_temperatures,
)
from exu_press.verification.refinement import RefinementRuns, plan

__all__ = ["errors_of", "largest_values", "simulate_with_errors", "with_errors"]

Finished = Callable[[Result], object]

Numbers = Mapping[float, Mapping[str, float]]
"""Quantities of the run and its refinements, by the ratio of their errors to the run's."""

OF_THE_START = 1e-4
"""Least relative error of loads where all runs agree: they are then those of the start, whose error
all runs share."""

OF_READING = 0.75
"""Part of the change by averaging with neighbours: a peak between steps may be higher by half of
it, one of alternating loads is too high by all of it."""

OF_FLOOR = 3.0
"""Least errors of a kind: with a smaller error a quantity that is zero is known."""

LATE, INSTANTS = 0.5, 16
"""Part of a run from which on, and number of instants at which, oscillating sums are compared: one
instant may agree with the other runs by chance."""

SAME = 1e-9
"""Relative change since the horizon below which a quantity is one from before it."""


READINGS = (
    (OF_READING, average_neighbours),
    (OF_READING, add_start_overshoot),
    (1.0, enlarge_reversing_forces),
    (1.0, add_energy_residual),
    (1.0, add_work_between_steps),
    (1.0, read_a_revolution_earlier),
    (1.0, with_next_temperatures),
)
"""Weight of a reading's difference in the error -> the run read that way."""


def simulate_with_errors(
    scene: Scene,
    *,
    start: State | None = None,
    unfinished: Path | None = None,
    quiet: bool = True,
    beside: bool = True,
    interruptible: bool = False,
    finished: Finished = lambda run: None,
) -> Result:
    """Simulate, with refinement runs.

    Args:
        start: state of another run, from which this one and its refinements go on.
        unfinished: directory in which the run is while it goes on, see `simulate`.
        beside: the refinements run in a further process meanwhile; else in this one afterwards, as
            where all cores have their runs already.
        interruptible: Ctrl-C raises KeyboardInterrupt; else it ends the run early, or leaves it
            without errors.
        finished: called with the run before its errors are known, where these come beside it.

    Returns:
        The result; `info` and summary have `errors`, quantity by quantity, `horizon` and
        `lyapunov_exponent` too. Of a run that stopped early, or was stopped, nothing is known.
    """

    def first_run(*, settling: bool) -> Result:
        run = run_once(scene, start=start, unfinished=unfinished, quiet=quiet, settling=settling)
        if interruptible and run.info["status"] == SolverStatus.INTERRUPTED.value:
            raise KeyboardInterrupt
        return run

    if scene.warms or not beside:  # refinements of films have as many revolutions as they settle in
        run = first_run(settling=True)
        return with_errors(
            run, start=start, beside=beside, interruptible=interruptible, finished=finished
        )
    with RefinementRuns(scene, start) as refinements:
        run = first_run(settling=False)
        return _with_refinements(run, refinements, finished, interruptible=interruptible)


def with_errors(
    result: Result,
    *,
    start: State | None = None,
    beside: bool = True,
    interruptible: bool = False,
    finished: Finished = lambda run: None,
) -> Result:
    """Return a result with the errors of its figures, by refinement runs of its scene."""
    if not result.completed:
        return _with_errors_of(result, ())
    if not beside:
        runs = ((r, run_once(scene, start=start)) for r, scene in plan(result.scene).items())
        return _with_errors_of(result, runs)
    with RefinementRuns(result.scene, start) as refinements:
        return _with_refinements(result, refinements, finished, interruptible=interruptible)


def _with_refinements(
    result: Result, refinements: RefinementRuns, finished: Finished, *, interruptible: bool
) -> Result:
    """Return a result with its errors, or without any if refinements failed.

    A warning says why, or the result's reason where a disk is full.
    """
    try:
        finished(result)
        return _with_errors_of(result, refinements.results() if result.completed else ())
    except DiskFullError as error:
        without = _with_errors_of(result, ())
        reason = f"no errors of the quantities are known: {error}"
        return replace(without, info={**without.info, "reason": reason})
    except (RuntimeError, KeyboardInterrupt) as error:
        if interruptible and isinstance(error, KeyboardInterrupt):
            raise
        why = "interrupted" if isinstance(error, KeyboardInterrupt) else str(error)
        warnings.warn(f"no errors of the quantities are known: {why}", stacklevel=3)
        return _with_errors_of(result, ())


def _with_errors_of(result: Result, refinements: Iterable[tuple[float, Result]]) -> Result:
    return replace(result, info={**result.info, **errors_of(result, refinements)})


def errors_of(
    result: Result,
    refinements: Iterable[tuple[float, Result]],
    declared: Mapping[str, QuantityAt] | None = None,
) -> Errors:
    """Return a summary's entries of errors.

    Refinement runs that stopped before the run itself are left out; without any, no error is known.

    Args:
        refinements: ratio of tolerances or steps to the run's own, and the run; the least ratio,
            whose run is the nearest one, is first.
        declared: quantities by name; those of the scene if None.
    """
    declared = quantities_of(result.scene) if declared is None else declared
    declared = {name: q for name, q in declared.items() if q.quantity.kind.has_error}
    end = float(result.time[-1])
    complete = {
        error_ratio(result.scene, r): up_to(run, end)
        for r, run in refinements
        if run.time[-1] >= end * (1.0 - 1e-9)
    }
    if not complete:
        return {"errors": {}, "horizon": None, "lyapunov_exponent": None}
    diverging = divergence(result, complete)
    horizon = end if diverging.growth.horizon is None else diverging.growth.horizon
    runs = {1.0: result, **complete}
    whole = {r: numbers_of(run, declared) for r, run in runs.items()}
    until_horizon, beyond_horizon = whole, {}
    if horizon < end:
        until_horizon = {r: numbers_of(up_to(run, horizon), declared) for r, run in runs.items()}
        later = {r: window(run, horizon, end) for r, run in runs.items()}
        beyond_horizon = {r: numbers_of(run, declared) for r, run in later.items()}
    rereadings = [(weight, numbers_of(read(result), declared)) for weight, read in READINGS]
    sums = {name: q for name, q in declared.items() if q.quantity.cumulative}
    oscillating = {name: q for name, q in sums.items() if q.quantity.signed}
    late = _late_values(runs, horizon, oscillating) if diverging.distances else []
    sizes, arm = largest_values(whole[1.0], declared), mechanism_of(result.scene).size
    errors: dict[str, Error] = {}
    settled = settled_part(result)
    for name, value in whole[1.0].items():
        quantity = declared[name].quantity
        of_all_runs = [values[name] for values in whole.values() if name in values]
        least = _least_error(quantity, of_all_runs, sizes, arm)
        reading = max(weight * abs(value - values[name]) for weight, values in rereadings)
        reading += quantity.law_error(result.scene, declared[name].owner, value)
        begin = [until_horizon, *late] if name in oscillating else [until_horizon]
        error = _error(name, quantity, whole, begin, beyond_horizon, least + reading, diverging)
        if quantity.kind is COUNT:
            is_impacts = quantity.name == IMPACTS.name
            doubtful = is_impacts and are_doubtful(declared[name].owner, settled, complete)
            error = whole_error(value, error, doubtful)
        if value >= 0.0 and not quantity.signed:
            error["low"] = max(error["low"], 0.0)
            is_known = error["error"] <= max(value, OF_FLOOR * least)
            error["determined"] &= is_known or quantity.kind.may_vanish
        if quantity.kind is SHARE:
            error["high"] = min(error["high"], 1.0)
        errors[name] = error
    for name, error in errors.items():
        upper = errors.get(declared[name].quantity.upper_bound)
        if upper is not None:
            value = whole[1.0][name]
            error["high"] = max(min(error["high"], upper["high"]), value)
            error["error"] = max(error["high"] - value, value - error["low"])
    return {
        "errors": errors,
        "horizon": diverging.growth.horizon,
        "lyapunov_exponent": diverging.growth.rate,
    }


def _error(
    name: str,
    quantity: Quantity,
    whole: Numbers,
    until_horizon: Sequence[Numbers],
    beyond_horizon: Numbers,
    least: float,
    diverging: Divergence,
) -> Error:
    """Return the error of a quantity.

    Until the horizon an extreme is known, however large the refinements' ones are later; beyond it
    any value is possible that scatters as theirs do.

    Args:
        until_horizon: values until the horizon, and until instants before it; the largest error
            counts.
        beyond_horizon: values from the horizon on, if there is one.
    """
    values = {ratio: numbers[name] for ratio, numbers in whole.items() if name in numbers}
    if len(values) < 2:
        return prediction_interval([values[1.0], 0.0])
    first, *instants = [
        {r: numbers[r].get(name, np.nan) for r in values} for numbers in until_horizon
    ]
    second = {r: n.get(name, np.nan) for r, n in beyond_horizon.items() if r in values}
    convergent = convergent_error(
        list(first.values()),
        list(values),
        least,
        diverging.nearest,
        [list(numbers.values()) for numbers in instants],
    )
    distances = [diverging.distances.get(r, 1.0) for r in values if r != 1.0]
    extreme = quantity.extreme
    if second and _is_extreme_over_parts(extreme, values, first, second):
        interval = prediction_interval(list(second.values()), least, distances)
        return extreme_over_parts(values[1.0], convergent, interval, extreme)
    if all(abs(first[r] - value) <= SAME * abs(value) for r, value in values.items()):
        return convergent
    scatter = OF_COUNTS if quantity.kind is COUNT and quantity.cumulative else 0.0
    return prediction_interval(list(values.values()), least, distances, scatter=scatter)


def _late_values(
    runs: Mapping[float, Result], horizon: float, declared: Mapping[str, QuantityAt]
) -> list[Numbers]:
    """Return quantities at INSTANTS late in the settled part, before the horizon (s).

    None of whole revolutions, at whose ends no energy is lent: sums there are as exact as those per
    stroke, and errors within a stroke are larger.
    """
    parts = {ratio: settled_part(run) for ratio, run in runs.items()}
    begin, end = parts[1.0].time[0], min(parts[1.0].time[-1], horizon)
    whole = Reading(runs[1.0]).whole
    if end <= begin or whole == begin or min(len(run.time) for run in parts.values()) < 4:
        return []
    instants = np.linspace(begin + LATE * (end - begin), end, INSTANTS, endpoint=False)
    return [
        {ratio: numbers_of(at_instant(run, instant), declared) for ratio, run in parts.items()}
        for instant in instants
    ]


def _is_extreme_over_parts(
    extreme: Extreme,
    values: Mapping[float, float],
    first: Mapping[float, float],
    second: Mapping[float, float],
) -> bool:
    """Return whether a quantity is the extreme of its values in two parts of every run."""
    extreme_of: Callable[[float, float], float] = max if extreme is Extreme.LARGEST else min
    return extreme is not Extreme.NONE and all(
        abs(extreme_of(first[r], second[r]) - value) <= SAME * abs(value)
        for r, value in values.items()
    )


def largest_values(
    values: Mapping[str, float], declared: Mapping[str, QuantityAt]
) -> dict[tuple[str, Extreme], float]:
    """Return the largest value of each unit and extreme in a run, but for sums that cancel."""
    sizes: dict[tuple[str, Extreme], float] = {}
    for name, value in values.items():
        quantity = declared[name].quantity
        if quantity.kind is not RESULTANT:
            key = quantity.unit, quantity.extreme
            sizes[key] = max(sizes.get(key, 0.0), abs(value))
    return sizes


def _least_error(
    quantity: Quantity,
    values: Sequence[float],
    sizes: Mapping[tuple[str, Extreme], float],
    arm: float,
) -> float:
    """Return the least error of a quantity, in its unit."""
    if not any(values):
        return 0.0
    kind, size = quantity.kind, abs(values[0])
    relative = kind.relative
    if kind.from_accelerations and max(values) - min(values) <= kind.relative * size:
        relative = OF_THE_START
    largest = kind.of_largest * sizes.get((quantity.unit, quantity.extreme), 0.0)
    forces = kind.of_forces * arm * sizes.get(("N", Extreme.LARGEST), 0.0)
    return max(relative * size, kind.absolute, largest, forces)
