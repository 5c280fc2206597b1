"""Forces of a system in a state, and what of them has no solution.

Exudyn's iterations find a state in which forces and inertia balance. None is found where a force
jumps over that balance, or is another one each time that it is asked for.
"""

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from exu_press.integrate.problem import Node
from exu_press.integrate.settings import Task
from exu_press.numerics.arrays import Array

__all__ = ["differing", "forces", "without_solution"]

DIFFERS = 1e-6
"""Part of the largest force above which another one, or a difference, is not its rounding."""

JUMPS = 0.5
"""Change of a force by what the smallest step moves, over the force, above which it jumps."""


def forces(task: Task) -> Array:
    """Return the forces on the coordinates in the current state, without those of constraints."""
    task.solver.ComputeODE2RHS(task.problem.mbs)
    return np.array(task.solver.GetSystemResidual())[: len(task.problem.current.positions)]


def differing(task: Task) -> str:
    """Return which force in the current state is another one when asked for again, or nothing."""
    first, again = forces(task), forces(task)
    with np.errstate(invalid="ignore"):  # of forces beyond all numbers
        changed = np.abs(again - first) > DIFFERS * np.abs(first).max(initial=0.0)
    for node in _of(task, changed):
        return (
            f"the force on {node.name} is another one each time that it is asked for in the same "
            "state: allowed are forces of time, positions and velocities; draw random numbers, and "
            "sum up what a controller has seen, in a pre-step function"
        )
    return ""


def without_solution(task: Task, time: float) -> str:
    """Return which force lets no step begin after a time, s, however short, and why; or nothing."""
    problem, step = task.problem, task.smallest
    current, start = problem.current, problem.start
    tried = np.array(current.positions), np.array(current.velocities)
    problem.data.SetTime(time + step)

    def moved(positions: Array | float, velocities: Array | float) -> Array:
        current.positions[:] = start.positions + positions
        current.velocities[:] = start.velocities + velocities
        return forces(task)

    here = moved(0.0, 0.0)
    known, masses = np.isfinite(here), np.diag(task.solver.GetSystemMassMatrix())
    pushed = step * np.divide(here, masses, out=np.zeros_like(here), where=known & (masses > 0.0))
    way = step * np.array(start.velocities)
    ahead, behind = moved(way, pushed), moved(-way, -pushed)
    problem.data.SetTime(time)
    current.positions[:], current.velocities[:] = tried
    for node in _of(task, ~known):
        return f"the force on {node.name} is no number there; check loads and user functions"
    felt = np.abs(here) > DIFFERS * np.abs(here).max(initial=0.0)
    largest = np.maximum(np.abs(ahead), np.abs(behind))
    for node in _of(task, felt & (np.abs(ahead - behind) > JUMPS * largest)):
        return (
            f"the force on {node.name} jumps there with its motion, so that none holds the "
            "balance, as friction of sign(v) where it sticks; let it change over a range of speeds "
            "or positions, as tanh(v / v_zone) does"
        )
    return ""


def _of(task: Task, found: NDArray[np.bool_]) -> Iterator[Node]:
    """Yield the nodes with a coordinate for which it holds."""
    return (node for node in task.problem.nodes if found[node.start : node.start + node.size].any())
