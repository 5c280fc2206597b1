"""One run of a scene, front to back, without errors."""

import time
from dataclasses import replace
from pathlib import Path

from exu_press.errors import error_prefix
from exu_press.model import build
from exu_press.model.continuation import go_on_from
from exu_press.model.state import State
from exu_press.result.record_run import record
from exu_press.result.result import Result
from exu_press.scene import Scene
from exu_press.scene.provenance import provenance_of
from exu_press.scene.scene import SHORTEST_RUN

__all__ = ["check_channels", "run_once"]

SHORT = 1e-5
"""Revolutions of a run that shows which channels a scene has."""

BLOCK = 10.0
"""Revolutions of a block. A longer run goes on block by block, with its channels on the disk."""


def run_once(
    scene: Scene,
    *,
    start: State | None = None,
    unfinished: Path | None = None,
    quiet: bool = True,
    settling: bool = False,
) -> Result:
    """Simulate a scene as `exu_press.simulate` does without errors.

    Args:
        scene: to be simulated.
        start: state of another run, from which this one goes on.
        unfinished: directory in which the run is while it goes on, see `simulate`.
        quiet: False shows the progress.
        settling: whether revolutions are added, a dozen at most, until films whose oil warms
            have settled; as many more then go before those that quantities are read from.
    """
    started = time.perf_counter()
    check_channels(scene)
    model = build(scene, quiet=quiet)
    provenance = provenance_of(scene)
    if start is not None:
        go_on_from(model, start)
    try:
        if scene.revolutions > BLOCK or model.warm:
            from exu_press.result.blocks import block_by_block

            result = block_by_block(model, unfinished, BLOCK, quiet=quiet, settling=settling)
        else:
            result = record(model, model.solve(quiet=quiet))
    finally:
        model.SC.Reset()  # its systems and their solvers hold each other: never freed otherwise
    total = time.perf_counter() - started
    return replace(result, info={**result.info, "total_time": total, "provenance": provenance})


def check_channels(scene: Scene) -> None:
    """Raise InputError where [output] names a channel that runs of the scene do not have.

    A short run tells: only a record has all names.
    """
    if scene.output is None or isinstance(scene.output.channels, str):
        return
    turned = max(SHORT, 2.0 * SHORTEST_RUN * scene.speed_rpm / 60.0)
    short = run_once(scene.replace({"output": None, "revolutions": turned, "settle": 0.0}))
    with error_prefix(scene.origin):
        scene.output.kept_channels(short.channels)
