"""One scene, front to back."""

import time
from dataclasses import replace

from exu_press.model import build
from exu_press.model.state import State, go_on_from
from exu_press.result import Result, record
from exu_press.scene import Scene

__all__ = ["simulate"]


def simulate(scene: Scene, *, start: State | None = None, quiet: bool = True) -> Result:
    """Build a scene's model, advance it to its end or an early stop, and return what came out.

    Args:
        scene: what is asked.
        start: `info["state"]` of another run, from whose end this one goes on, for as long as the
            scene says. Time and crank angle go on, too. Steps begin as the others ended, but what
            step control remembers is lost: a run in two pieces is within its tolerance of one in
            one piece, not equal to the last digit.
        quiet: False shows the progress on standard error.

    Returns:
        The result. After an early stop too, `completed` False and `info["reason"]` saying when,
        where, why and what to try.

    Raises:
        InputError: `start` is the state of a run with other bodies, joints or loads.
    """
    begun = time.perf_counter()
    model = build(scene, quiet=quiet)
    if start is not None:
        model = go_on_from(model, start)
    try:
        outcome = model.solve(quiet=quiet)
        result = record(model, outcome)
    finally:
        model.SC.Reset()  # its systems and their solvers hold each other: never freed otherwise
    total = time.perf_counter() - begun
    return replace(result, info={**result.info, "total_time": total})
