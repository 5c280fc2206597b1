"""The reduced model as arrays, compiled by numba where that is installed."""

import importlib
import importlib.util
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from exu_press.numerics.arrays import Array
from exu_press.scene import Scene
from exu_press.studies.precision.errors import Trajectory
from precision.reduced import ScalarFunction, numbers_of, rate_of, start_of

__all__ = ["CompiledModel", "compile_model", "has_numba"]


def has_numba() -> bool:
    """Return whether functions can be compiled here."""
    return importlib.util.find_spec("numba") is not None


@dataclass(frozen=True)
class CompiledModel:
    """The slider-crank of a scene as integrators take it.

    Attributes:
        scene: what it was reduced from.
        rate: (t, state (4,)) -> the state's rate (4,), SI.
        fill: (t, state (4,), out (4,)) does the same in place.
        start: (4,) state at t = 0: rod angle (rad), slider height (m) and their rates.
        compiled: whether numba compiled the functions.
    """

    scene: Scene
    rate: Callable[[float, Array], Array]
    fill: ScalarFunction
    start: Array
    compiled: bool
    _observe: ScalarFunction

    def trajectory(self, time: Array, states: Array) -> Trajectory:
        """Return what is seen of states (n, 4) at instants (n,)."""
        acceleration = np.empty(len(time))
        self._observe(time, states, acceleration)
        return Trajectory(time, states[:, 1], states[:, 3], acceleration)


def compile_model(scene: Scene) -> CompiledModel:
    """Return the reduced model of a slider-crank, compiled if that is possible."""
    jit: Any = None
    if has_numba():
        jit = importlib.import_module("numba").njit
    scalar_rate = rate_of(scene, jit)

    def rate(t: float, x: Array) -> Array:
        out = np.empty(4)
        out[0], out[1], out[2], out[3] = scalar_rate(t, x[0], x[1], x[2], x[3])
        return out

    def fill(t: float, x: Array, out: Array) -> None:
        out[0], out[1], out[2], out[3] = scalar_rate(t, x[0], x[1], x[2], x[3])

    def observe(time: Array, states: Array, acceleration: Array) -> None:
        for i in range(len(time)):
            x = states[i]
            acceleration[i] = scalar_rate(time[i], x[0], x[1], x[2], x[3])[3]

    if jit is not None:
        rate, fill, observe = jit(rate), jit(fill), jit(observe)
    start = np.array(start_of(numbers_of(scene)))
    model = CompiledModel(scene, rate, fill, start, jit is not None, observe)
    rate(0.0, start)
    fill(0.0, start, np.empty(4))
    model.trajectory(np.zeros(1), start[None, :].copy())
    return model
