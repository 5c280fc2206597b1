"""Advance any assembled Exudyn system with a tolerance instead of a step, and say how it ended."""

import math
import time as clock
import warnings
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager, nullcontext
from typing import Any

import exudyn as exu

from exu_press.errors import InputError
from exu_press.integrate.controller import Controller
from exu_press.integrate.ending import Advice, how_it_ended
from exu_press.integrate.monitor import Monitor
from exu_press.integrate.outcome import Outcome
from exu_press.integrate.problem import Problem
from exu_press.integrate.scales import ErrorScales, FoundScales
from exu_press.integrate.settings import SolverTuning, Task, prepared, refuse_unusable
from exu_press.numerics.threads import one_thread
from exu_press.terminal.progress import Progress

__all__ = ["solve_dynamic"]

NO_SCALES = ErrorScales()
DEFAULTS = SolverTuning()

FEW = 80
"""Equations up to which NumPy solves them in one thread by itself."""


def _nothing(time: float) -> str:
    """Return why a run is to end at a time, s."""
    return ""


def solve_dynamic(
    mbs: exu.MainSystem,
    settings: exu.SimulationSettings,
    *,
    tolerance: float | None = 1e-3,
    absolute: float = 0.0,
    scales: ErrorScales = NO_SCALES,
    tuning: SolverTuning = DEFAULTS,
    controller: Controller | None = None,
    next_corner: Callable[[float], float] | None = None,
    watch: Callable[[float], str] = _nothing,
    sample: float | None = None,
    hold: bool = False,
    event: Callable[[exu.MainSystem, float], float] | None = None,
    bodies: Mapping[int, tuple[str, float]] | None = None,
    advice: Callable[[Problem, bool], Advice] = Advice,
    max_steps: int = 1_000_000,
    update_initial_values: bool = False,
    errors: bool = False,
    quiet: bool = True,
) -> Outcome:
    """Do what `mbs.SolveDynamic(settings)` does, with a tolerance instead of a step.

    Exudyn's own generalized-alpha advances the system, from `startTime` to `endTime` of the
    settings, whose output, sensors, linear solver and spectral radius (up to 0.95) count. The
    largest step is the time over `numberOfSteps`, the first one `initialStepSize` if that is set,
    the smallest one `minimumStepSize`. The system may have rigid and flexible bodies in the plane
    and in space, constraints, joints that slide along cables, springs, loads, user functions,
    first-order coordinates, data variables, and the clearance joints of this package; user
    functions of the system (pre-step, post-step, post-Newton, residual) are called as ever.
    Settings and user functions are put back afterwards; the solver is left in
    `mbs.sys["dynamicSolver"]`.

    Args:
        mbs: the system, assembled.
        settings: Exudyn's.
        tolerance: of the run, relative: velocities to the largest speed, eccentricities to their
            clearances; from 1e-8 to 0.1. None takes fixed steps of the settings' size.
        absolute: velocity, m/s: errors below it do not count, however small the largest speed. A
            vibration of a twentieth of it costs no steps.
        scales: of errors, where they are not to be found from the motion.
        tuning: the numbers of step control, to vary them.
        controller: changes steps for their errors instead of `LimitedGrowth`, which has `safety`
            and `factor_max` of the tuning.
        next_corner: time (s) -> the next instant at which a load has a corner, s, or infinity;
            steps end on them. None: there are none, and rigid bodies in the plane keep their energy
            as steps change.
        watch: time (s) -> why the motion has come to its end there, or nothing; is asked after
            every step. ARRIVED ends a run that got where it was to go.
        sample: period of the system's pre-step function, s. Steps end on its multiples, and the
            function is called once for each period, with its end, as in fixed steps of that size.
            None: the largest step. 0.0: before every step. A function of time that moves
            constraints is called wherever these are asked.
        hold: whether numbers that a pre-step function sets are held from call to call, as by a
            digital controller. False: they go over from one call to the next, as in fixed steps.
        event: function (system, time in s) -> number; steps end where it changes its sign, within
            a millionth of the largest step. Not with fixed steps.
        bodies: node number -> name and mass (kg) of its body; nodes that are not named are
            excluded from errors. None: none is.
        advice: makes the words for early stops.
        max_steps: a run that would need more, repeated ones too, stops.
        update_initial_values: whether the next run starts where this one ends, as Exudyn's
            `updateInitialValues`.
        errors: whether the outcome has the run's error: its difference from a run with a quarter of
            the tolerance, which a copy of this process does meanwhile (on Linux). With a second
            core it takes two times as long. A warning tells of errors above ten tolerances. The
            copy writes no files; those that user functions write themselves are written twice.
        quiet: False shows the progress on standard error.

    Returns:
        How the run ended, why, what to change, and what it took. After an early stop too, of which
        a warning tells as well; the sensors hold what was computed.

    Raises:
        InputError: the system is not assembled, there is nothing to solve, the settings ask for
            what has no error estimate, a joint starts with a film's surfaces in touch or a
            contact deeper than its laws hold, the start is far off a constraint, a force is
            another one when it is asked for again, or errors are asked for where this process
            cannot be copied; the system is left as it was.
        exudyn.ExudynError: a user function failed.
    """
    refuse_unusable(settings, tolerance, sample, hold=hold)
    if not 0.0 <= absolute < math.inf or (absolute and tolerance is None):
        raise InputError(
            f"absolute = {absolute!r}: allowed is a velocity in m/s, or 0.0; with fixed steps 0.0"
        )
    if event is not None and tolerance is None:
        raise InputError("event: allowed with a tolerance, as fixed steps end on their grid")
    problem = Problem.of(mbs, bodies)
    words = advice(problem, tolerance is not None)
    if problem.joints is not None:
        problem.joints.refuse_start(words.joint)

    period, told = _period(mbs, settings, sample), list[str]()

    def run(
        tolerance: float | None,
        watch: Callable[[float], str],
        max_steps: int,
        quiet: bool,
    ) -> tuple[Outcome, FoundScales]:
        task = Task(problem, settings, tolerance, scales, tuning, absolute)
        with Progress("run", task.end - task.start, quiet=quiet) as progress:
            monitor = Monitor(
                task,
                next_corner,
                watch,
                progress,
                max_steps,
                period,
                event,
                words.long,
                controller,
                hold=hold,
            )
            outcome = _run(task, settings, monitor, words, progress)
        told.extend(words.about_start(monitor.fitted, task))
        jumps = (0, 0) if hold else monitor.pushed_by_calls
        told.extend(words.about_functions(jumps, (monitor.set_behind_steps, monitor.steps)))
        return outcome, task.scales

    if errors:
        from exu_press.integrate.run_error import with_error  # a run without them loads less

        outcome, found = with_error(
            run, problem, settings, tolerance, period, watch, max_steps, quiet
        )
    else:
        outcome, found = run(tolerance, watch, max_steps, quiet)
    if update_initial_values:
        _start_from_here(mbs)
    told.extend(words.about_outcome(outcome))
    if found.unseen:
        told.append(
            "the system is taken to be at rest: nothing moved by more than "
            f"{found.rest:.2g} m/s, as rounded positions may, and errors were not judged; longer "
            "steps, or fixed ones (tolerance=None), follow such a motion"
        )
    for text in told:
        warnings.warn(f"solve_dynamic: {text}", stacklevel=2)
    return outcome


def _period(mbs: exu.MainSystem, settings: exu.SimulationSettings, sample: float | None) -> float:
    """Return the period of a pre-step function, s, or 0.0 where there is none."""
    function: Any = mbs.GetPreStepUserFunction()
    if function == 0:
        return 0.0
    if sample is not None:
        return sample
    integration = settings.timeIntegration
    return (integration.endTime - integration.startTime) / integration.numberOfSteps


def _run(
    task: Task,
    settings: exu.SimulationSettings,
    monitor: Monitor,
    words: Advice,
    progress: Progress,
) -> Outcome:
    """Return how a task ended that a monitor watches.

    Raises:
        InputError: the start is far off a constraint, or a force differs when asked for again.
    """
    problem, solver, failure = task.problem, task.solver, ""
    mbs = problem.mbs
    mbs.sys["dynamicSolver"], mbs.sys["simulationSettings"] = solver, settings
    begun = clock.perf_counter()
    # matrices of a hundred rows: further threads only wait for each other; to look for NumPy's
    # libraries takes as long as a hundred steps
    with (
        monitor.attached(),
        prepared(settings, task),
        _silent_console(),
        one_thread() if problem.equations > FEW else nullcontext(),
    ):
        try:
            solved = solver.SolveSystem(mbs, settings)
            if monitor.without_mass:
                settings.timeIntegration.generalizedAlpha.computeInitialAccelerations = False
                solved = solver.SolveSystem(mbs, settings)
            if monitor.again:
                solved = solver.SolveSystem(mbs, settings)
            if not solved:
                failure = solver.GetErrorString()
        except exu.ExudynError as error:
            failure = str(error)
            if "USER FUNCTION" in failure:  # an error in our own code is no failure of Newton's
                raise
    wall_time = clock.perf_counter() - begun
    reached = problem.data.GetTime()
    progress.update(reached - task.start)
    if monitor.refused:
        raise InputError(monitor.refused)
    status, reason = how_it_ended(task, monitor, words, time=reached, failure=failure)
    return Outcome(
        status=status,
        reason=reason,
        end_time=reached,
        wall_time=wall_time,
        steps=monitor.steps,
        rejected_steps=monitor.tries - monitor.steps,
        newton_iterations=solver.it.newtonStepsCount,
        law_evaluations=problem.joints.evaluations if problem.joints else 0,
    )


def _start_from_here(mbs: exu.MainSystem) -> None:
    """Make the current state the one from which the next run starts."""
    data: Any = mbs.systemData
    initial = exu.ConfigurationType.Initial
    data.SetSystemState(systemStateList=data.GetSystemState(), configuration=initial)
    data.SetODE2Coordinates_tt(coordinates=data.GetODE2Coordinates_tt(), configuration=initial)


@contextmanager
def _silent_console() -> Iterator[None]:
    """Keep Exudyn's own messages off the console; the outcome says what happened."""
    before = exu.config.printToConsole
    exu.config.printToConsole = False
    try:
        yield
    finally:
        exu.config.printToConsole = before
