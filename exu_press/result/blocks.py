"""A run in blocks: one at a time is in memory, or one is a revolution where oil warms.

After each revolution films get the temperature of their heat balance.
"""

import math
import warnings
from collections.abc import Sequence
from dataclasses import replace
from operator import itemgetter
from pathlib import Path

from exu_press.integrate import SolverStatus
from exu_press.laws.film.oil import HOTTEST
from exu_press.model import Model
from exu_press.model.continuation import go_on_from, state_of
from exu_press.model.warm_film import Heat
from exu_press.numerics.piecewise import integral
from exu_press.result.checkpoint import open_checkpoint, write_checkpoint
from exu_press.result.info import Info
from exu_press.result.record_run import record
from exu_press.result.result import Result
from exu_press.result.windows import whole_revolutions
from exu_press.scene import Scene
from exu_press.scene.scene import SHORTEST_RUN
from exu_press.terminal.progress import Progress

__all__ = ["MOST_ADDED", "block_by_block"]

MOST_ADDED = 12
"""Revolutions added at most until films have settled."""

TURN = 2.0 * math.pi


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
                length = _to_next_revolution(model, remaining)
            block_of = {"revolutions": length, "settle": 0.0, "solver.max_steps": steps}
            model.scene = scene.replace(block_of)
            block = record(model, model.solve(quiet=quiet))
            if model.warm and block.completed:
                block = _update_film_temperatures(model, block)
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
                scene = scene.read_later(1.0)
            ended = remaining < _negligible_rest(scene) or model.has_stood(block.info["end_time"])
            if ended or not block.completed or steps < 1:
                break
            go_on_from(model, state_of(model))
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


def _to_next_revolution(model: Model, remaining: float) -> float:
    """Let a model go on for one revolution, and return its revolutions at the scene's speed.

    Args:
        model: at its start, which may be within a revolution, or at the end of the last one.
        remaining: revolutions of the run that are left, at the scene's speed.
    """
    solver = model.scene.solver
    if model.scene.drive is None or solver.tolerance is None:
        return min(remaining, 1.0)
    if model.until is not None:
        model.until += TURN
    else:
        start = model.scene.start_angle
        completed = whole_revolutions((model.crank_at_start() - start) / TURN)
        model.until = start + TURN * (completed + 1)
    return remaining  # a motor gets there when it does


def _update_film_temperatures(model: Model, block: Result) -> Result:
    """Let the films of a model have the temperature that a revolution's heat asks for.

    Returns:
        The revolution, with the temperatures with which the next one begins in its state. Where a
        film does not get rid of its heat, it is the last one of the run and says why.
    """
    rotation = float(block["crank_angle"][-1] - block["crank_angle"][0])
    if model.until is None:
        rotation = float(block.time[-1] - block.time[0]) * model.scene.angular_speed
    if not whole_revolutions(rotation / TURN):
        return block
    info, time = block.info, block.time
    for name, film in model.warm.items():
        duration = float(time[-1] - time[0])
        flow, pressure = (
            float(integral(time, values)[-1]) / duration
            for values in (block[f"{name}_side_flow"], film.mean_pressure(block[f"{name}_force"]))
        )
        heat = Heat(float(block[f"{name}_loss"][-1]) / duration, flow, pressure, film.viscosity)
        temperature, pressure = film.balance_heat(heat)
        if not math.isfinite(temperature):
            reason = _reason_of_breakdown(name, heat, film.oil.conductance, float(time[-1]))
            warnings.warn(f"film broke down: {reason}", stacklevel=5)
            info = {**info, "status": SolverStatus.FILM_BROKE_DOWN.value, "reason": reason}
            continue
        film.set_state(temperature, pressure)
    films = {name: (film.temperature, film.pressure) for name, film in model.warm.items()}
    if "state" in info:
        info = {**info, "state": {**info["state"], "films": films}}
    return replace(block, info=info)


def _reason_of_breakdown(name: str, heat: Heat, conductance: float, time: float) -> str:
    """Return why a film breaks down, and the cure."""
    return (
        f"film too hot at t = {time:.6g} s: below {HOTTEST:g} deg C side flow "
        f"({heat.flow:.3g} m^3/s) and conductance ({conductance:g} W/K) do not carry off what "
        f"joints.{name} dissipates ({heat.power:.4g} W as it was); try the conductance that its "
        "frame has (film.oil.conductance), a larger clearance or a thinner oil"
    )
