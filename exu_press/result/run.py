"""One run of a scene, front to back, without errors."""

import time
from dataclasses import replace

from exu_press.model import build
from exu_press.model.state import State, go_on_from
from exu_press.result.record import record
from exu_press.result.result import Result
from exu_press.scene import Scene

__all__ = ["run_once"]

SHORT = 1e-5
"""Revolutions of a run that tells which channels there are."""


def run_once(scene: Scene, *, start: State | None = None, quiet: bool = True) -> Result:
    """Do what `exu_press.simulate` does without errors.

    Channels that [output] names are looked for in a shorter run first: the record alone knows what
    a scene has.
    """
    begun = time.perf_counter()
    if scene.output is not None and not isinstance(scene.output.channels, str):
        short = run_once(scene.replace({"output": None, "revolutions": SHORT}))
        scene.output.kept(short.channels)
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
