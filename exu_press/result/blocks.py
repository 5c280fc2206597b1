"""A run in blocks: one at a time is in memory, or one is a revolution where oil warms."""

from collections.abc import Sequence
from dataclasses import replace
from operator import itemgetter
from pathlib import Path

from exu_press.integrate import SolverStatus
from exu_press.model import Model
from exu_press.model.state import go_on_from, state_of
from exu_press.result.checkpoint import open_checkpoint, write_checkpoint
from exu_press.result.info import Info
from exu_press.result.record import record
from exu_press.result.result import Result
from exu_press.result.warming import to_next_revolution, update_film_temperatures
from exu_press.scene import Scene
from exu_press.scene.scene import SHORTEST_RUN
from exu_press.terminal.progress import Progress

__all__ = ["MOST_ADDED", "block_by_block"]

MOST_ADDED = 12
"""Revolutions added at most until films have settled."""


def block_by_block(
    model: Model, unfinished: Path | None, longest: float, *, quiet: bool, settling: bool
) -> Result:
    """Return the result of a run in blocks: of a long one memory holds one block at a time.

    Where oil warms, a block is a revolution, after which films have other temperatures.

    Args:
        model: at its start.
        unfinished: directory that keeps a long run while it goes on, or None.
        longest: revolutions of a block; a longer run has its channels on the disk.
        quiet: False shows the progress.
        settling: whether revolutions are added until films have settled, MOST_ADDED at most.
    """
    scene, solver = model.scene, model.scene.solver
    unfinished = unfinished if scene.revolutions > longest else None
    infos: list[Info] = []
    remaining, steps, added = scene.revolutions, solver.max_steps, 0
    with (
        open_checkpoint(unfinished) as channels,
        Progress("run", scene.duration, quiet=quiet, whole=True),
    ):
        while True:
            length = min(remaining, longest)
            if model.warm:
                model, length = to_next_revolution(model, remaining)
            block_of = {"revolutions": length, "settle": 0.0, "solver.max_steps": steps}
            model = replace(model, scene=scene.replace(block_of))
            block = record(model, model.solve(quiet=quiet))
            if model.warm and block.completed:
                block = update_film_temperatures(model, block)
            channels.append(block.channels)
            infos.append(block.info)
            if model.until is not None:  # a motor has turned the crank by then, or not
                length = float(block.time[-1] - block.time[0]) * scene.speed_rpm / 60.0
            remaining -= length
            steps -= block.info["steps"] + block.info["rejected_steps"]
            if unfinished is not None and block.completed:
                so_far = replace(block, scene=scene, info=_combined_info(infos))
                write_checkpoint(unfinished, so_far, scene.revolutions - remaining, channels)
            may_add = settling and added < MOST_ADDED and block.completed
            if may_add and _needs_revolution(model, scene, remaining):
                remaining, added = remaining + 1.0, added + 1
                later = {
                    "revolutions": scene.revolutions + 1.0,
                    "settle": scene.settle_revolutions + 1.0,
                }
                scene = scene.replace(later)
            ended = remaining < _negligible_rest(scene) or model.has_stood(block.info["end_time"])
            if ended or not block.completed or steps < 1:
                break
            model = go_on_from(model, state_of(model))
    channels_of_run = channels if scene.revolutions > longest else channels.in_memory()
    info: Info = (
        {**_combined_info(infos), "added_revolutions": added} if added else _combined_info(infos)
    )
    return replace(block, scene=scene, channels=channels_of_run, info=info)


def _needs_revolution(model: Model, scene: Scene, remaining: float) -> bool:
    """Return whether quantities would be read from revolutions before films have settled."""
    completed = scene.revolutions - remaining + _negligible_rest(scene)
    if not scene.settle_revolutions or completed < scene.settle_revolutions:
        return False
    return any(not film.is_steady for film in model.warm.values())


def _negligible_rest(scene: Scene) -> float:
    """Return the remaining revolutions below which a run is complete."""
    return max(1e-9 * scene.revolutions, SHORTEST_RUN * scene.speed_rpm / 60.0)


def _combined_info(infos: Sequence[Info]) -> Info:
    """Return the last block's metadata, with the cost of all and the worst status."""
    last = infos[-1]
    worst = last
    if SolverStatus(last["status"]).reached_end:
        completed = SolverStatus.COMPLETED.value
        worst = next((info for info in infos if info["status"] != completed), last)
    combined: Info = {
        **last,
        "status": worst["status"],
        "reason": worst["reason"],
        "wall_time": sum(info["wall_time"] for info in infos),
        "steps": sum(info["steps"] for info in infos),
        "rejected_steps": sum(info["rejected_steps"] for info in infos),
        "newton_iterations": sum(info["newton_iterations"] for info in infos),
    }
    if "stress" in last:
        combined["stress"] = {
            name: max((info["stress"][name] for info in infos), key=itemgetter("von_mises"))
            for name in last["stress"]
        }
    return combined
