"""Where the motion begins, and where it begins anew: it is made to fit what holds and pushes it."""

import math
from collections.abc import Callable

import exudyn as exu
import numpy as np

from exu_press.integrate.constraints import Constraints
from exu_press.integrate.contact import fit_data
from exu_press.integrate.settings import Task
from exu_press.integrate.start import fit_jump, fit_start, start_rates, start_without_mass
from exu_press.integrate.velocity_jump import VelocityJumps
from exu_press.numerics.arrays import Array

__all__ = ["Beginnings"]


class Beginnings:
    """Fits the state to constraints and forces where a run starts, and where its motion jumps.

    It begins anew behind a jump of prescribed velocities, an event, and an impact that a function
    of the user's own sets. Such a function may also switch forces or constraints, which shows
    only in the next step. Its accelerations are those of what was there before, off by the whole
    jump, and ring on in steps of any size. So that step is repeated from a state that fits.

    Attributes:
        jumps: of prescribed velocities.
        pushed_by_calls: how often a call of a pre-step function has made accelerations jump by what
            matters within the largest step.
    """

    def __init__(self, task: Task, constraints: Constraints) -> None:
        """Take a task and its constraints."""
        self._task, self._constraints = task, constraints
        self.jumps = VelocityJumps(task, constraints)
        self.pushed_by_calls, self._called = 0, False
        self._anew_at = self._failed_at = math.nan  # where the motion has, or a step, at last, s

    def fit_first(self, changed: Callable[[], bool]) -> tuple[Array, Array] | None:
        """Fit the start; return its accelerations and their rate, where these have been found.

        Args:
            changed: has a pre-step function called, and returns whether that has changed
                constraints: what it has switched off is not to be fitted, and the motion that it
                prescribes is.
        """
        task, constraints = self._task, self._constraints
        state, data, given = task.problem.current, task.problem.data, exu.ConfigurationType.Initial
        resting = not state.accelerations.any()  # or Exudyn's sparse solver found none
        found = start_without_mass(task, constraints) if resting else None
        ahead = self.jumps.ahead(task.start)
        fitted = fit_start(task, constraints, ahead) or found
        if fit_data(task):
            fitted = fit_start(task, constraints, ahead, pushed=True)
        if changed():
            state.positions[:] = data.GetODE2Coordinates(given)
            state.velocities[:] = data.GetODE2Coordinates_t(given)
            ahead = self.jumps.ahead(task.start)
            fitted = fit_start(task, constraints, ahead, pushed=True)
        return fitted

    def fitted_by(self) -> tuple[float, float]:
        """Return by how much a start that has been fitted was moved, m, and its speeds, m/s.

        A system at rest that a prescribed motion takes along has no speeds to be changed.
        """
        problem, norm = self._task.problem, self._task.scales.norm
        data, given = problem.data, exu.ConfigurationType.Initial
        moved = problem.current.positions - data.GetODE2Coordinates(given)
        speeds = data.GetODE2Coordinates_t(given)
        changed = (problem.current.velocities - speeds) if speeds.any() else speeds
        return norm(moved.tolist()), norm(changed.tolist())

    def switched(self, begin: float, called_at: float, *, by_far: bool) -> bool:
        """Return whether a function may have switched something where a step has failed; once.

        A pre-step function is called to set something. A post-step function is called behind every
        step, and seldom does; of that, only what it switches of constraints is seen.

        Args:
            begin: of the step, s.
            called_at: where a pre-step function was last called, s.
            by_far: whether the step is to be less than half as long; else, where nothing has been
                switched, a shorter one takes less time than to begin anew.
        """
        if begin == self._anew_at:
            return False
        again, self._failed_at = begin == self._failed_at, begin
        switched = self._constraints.switched() or (begin == called_at and (by_far or again))
        self._called = switched and begin == called_at
        return switched

    def jumped(self, step: float, end: float, before: Array) -> tuple[Array, Array, Array] | None:
        """Return the motion behind a short step in which a prescribed velocity jumps.

        Nothing where it changes by less than matters, or where bodies have moved by more than their
        velocities do: the offset itself jumps.

        Args:
            step: s.
            end: of it, s.
            before: velocities at its beginning.

        Returns:
            Velocities and accelerations, and the prescribed rate of these.
        """
        problem, scales = self._task.problem, self._task.scales
        jump = self._behind(before, end)
        changed = scales.norm((jump[0] - before).tolist())
        moved = scales.norm((problem.current.positions - problem.start.positions).tolist())
        speeds = scales.norm(jump[0].tolist()) + scales.norm(before.tolist())
        felt = changed > self._task.tolerance * scales.speed
        return jump if felt and moved <= step * speeds else None

    def fit_anew(self, time: float) -> tuple[Array, Array]:
        """Fit the state at a time (s), with its velocities; constraints may change these.

        Returns:
            Accelerations, and the prescribed rate of these.
        """
        self._anew_at = time
        task, problem = self._task, self._task.problem
        mbs, data, state, begin = problem.mbs, problem.data, problem.current, problem.start
        now = data.GetTime()  # that of the step's end, where one is about to be tried
        task.solver.ComputeNewtonResidual(mbs, mbs.sys["simulationSettings"])  # and its masses
        start_rates(task, time)
        jump = self._behind(np.array(state.velocities), time)
        if self._called:
            scales, self._called = task.scales, False
            gained = task.largest * scales.norm((jump[1] - state.accelerations).tolist())
            self.pushed_by_calls += gained > task.tolerance * scales.speed
        state.velocities[:], state.accelerations[:], rate = jump
        begin.positions[:], begin.velocities[:] = state.positions, state.velocities
        begin.accelerations[:] = state.accelerations
        data.SetTime(now)
        return jump[1], rate

    def _behind(self, before: Array, time: float) -> tuple[Array, Array, Array]:
        """Return the motion behind a jump of these velocities at a time (s): `fit_jump`."""
        return fit_jump(self._task, self._constraints, before, time, self.jumps.ahead(time))
