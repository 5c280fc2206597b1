"""The run monitor: the one place where Exudyn calls, before, in and after every step."""

import math
import signal
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager, nullcontext
from types import FrameType
from typing import Any

import exudyn as exu
import numpy as np

from exu_press.integrate.beginnings import Beginnings
from exu_press.integrate.constraints import Constraints
from exu_press.integrate.contact import Gaps, Settling
from exu_press.integrate.controller import Controller
from exu_press.integrate.error import StepError
from exu_press.integrate.forces import differing
from exu_press.integrate.modal_mass import ModalMass
from exu_press.integrate.output import OutputGrid
from exu_press.integrate.places import Places
from exu_press.integrate.sampling import Event, Sampling
from exu_press.integrate.scheme import Newton
from exu_press.integrate.set_numbers import SetNumbers
from exu_press.integrate.settings import Task
from exu_press.integrate.start import start_rates
from exu_press.integrate.step_change import StepChange
from exu_press.integrate.stepping import FixedSteps, Resolution, StepControl
from exu_press.joints import ClearanceJoint
from exu_press.numerics.arrays import Array
from exu_press.terminal.progress import Progress

__all__ = ["Monitor", "most_limiting"]

SECONDS_BETWEEN_UPDATES = 0.1

SOON = 4.0
"""s, after which a run says that it will be long."""

LONG = 40.0
"""s left, from which on it does: less than a minute, as the estimate is rough."""

ACCEPTED = [0.0, -1.0]


class Monitor:
    """Hands Exudyn's calls on to the parts of an integration, and to the user's own functions.

    Also counts, shows progress, and stops when asked to.

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
        stalled: why the motion that was watched came to its end, or nothing.
        without_mass: whether Exudyn found no accelerations to start with, as coordinates have no
            mass.
        refused: what of the start allows no run by tolerance, or nothing.
        again: whether the run is to begin again, with settings that its start asks for.
        set_behind_steps: steps behind which a post-step function has changed numbers.
    """

    def __init__(
        self,
        task: Task,
        next_corner: Callable[[float], float] | None,
        watch: Callable[[float], str],
        progress: Progress,
        max_steps: int,
        sample: float = 0.0,
        event: Callable[[Any, float], float] | None = None,
        why_long: Callable[[float, ClearanceJoint | None], str] | None = None,
        controller: Controller | None = None,
        *,
        hold: bool = False,
    ) -> None:
        """Watch a run.

        Args:
            task: to be solved.
            next_corner: time -> the next instant at which a load has a corner, s, or infinity;
                None where there are none.
            watch: is asked after every step why the run is to end there, or nothing.
            progress: is shown ten times a second.
            max_steps: budget.
            sample: period of a pre-step function, s; 0.0: every step.
            event: function of the system and the time, s; steps end where its sign changes.
            why_long: says why a run is long, of its mean step, s, and the clearance joint that
                limits most steps, if one does.
            controller: of the steps by tolerance; `LimitedGrowth` unless given.
            hold: whether what a pre-step function sets is held for its period.
        """
        self.tries = self.steps = self.set_behind_steps = 0
        self.interrupted = self.over_budget = False
        self.fitted = 0.0, 0.0  # by how much the start has moved, m, and its speeds, m/s
        self.go_on, self.without_mass, self.refused, self.again = True, False, "", False
        self._repeats_anew = False  # whether the motion begins anew with the step to be repeated
        # velocities, accelerations and their rate, which have jumped in the step last tried
        self._jump: tuple[Array, Array, Array] | None = None
        self.stalled, self._watch = "", watch
        self.max_steps = max_steps
        self._task, self._progress = task, progress
        self.constraints = Constraints(task)
        self._step_change = StepChange(task, self.constraints, corners=next_corner is not None)
        # where steps follow a smooth motion, what modes carry would change with each step's size
        smooth = task.problem.joints is None and not task.fixed
        modal_mass = 0.0 if smooth else task.tuning.modal_mass
        self._modal_mass = ModalMass(task.problem.mbs, task.solver, modal_mass)
        self._newton = Newton(task)
        self._gaps = Gaps(task.problem)
        self._places = Places(task.problem)
        self._output = OutputGrid(task, self._places)
        self._settling = Settling(task)
        self._estimate = StepError(task, self._settling)
        before_step = _function(task.problem.mbs.GetPreStepUserFunction())
        self._numbers = SetNumbers(task.problem.mbs)
        self._sampling = Sampling(
            task, self.constraints, self._numbers, before_step, sample, hold=hold
        )
        self._event = Event(task, event)
        self._beginnings = Beginnings(task, self.constraints)

        corner = next_corner or _never
        self.control: StepControl | FixedSteps = (
            FixedSteps(task)
            if task.fixed
            else StepControl(task, self._estimate, corner, self._sampling.next, controller)
        )
        # without clearance joints the estimated error judges every step, jumps included
        judged = task.problem.joints is None and not task.fixed
        self.resolution = None if judged else Resolution(task)
        self._iteration: Any = task.solver.it  # holds the step
        self._accelerations = task.problem.current.accelerations
        self._begun = time.monotonic()
        self._next_update = self._begun + SECONDS_BETWEEN_UPDATES
        self._why_long = why_long
        self._start = self._time = task.start  # of the run and of the step under way, s
        self._users: tuple[Any, Any, Any, Any] = 0, 0, 0, 0

    @contextmanager
    def attached(self) -> Iterator[None]:
        """Let Exudyn call this monitor; the user's own functions are called by it, and put back."""
        mbs = self._task.problem.mbs
        self._users = (
            _function(mbs.GetPreStepUserFunction()),
            _function(mbs.GetPreNewtonResidualUserFunction()),
            _function(mbs.GetPostNewtonUserFunction()),
            _function(mbs.GetPostStepUserFunction()),
        )
        places: tuple[Any, Any, Any, Any] = (
            mbs.SetPreStepUserFunction,
            mbs.SetPreNewtonResidualUserFunction,
            mbs.SetPostNewtonUserFunction,
            mbs.SetPostStepUserFunction,
        )
        ours = self._before_step, self._before_residual, self._after_newton, self._after_step
        for place, function in zip(places, ours, strict=True):
            place(function)
        try:
            watched = not self._task.fixed and (self._users[0] or self._users[3])
            with self._catching_interrupts(), self._numbers.watched() if watched else nullcontext():
                yield
        finally:
            self._modal_mass.fit(0.0)
            for place, function in zip(places, self._users, strict=True):
                place(function)

    def _begin(self) -> None:
        """Look at the state from which the run starts, whose accelerations Exudyn has computed."""
        task = self._task
        self._places.begin()
        start_rates(task, task.start)
        task.solver.ComputeMassMatrix(task.problem.mbs)
        if self._users[0] or self._users[3]:
            self.constraints.switched()  # from now on it tells
        if not task.fixed:  # within a fixed step, motions may change by less than rounding
            fitted = self._beginnings.fit_first(self._sampling.look)
            if fitted is not None:
                self._step_change.start_from(*fitted)
                self._estimate.start = fitted[0].tolist()
        task.scales.begin(task.solver.GetSystemMassMatrix())
        task.scales.shake(self.constraints.shaken, impacts=task.impacts)
        self.fitted = self._beginnings.fitted_by()
        now = self._accelerations.tolist()
        self._newton.begin()
        if self.resolution is not None:
            self.resolution.begin(now)
        self._event.begin(task.start)
        self._output.begin()

    def first_jump(self) -> float:
        """Return by how much speeds jump in a first step that no size makes good, m/s, or 0.0."""
        return 0.0 if self.steps else self._estimate.change_of_speed()

    @property
    def switched_steps(self) -> int:
        """Accepted steps within which contacts or friction of Exudyn's have switched."""
        return self._settling.switched

    @property
    def pushed_by_calls(self) -> tuple[int, int]:
        """Calls of a pre-step function that made forces jump, and all of its grid."""
        return self._beginnings.pushed_by_calls, self._sampling.calls

    def _before_step(self, mbs: exu.MainSystem, end: float) -> bool:
        """Return whether to go on."""
        self.tries += 1
        if not self.tries % 16 and time.monotonic() > self._next_update:
            self._next_update = time.monotonic() + SECONDS_BETWEEN_UPDATES
            self._progress.update(end - self._start)
            if self._why_long is not None and self._next_update - self._begun > SOON:
                self._say_if_long(self._why_long)
        self._modal_mass.fit(end - self._time)
        self._places.before_try(0.0)
        if self._users[0]:
            self.go_on = self._sampling.call(self._time, end) and self.go_on
        if self._repeats_anew:
            self._repeats_anew = False
            self._sampling.set(self._time)
            self._step_change.unshift()
            self._start_again(*self._beginnings.fit_anew(self._time))
        self._step_change.before_try(self._time, end - self._time)
        self._sampling.set(end)
        self._places.before_try(end - self._time)
        self.over_budget = self.tries >= self.max_steps
        return self.go_on and not (self.interrupted or self.over_budget)

    def _say_if_long(self, why: Callable[[float, ClearanceJoint | None], str]) -> None:
        """Say once, early, how long the run will be, if that is long, and why."""
        gone = self._time - self._start
        if gone <= 0.0:
            return
        left = self._progress.left(gone)
        if left > LONG:
            self._why_long = None
            steps = gone / max(self.steps, 1)
            self._progress.say(f"about {left:.0f} s left: {why(steps, self._limiting())}")

    def _limiting(self) -> ClearanceJoint | None:
        """Return the clearance joint that limits most of the steps, if such joints limit them."""
        joints = self._task.problem.joints
        number = most_limiting(self._estimate.limiting, self.tries)
        return None if joints is None or number is None else joints.joints[number]

    def _before_residual(self, mbs: exu.MainSystem, end: float, iteration: int, other: int) -> None:
        if self._users[1]:
            self._users[1](mbs, end, iteration, other)
        self._newton.before_residual(end - self._time, iteration)

    def _after_newton(self, mbs: exu.MainSystem, end: float) -> list[float]:
        """Return [0, -1] to accept the step, or [2, step] to have it repeated."""
        step = end - self._time
        ours = self._judged(step)
        self._sampling.set(end)
        self._settling.judged(ours is ACCEPTED, step)
        if not self._users[2]:
            return ours
        error, theirs = self._users[2](mbs, end)
        steps = [size for size in (ours[1], theirs) if size > 0.0]
        return [max(ours[0], error), min(steps, default=-1.0)]

    def _judged(self, step: float) -> list[float]:
        if step <= 0.0:
            return ACCEPTED
        if self._step_change.start_over(step):
            return [2.0, step]
        begin, self._jump = self._time, None
        shorter = self.control.shorter(step)
        beginnings = self._beginnings
        if shorter > 0.0 and (self._users[0] or self._users[3]):
            called_at, by_far = self._sampling.called_at, shorter < 0.5 * step
            self._repeats_anew = beginnings.switched(begin, called_at, by_far=by_far)
            if self._repeats_anew:
                return [2.0, step]
        jumps = beginnings.jumps
        before_jump = jumps.shorter(begin, step, failed=shorter > 0.0)
        if before_jump > 0.0:
            return [2.0, before_jump]
        if jumps.crossed:
            before = self._step_change.velocities()
            self._jump = beginnings.jumped(step, begin + step, before)
        if shorter > 0.0 and (self._jump is not None or self.control.of_force):
            self.control.error, shorter = 1.0, 0.0  # as much as a step may have
        shorter = shorter or self._event.shorter(step, begin + step)
        return [2.0, shorter] if shorter > 0.0 else ACCEPTED

    def _start_again(self, accelerations: Array, rate: Array) -> None:
        """Go on as from a start, with these accelerations and the rate prescribed to them."""
        self._step_change.start_from(accelerations, rate)
        self._newton.start_again()
        now = accelerations.tolist()
        self._estimate.start_again(now)
        if self.resolution is not None:
            self.resolution.begin(now)

    def _after_step(self, mbs: exu.MainSystem, end: float) -> bool:
        if self._output.writing:
            return True
        if self.tries == 0:  # Exudyn calls at the start too
            if not np.isfinite(self._accelerations).all():
                self.without_mass = True
                return False
            if not self._task.fixed:
                far_off = self.constraints.far_off() if self.constraints.count else ""
                self.refused = far_off or differing(self._task)
                if self.refused:
                    return False
            self.again = self._settling.begins_again()
            if self.again:
                return False
            self._begin()
        else:
            self.steps += 1
            step = end - self._time
            if self._jump is not None:
                current = self._task.problem.current
                current.velocities[:], current.accelerations[:], _ = self._jump
            self._places.stepped(step)
            self._output.stepped(self._time, end)
            self._time = end
            self._gaps.close()
            self._settling.accept()
            self.control.accept(step)
            self._event.accept()
            self._newton.stepped(step)
            if self._jump is not None:
                self.control.start_again()
                self._start_again(*self._jump[1:])
            elif self.resolution is not None:
                self.resolution.stepped(end, step, self._accelerations.tolist())
        self.stalled = self._watch(end)
        anew = self._event.passed
        if self._users[3]:
            anew = self._call_after_step(mbs, end) or anew
        if anew and self.steps and not self._task.fixed:
            self.control.start_again()
            self._start_again(*self._beginnings.fit_anew(end))
        step = self.control.next_step(end)
        self._output.next_step(end + step)
        if step != self._iteration.currentStepSize:  # to set it takes longer than to ask for it
            self._iteration.currentStepSize = step
        return self.go_on and not self.stalled

    def _call_after_step(self, mbs: exu.MainSystem, end: float) -> bool:
        """Call the user's own function; return whether it has set velocities, as an impact does."""
        task, velocities = self._task, self._task.problem.current.velocities
        before = velocities.tobytes()  # to compare bytes takes a tenth of the time
        others = self._numbers.others
        self.go_on = bool(self._users[3](mbs, end)) and self.go_on
        self.set_behind_steps += self._numbers.others > others
        if velocities.tobytes() == before:
            return False
        changed = task.scales.norm((velocities - np.frombuffer(before)).tolist())
        return changed > task.tolerance * task.scales.speed

    @contextmanager
    def _catching_interrupts(self) -> Iterator[None]:
        """Let Ctrl-C end the run after the step under way, so that nothing is lost."""
        ignored = signal.getsignal(signal.SIGINT) is signal.SIG_IGN
        if ignored or threading.current_thread() is not threading.main_thread():
            yield
            return

        def on_interrupt(number: int, frame: FrameType | None) -> None:
            self.interrupted = True

        before = signal.signal(signal.SIGINT, on_interrupt)
        try:
            yield
        finally:
            signal.signal(signal.SIGINT, before)


def _never(time: float) -> float:
    """Return when a load without corners has its next one, s."""
    return math.inf


def _function(found: Any) -> Any:
    """Return the contents of Exudyn's getters of user functions, or 0 where nothing is set."""
    return found["function"] if isinstance(found, dict) else 0


def most_limiting(counts: list[int], tries: int) -> int | None:
    """Return which joint limits most steps, if joints together limit half of them.

    The two ends of a guide, or two pins, share them: each may have less than half.

    Args:
        counts: of tries that each joint has limited.
        tries: in all.
    """
    if not counts or sum(counts) < 0.5 * tries:
        return None
    return counts.index(max(counts))
