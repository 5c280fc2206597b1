"""A run whose headline quantities are not known well goes on at a finer tolerance."""

import time
from collections.abc import Callable, Iterator
from pathlib import Path

from exu_press.model.state import State
from exu_press.quantities import quantities_of, values_of
from exu_press.result import Result
from exu_press.scene import Scene
from exu_press.verification.run import simulate_with_errors

__all__ = ["doubtful", "refinements"]

ENOUGH = 0.05
"""Relative error of a quantity: with a larger one it is not known well."""

FINER = 4.0
"""A tolerance is made finer by this factor at a time."""

LONGER = 2.0
"""A run takes this much longer then."""

BUDGET = 3.0
"""Time that finer runs may take together, over that of the first one."""

FINEST = 1e-6


def doubtful(result: Result) -> list[str]:
    """Return the headline quantities that are not determined, or known to worse than ENOUGH."""
    values = values_of(result)
    found = []
    for name, placed in quantities_of(result.scene).items():
        value = values[name]
        if placed.quantity.headline and value.value and value.error is not None:
            known = value.determined and value.error <= ENOUGH * abs(value.value)
            found += [] if known else [name]
    return found


def refinements(
    scene: Scene,
    *,
    start: State | None = None,
    unfinished: Path | None = None,
    quiet: bool = True,
    announce: Callable[[str], None] = lambda text: None,
) -> Iterator[tuple[Result, str]]:
    """Run a scene, and again at finer tolerances while that helps and the budget lasts.

    Yields each result, with what the user may do in the end, or an empty text. A finer run that
    stops early does not replace the one before it.

    Args:
        scene: to be simulated.
        start: state of another run, from which it goes on.
        unfinished: directory in which the first run is while it goes on, see `simulate`; it stays
            there, while finer ones go to a temporary directory.
        quiet: False shows the progress.
        announce: is called before a finer run begins, with why, and how long it may take.

    Raises:
        KeyboardInterrupt: of Ctrl-C in a finer run; the results before have been yielded.
    """
    begin = time.perf_counter()
    result = simulate_with_errors(scene, start=start, unfinished=unfinished, quiet=quiet)
    took = first = time.perf_counter() - begin
    spent = 0.0
    while result.completed and (names := doubtful(result)):
        which = f"{names[0]}{f' and {len(names) - 1} more' if len(names) > 1 else ''}"
        unknown = f"{which}: not known within {ENOUGH:.0%}"
        solver = result.scene.solver
        assert solver is not None
        if solver.tolerance is None or solver.tolerance <= FINEST:
            yield result, f"{unknown} with these steps"
            return
        finer = max(solver.tolerance / FINER, FINEST)
        if spent + LONGER * took > BUDGET * first:
            yield (
                result,
                f"{unknown}; a tolerance of {finer:.2g} (--set solver.tolerance={finer:.2g}) takes "
                f"about {LONGER * took:.2g} s, and --within {ENOUGH:.0%} finds the tolerance, or "
                "the distribution over revolutions",
            )
            return
        yield result, ""
        announce(
            f"{unknown}; goes on at a tolerance of {finer:.2g}, which may take "
            f"{LONGER * took:.2g} s; Ctrl-C ends that and keeps the finished run"
        )
        before = time.perf_counter()
        again = simulate_with_errors(
            scene.replace({"solver.tolerance": finer}), start=start, quiet=quiet, interruptible=True
        )
        if not again.completed:
            reason = again.info["reason"]
            yield result, f"{unknown}; at a tolerance of {finer:.2g} the run stops: {reason}"
            return
        result = again
        took = time.perf_counter() - before
        spent += took
    yield result, ""
