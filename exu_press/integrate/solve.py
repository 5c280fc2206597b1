"""Advance an assembled Exudyn system with a tolerance instead of a step, and say how it ended."""

import math
import time as clock
import warnings
from collections.abc import Callable, Mapping
from contextlib import nullcontext

import exudyn as exu

from exu_press.errors import InputError
from exu_press.integrate.controller import Controller
from exu_press.integrate.error import Criteria, default_criteria
from exu_press.integrate.monitor import RunMonitor
from exu_press.integrate.outcome import Outcome
from exu_press.integrate.scales import ErrorScales
from exu_press.integrate.system import System
from exu_press.integrate.task import SolverTuning, Task, prepared_settings, refuse_unusable
from exu_press.integrate.termination import Advice, termination
from exu_press.integrate.user_functions import UserFunctions
from exu_press.numerics.threads import one_thread
from exu_press.terminal.progress import Progress

__all__ = ["solve_dynamic"]

NO_SCALES = ErrorScales()
DEFAULTS = SolverTuning()

FEW = 80
"""Equations up to which NumPy solves them in one thread by itself."""


def solve_dynamic(
    mbs: exu.MainSystem,
    settings: exu.SimulationSettings,
    *,
    tolerance: float | None = 1e-3,
    scales: ErrorScales = NO_SCALES,
    tuning: SolverTuning = DEFAULTS,
    criteria: Criteria = default_criteria,
    controller: Controller | None = None,
    next_corner: Callable[[float], float] | None = None,
    watch: Callable[[float], str] = lambda time: "",
    sample: float | None = None,
    event: Callable[[exu.MainSystem, float], float] | None = None,
    bodies: Mapping[int, tuple[str, float]] | None = None,
    advice: Callable[[System, bool], Advice] = Advice,
    max_steps: int = 1_000_000,
    errors: bool = False,
    quiet: bool = True,
) -> Outcome:
    """Do what `mbs.SolveDynamic(settings)` does, with a tolerance instead of a step.

    Exudyn's own generalized-alpha advances the system, from `startTime` to `endTime` of the
    settings, whose output, sensors, linear solver and spectral radius (up to 0.95) count. The
    largest step is the time over `numberOfSteps`, the first one `initialStepSize` if that is set,
    the smallest one `minimumStepSize`. The steps follow what clearance joints of this package,
    rigid and flexible bodies, constraints, springs and smooth loads need; one warning names what
    else the system has. User functions of the system (pre-step, post-step, post-Newton, residual)
    are called as ever. Settings and user functions are put back afterwards; the solver is left in
    `mbs.sys["dynamicSolver"]`.

    Args:
        mbs: the system, assembled.
        settings: Exudyn's.
        tolerance: of the run, relative: velocities to the largest speed, eccentricities to their
            clearances; from 1e-8 to 0.1. None takes fixed steps of the settings' size.
        scales: of errors, where they are not those of the motion so far.
        tuning: the numbers of step control, to vary them.
        criteria: makes the criteria of the error of a step.
        controller: changes steps for their errors instead of `LimitedGrowth`, which has `safety`,
            `factor_min` and `factor_max` of the tuning.
        next_corner: time (s) -> the next instant at which a load has a corner, s, or infinity;
            steps end on them. None: there are none.
        watch: time (s) -> why the motion has come to its end there, or nothing; is asked after
            every step. ARRIVED ends a run that got where it was to go.
        sample: period of the system's pre-step function, s, as of a digital controller. Steps end
            on its multiples, and the function is called once for each period, with its end; what it
            sets is held. None: it is called before every try of a step, with the step's end, and a
            warning says that jumps of what it sets are not followed.
        event: function (system, time in s) -> number; steps end where it changes its sign, within
            a millionth of the largest step. Not with fixed steps.
        bodies: node number -> name and mass (kg) of its body; nodes that are not named are
            excluded from errors. None: none is.
        advice: makes the words for early stops.
        max_steps: a run that would need more, repeated ones too, stops.
        errors: whether the outcome has the run's error: its difference from a run with a quarter of
            the tolerance, which a copy of this process does meanwhile (on Linux). A warning tells
            of errors above ten tolerances. Files that user functions write are written twice.
        quiet: False shows the progress on standard error.

    Returns:
        How the run ended, why, what to change, and what it took. After an early stop too, of which
        a warning tells as well; the sensors hold what was computed.

    Raises:
        InputError: the system is not assembled, there is nothing to solve, the settings ask for
            what has no error estimate, a joint starts with a film's surfaces in touch or a
            contact deeper than its laws hold, the start is far off a constraint, or errors are
            asked for where this process cannot be copied; the system is left as it was.
        exudyn.ExudynError: a user function failed.
    """
    refuse_unusable(settings, tolerance, sample)
    if event is not None and tolerance is None:
        raise InputError("event: allowed with a tolerance, as fixed steps end on their grid")
    system = System.of_mbs(mbs, bodies)
    words = advice(system, tolerance is not None)
    if system.joints is not None:
        system.joints.refuse_start(words.joint)
    messages = list(words.about_system(held=bool(sample)))

    def run(
        tolerance: float | None, watch: Callable[[float], str], max_steps: int, quiet: bool
    ) -> tuple[Outcome, Task]:
        task = Task(system, settings, tolerance, scales, tuning)
        functions = UserFunctions(system, task.start, (sample or 0.0) * (not task.fixed))
        with Progress("run", task.end - task.start, quiet=quiet) as progress:
            monitor = RunMonitor(
                task,
                functions,
                functions.with_samples(next_corner or (lambda time: math.inf)),
                watch,
                progress,
                max_steps,
                criteria,
                event or (lambda mbs, time: 1.0),
                words.long,
                controller,
            )
            outcome = _run(task, settings, monitor, words, progress)
        messages.extend(words.about_start(task, monitor.start_changes))
        return outcome, task

    if errors:
        from exu_press.integrate.finer_run import with_error  # a run without them loads less

        outcome = with_error(run, system, settings, tolerance, watch, max_steps, quiet)
    else:
        outcome, _ = run(tolerance, watch, max_steps, quiet)
    messages.extend(words.about_outcome(outcome))
    for message in messages:
        warnings.warn(f"solve_dynamic: {message}", stacklevel=2)
    return outcome


def _run(
    task: Task,
    settings: exu.SimulationSettings,
    monitor: RunMonitor,
    words: Advice,
    progress: Progress,
) -> Outcome:
    """Return how a task ended that a monitor watches."""
    system, solver, failure = task.system, task.solver, ""
    mbs = system.mbs
    mbs.sys["dynamicSolver"], mbs.sys["simulationSettings"] = solver, settings
    begun = clock.perf_counter()
    # matrices of a hundred rows: further threads only wait for each other; to look for NumPy's
    # libraries takes as long as a hundred steps
    with (
        monitor.attach(),
        prepared_settings(settings, task),
        one_thread() if system.equations > FEW else nullcontext(),
    ):
        try:
            if not solver.SolveSystem(mbs, settings):
                failure = solver.GetErrorString()
        except exu.ExudynError as error:
            failure = str(error)
            if "USER FUNCTION" in failure:  # an error in our own code is no failure of Newton's
                raise
    wall_time = clock.perf_counter() - begun
    reached = system.data.GetTime()
    progress.update(reached - task.start)
    if monitor.refusal:
        raise InputError(monitor.refusal)
    status, reason = termination(task, monitor, words, time=reached, failure=failure)
    return Outcome(
        status=status,
        reason=reason,
        end_time=reached,
        wall_time=wall_time,
        steps=monitor.steps,
        rejected_steps=monitor.tries - monitor.steps,
        newton_iterations=solver.it.newtonStepsCount,
        law_evaluations=system.joints.evaluations if system.joints else 0,
    )
