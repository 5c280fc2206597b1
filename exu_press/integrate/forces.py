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

FELT = 1e-6
"""Part of forces that more than rounding makes."""

JUMPS = 0.25
"""Change of a force that jumps, over the largest within a step; sign(0) = 0 halves that of sign."""

HALVINGS = 20
"""Of the motion of a step, after which what changes smoothly no longer does."""


def forces(task: Task) -> Array:
    """Return the forces on the coordinates in the current state, without those of constraints."""
    task.solver.ComputeODE2RHS(task.problem.mbs)
    return np.array(task.solver.GetSystemResidual())[: len(task.problem.current.positions)]


def differing(task: Task) -> str:
    """Return which force in the current state is another one when asked for again, or nothing."""
    first, again = forces(task), forces(task)
    with np.errstate(invalid="ignore"):  # of forces beyond all numbers
        changed = np.abs(again - first) > FELT * np.abs(first).max(initial=0.0)
    for node in _of(task, changed):
        return (
            f"the force on {node.name} is another one each time that it is asked for in the same "
            "state: allowed are forces of time, positions and velocities; draw random numbers, and "
            "sum up what a controller has seen, in a pre-step function"
        )
    return ""


def without_solution(task: Task, time: float) -> str:
    """Return which force lets no step begin after a time, s, however short, and why; or nothing."""
    problem = task.problem
    if problem.joints is not None:  # whose films may have forces beyond all numbers
        return ""
    current = problem.current
    state = np.array(current.positions), np.array(current.velocities)
    try:
        return differing(task) or _unbalanced(task, time)
    finally:
        problem.data.SetTime(time)
        current.positions[:], current.velocities[:] = state


def _unbalanced(task: Task, time: float) -> str:
    """Return which force is no number, or jumps within the motion of a step; or nothing.

    The jump is looked for by halving the motion, from the step back to the step ahead.
    """
    problem, step = task.problem, max(task.smallest, task.solver.it.currentStepSize)
    current, start = problem.current, problem.start
    problem.data.SetTime(time + task.smallest)

    def moved(steps: float) -> Array:
        current.positions[:] = start.positions + steps * way
        current.velocities[:] = start.velocities + steps * pushed
        return forces(task)

    way = pushed = np.zeros_like(start.velocities)
    here, masses = moved(0.0), np.diag(task.solver.GetSystemMassMatrix())
    for node in _of(task, ~np.isfinite(here)):
        return f"the force on {node.name} is no number there; check loads and user functions"
    mobility = np.divide(1.0, masses, out=np.zeros_like(here), where=masses > 0.0)
    way, pushed = step * np.array(start.velocities), step * here * mobility
    (low, behind), (high, ahead) = ((steps, moved(steps)) for steps in (-1.0, 1.0))
    largest = np.maximum(np.abs(ahead), np.abs(behind))
    felt = largest > FELT * largest.max(initial=0.0)
    for _ in range(HALVINGS):
        middle = 0.5 * (low + high)
        between = moved(middle)
        below, above = (np.linalg.norm((f - between) * mobility) for f in (behind, ahead))
        if below > above:
            high, ahead = middle, between
        else:
            low, behind = middle, between
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
