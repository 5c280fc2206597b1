"""Runs at finer tolerances while headline quantities have large errors."""

import time
from collections.abc import Callable, Iterator
from pathlib import Path

from exu_press.model.state import State
from exu_press.quantities import quantities_of, values_of
from exu_press.quantities.value import numbers_of
from exu_press.result import Result
from exu_press.scene import Scene
from exu_press.verification.run import largest_values, simulate_with_errors

__all__ = ["doubtful", "negligible", "refinements"]

ENOUGH = 0.05
"""Largest relative error of a headline quantity that needs no finer run."""

OF_LARGEST = 0.02
"""Part of a required error, times the largest figure of a kind: a smaller error leaves a figure
known, as that of an energy which is dissipated beside what is exchanged. Ideal joints dissipate
rounding."""

FINER = 4.0
"""Factor from one tolerance to the next finer one."""

LONGER = 2.0
"""Time of a run at the next finer tolerance over that of the last one."""

BUDGET = 3.0
"""Time of all finer runs over that of the first one, at most."""

FINEST = 1e-6


def doubtful(result: Result) -> list[str]:
    """Return the headline quantities that are not determined, or known to worse than ENOUGH."""
    values, known = values_of(result), negligible(result, ENOUGH)
    names = []
    for name, placed in quantities_of(result.scene).items():
        value, looked_at = values[name], placed.quantity.headline and name not in known
        if looked_at and value.value and value.error is not None:
            is_known = value.determined and value.error <= ENOUGH * abs(value.value)
            names += [] if is_known else [name]
    return names


def negligible(result: Result, required: float) -> set[str]:
    """Return the quantities with an error below OF_LARGEST of a required relative one.

    It is relative to the largest figure of the unit, an extreme to the largest extreme.
    """
    declared, names = quantities_of(result.scene), set()
    largest = largest_values(numbers_of(result, declared), declared)
    for name, stated in result.info["errors"].items():
        quantity = declared[name].quantity
        size = largest.get((quantity.unit, quantity.extreme), 0.0)
        if stated["error"] <= OF_LARGEST * required * size:
            names.add(name)
    return names


def refinements(
    scene: Scene,
    *,
    start: State | None = None,
    unfinished: Path | None = None,
    quiet: bool = True,
    announce: Callable[[str], None] = lambda text: None,
    finished: Callable[[Result], object] = lambda run: None,
) -> Iterator[tuple[Result, str]]:
    """Run a scene, and again at finer tolerances while that helps and the budget lasts.

    Yields each result with advice, or an empty text. A finer run that stops early does not replace
    the one before it.

    Args:
        start: state of another run, from which it goes on.
        unfinished: directory in which the first run is while it goes on, see `simulate`; it stays
            there, while finer ones go to a temporary directory.
        announce: is called before a finer run begins, with why, and how long it may take.
        finished: is called with each run before its errors are known.

    Raises:
        KeyboardInterrupt: of Ctrl-C in a finer run; the results before have been yielded.
    """
    begin = time.perf_counter()
    result = simulate_with_errors(
        scene, start=start, unfinished=unfinished, quiet=quiet, finished=finished
    )
    duration = first_duration = time.perf_counter() - begin
    spent = 0.0
    while result.completed and (names := doubtful(result)):
        doubts = f"{names[0]}{f' and {len(names) - 1} more' if len(names) > 1 else ''}"
        unknown = f"{doubts}: not known within {ENOUGH:.0%}"
        solver = result.scene.solver
        if solver.tolerance is None or solver.tolerance <= FINEST:
            yield result, f"{unknown} with these steps"
            return
        finer = max(solver.tolerance / FINER, FINEST)
        if spent + LONGER * duration > BUDGET * first_duration:
            yield (
                result,
                f"{unknown}; a tolerance of {finer:.2g} (--set solver.tolerance={finer:.2g}) takes "
                f"about {LONGER * duration:.2g} s, and --within {ENOUGH:.0%} finds the tolerance, "
                "or the distribution over revolutions",
            )
            return
        yield result, ""
        announce(
            f"{unknown}; goes on at a tolerance of {finer:.2g}, which may take "
            f"{LONGER * duration:.2g} s; Ctrl-C ends that and keeps the finished run"
        )
        started = time.perf_counter()
        repeated = simulate_with_errors(
            scene.replace({"solver.tolerance": finer}),
            start=start,
            quiet=quiet,
            interruptible=True,
            finished=finished,
        )
        if not repeated.completed:
            reason = repeated.info["reason"]
            yield result, f"{unknown}; at a tolerance of {finer:.2g} the run stops: {reason}"
            return
        result = repeated
        duration = time.perf_counter() - started
        spent += duration
    yield result, ""
