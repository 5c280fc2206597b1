"""One scene, front to back."""

import time
from dataclasses import replace

from exu_press.model import build
from exu_press.result import Result, record
from exu_press.scene import Scene

__all__ = ["simulate"]


def simulate(scene: Scene, *, quiet: bool = True) -> Result:
    """Build a scene's model, advance it to its end or an early stop, and return what came out.

    Args:
        scene: what is asked.
        quiet: False shows the progress on standard error.

    Returns:
        The result. After an early stop too, `completed` False and `info["reason"]` saying when,
        where, why and what to try.
    """
    start = time.perf_counter()
    model = build(scene, quiet=quiet)
    try:
        outcome = model.solve(quiet=quiet)
        result = record(model, outcome)
    finally:
        model.SC.Reset()  # its systems and their solvers hold each other: never freed otherwise
    total = time.perf_counter() - start
    return replace(result, info={**result.info, "total_time": total})
