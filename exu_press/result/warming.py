"""Oil that warms: after each revolution films get the temperature of their heat balance."""

import math
import warnings
from dataclasses import replace

from exu_press.integrate import SolverStatus
from exu_press.laws.film.oil import HOTTEST
from exu_press.model import Model
from exu_press.model.warm_film import Heat
from exu_press.numerics.piecewise import integral
from exu_press.result.result import Result

__all__ = ["to_next_revolution", "update_film_temperatures"]

TURN = 2.0 * math.pi

WHOLE = 1e-6
"""Tolerance of a whole revolution."""


def to_next_revolution(model: Model, remaining: float) -> tuple[Model, float]:
    """Return a model that goes on for one revolution, and its revolutions at the scene's speed.

    Args:
        model: at its start, which may be within a revolution, or at the end of the last one.
        remaining: revolutions of the run that are left, at the scene's speed.
    """
    solver = model.scene.solver
    if model.scene.drive is None or solver.tolerance is None:
        return model, min(remaining, 1.0)
    if model.until is not None:
        return replace(model, until=model.until + TURN), remaining
    start = model.scene.start_angle
    completed = math.floor((model.crank_at_start() - start) / TURN + WHOLE)
    return replace(
        model, until=start + TURN * (completed + 1)
    ), remaining  # a motor gets there when it does


def update_film_temperatures(model: Model, block: Result) -> Result:
    """Let the films of a model have the temperature that a revolution's heat asks for.

    Returns:
        The revolution, with the temperatures with which the next one begins in its state. Where a
        film does not get rid of its heat, it is the last one of the run and says why.
    """
    rotation = float(block["crank_angle"][-1] - block["crank_angle"][0])
    if model.scene.drive is None or model.until is None:
        rotation = float(block.time[-1] - block.time[0]) * model.scene.angular_speed
    if rotation < TURN * (1.0 - WHOLE):
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
