"""The run monitor: the one place where Exudyn calls, before, in and after every step."""

import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

import exudyn as exu
import numpy as np

from exu_press.integrate.constraints import Constraints
from exu_press.integrate.controller import Controller
from exu_press.integrate.error import Criteria, StepError
from exu_press.integrate.initial_conditions import ConsistentInitialization
from exu_press.integrate.modal_mass import ModalMass
from exu_press.integrate.predictor import Predictor
from exu_press.integrate.resolution import ImpactResolution
from exu_press.integrate.stepping import Event, FixedSteps, StepControl
from exu_press.integrate.task import Task
from exu_press.integrate.user_functions import UserFunctions
from exu_press.integrate.variable_step import VariableStepCorrection
from exu_press.joints.joint import ClearanceJoint
from exu_press.terminal.interrupt import handled_interrupt
from exu_press.terminal.progress import Progress

__all__ = ["RunMonitor"]

SECONDS_BETWEEN_UPDATES = 0.1

SOON, LONG = 4.0, 40.0
"""s, after which a run says that it will be long, where so many are left."""

ACCEPTED = [0.0, -1.0]


class RunMonitor:
    """Hands Exudyn's calls on to the parts of an integration; counts, and stops when asked to.

    Attributes:
        tries: number of steps tried.
        steps: of them, accepted ones.
        max_steps: tries before the run is given up.
        interrupted: whether Ctrl-C was pressed.
        over_budget: whether all of `max_steps` were used up.
        control: of the steps.
        resolution: of the impacts, in clearance joints or fixed steps.
        constraints: of the system.
        go_on: False once a function of the user's own asked to stop.
        stalled, refusal: why the motion came to its end, or the start allows no run, or nothing.
        start_changes: by how much the start was moved, m, and its speeds changed, m/s.
    """

    def __init__(
        self,
        task: Task,
        functions: UserFunctions,
        next_corner: Callable[[float], float],
        watch: Callable[[float], str],
        progress: Progress,
        max_steps: int,
        criteria: Criteria,
        event: Callable[[Any, float], float],
        why_long: Callable[[float, ClearanceJoint | None], str],
        controller: Controller | None = None,
    ) -> None:
        """Watch the run of a task; the arguments are those of `solve_dynamic`."""
        self.tries = self.steps = 0
        self.interrupted = self.over_budget = False
        self.go_on, self.refusal = True, ""
        self.start_changes = 0.0, 0.0
        self.stalled, self._watch = "", watch
        self.max_steps = max_steps
        self._task, self._functions, self._progress = task, functions, progress
        self.constraints = Constraints(task)
        self._step_change = VariableStepCorrection(task, self.constraints)
        # where steps follow a smooth motion, what modes carry would change with each step's size
        smooth = task.system.joints is None and not task.fixed
        self._modal_mass = ModalMass(
            task.system.mbs, task.solver, 0.0 if smooth else task.tuning.modal_mass
        )
        self._predictor = Predictor(task)
        self._estimate = StepError(task, criteria)
        self._event = Event(task, event)
        self.control: StepControl | FixedSteps = (
            FixedSteps(task)
            if task.fixed
            else StepControl(task, self._estimate, next_corner, controller)
        )
        # without clearance joints the estimated error judges every step, jumps included
        self.resolution = None if smooth else ImpactResolution(task)
        self._iteration: Any = task.solver.it  # holds the step
        self._accelerations = task.system.current.accelerations
        self._begun = time.monotonic()
        self._next_update = self._begun + SECONDS_BETWEEN_UPDATES
        self._why_long: Callable[[float, ClearanceJoint | None], str] | None = why_long
        self._start = self._time = task.start  # of the run and of the step under way, s

    @contextmanager
    def attach(self) -> Iterator[None]:
        """Let Exudyn call this monitor."""
        with (
            self._functions.replaced_by(
                self._before_step, self._before_residual, self._after_newton, self._after_step
            ),
            handled_interrupt(self._interrupt),
        ):
            try:
                yield
            finally:
                self._modal_mass.fit(0.0)

    def _begin(self) -> bool:
        """Look at the start, whose accelerations Exudyn has computed; return whether to go on."""
        task, solver = self._task, self._task.solver
        if not np.isfinite(self._accelerations).all():
            return False
        if not task.fixed:  # within a fixed step, motions may change by less than rounding
            self.refusal = self.constraints.refusal()
            if self.refusal:
                return False
        solver.ComputeMassMatrix(task.system.mbs)
        if task.fixed:
            task.scales.begin(solver.GetSystemMassMatrix())
        else:
            start = ConsistentInitialization(task, self.constraints)
            consistent = start.fit()
            task.scales.begin(solver.GetSystemMassMatrix())
            if consistent is not None:
                self._step_change.start_from(*consistent)
            self.start_changes = start.changes()
            self._estimate.begin()
        self._predictor.begin()
        if self.resolution is not None:
            self.resolution.begin(self._accelerations.tolist())
        self._event.begin(task.start)
        return True

    def _before_step(self, mbs: exu.MainSystem, end: float) -> bool:
        """Return whether to go on."""
        self.tries += 1
        if not self.tries % 16 and time.monotonic() > self._next_update:
            self._next_update = time.monotonic() + SECONDS_BETWEEN_UPDATES
            self._progress.update(end - self._start)
            if self._why_long is not None and self._next_update - self._begun > SOON:
                self._say_if_long(self._why_long)
        self._modal_mass.fit(end - self._time)
        if self._functions.before_step:
            go_on = self._functions.call_before_step(self._time, end)
            self.go_on = self.go_on and go_on
        self._step_change.before_try(self._time, end - self._time)
        self.over_budget = self.tries >= self.max_steps
        return self.go_on and not (self.interrupted or self.over_budget)

    def _say_if_long(self, why: Callable[[float, ClearanceJoint | None], str]) -> None:
        """Say once, early, how long the run will be, if that is long, and why."""
        gone = self._time - self._start
        if gone <= 0.0:
            return
        time_left = self._progress.time_left(gone)
        if time_left > LONG:
            self._why_long = None
            step = gone / max(self.steps, 1)
            joint = self._estimate.limiting_joint()
            self._progress.say(f"about {time_left:.0f} s left: {why(step, joint)}")

    def _before_residual(
        self, mbs: exu.MainSystem, end: float, iteration: int, discontinuous: int
    ) -> None:
        if self._functions.before_residual:
            self._functions.before_residual(mbs, end, iteration, discontinuous)
        self._predictor.before_residual(end - self._time, iteration)

    def _after_newton(self, mbs: exu.MainSystem, end: float) -> list[float]:
        """Return [0, -1] to accept the step, or [2, step] to have it repeated."""
        return self._functions.combine(self._verdict(end - self._time, end), end)

    def _verdict(self, step: float, end: float) -> list[float]:
        if step <= 0.0:
            return ACCEPTED
        if self._step_change.repeats_from_mean(step):
            return [2.0, step]
        shorter = self.control.shorter(step) or self._event.shorter(step, end)
        return [2.0, shorter] if shorter > 0.0 else ACCEPTED

    def _after_step(self, mbs: exu.MainSystem, end: float) -> bool:
        if self.tries == 0:  # Exudyn calls at the start too
            if not self._begin():
                return False
        else:
            self.steps += 1
            step = end - self._time
            self._time = end
            self.control.accept_step(step, at_event=self._event.passed)
            self._event.accept_step()
            accelerations = self._accelerations.tolist()
            self._predictor.accept_step(step, accelerations)
            if self.resolution is not None:
                self.resolution.measure_step(end, step, accelerations)
        self.stalled = self._watch(end)
        go_on, impact = self._functions.call_after_step(end)
        self.go_on = self.go_on and go_on
        if impact:  # of the user's own: velocities jumped
            self.control.restart()
        step = self.control.next_step(end)
        if step != self._iteration.currentStepSize:  # to set it takes longer than to ask for it
            self._iteration.currentStepSize = step
        return self.go_on and not self.stalled

    def _interrupt(self) -> None:
        """Let Ctrl-C end the run after the step under way, so that nothing is lost."""
        self.interrupted = True
