"""Advance any assembled Exudyn system with a tolerance instead of a step."""

import time as clock
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager

import exudyn as exu
from threadpoolctl import threadpool_limits

from exu_press.integrate.monitor import Monitor
from exu_press.integrate.outcome import Advice, Outcome, how_it_ended
from exu_press.integrate.problem import Problem
from exu_press.integrate.scales import Scales
from exu_press.integrate.settings import Task, Tuning, prepared, refuse_unusable
from exu_press.progress import Progress

__all__ = ["solve_dynamic"]

NO_SCALES = Scales()
DEFAULTS = Tuning()


def _never(time: float) -> float:
    """Return when a load without corners has its next one, s."""
    return float("inf")


def solve_dynamic(
    mbs: exu.MainSystem,
    settings: exu.SimulationSettings,
    *,
    tolerance: float | None = 1e-3,
    scales: Scales = NO_SCALES,
    tuning: Tuning = DEFAULTS,
    next_corner: Callable[[float], float] = _never,
    bodies: Mapping[int, tuple[str, float]] | None = None,
    advice: Callable[[Problem, bool], Advice] = Advice,
    max_steps: int = 1_000_000,
    quiet: bool = True,
) -> Outcome:
    """Do what `mbs.SolveDynamic(settings)` does, with a tolerance instead of a step.

    Exudyn's own generalized-alpha advances the system, from `startTime` to `endTime` of the
    settings, whose output, sensors, linear solver and spectral radius count. The largest step is
    the time over `numberOfSteps`, the first one `initialStepSize` if that is set, the smallest one
    `minimumStepSize`. The system may have rigid and flexible bodies in the plane and in space,
    constraints, springs, loads, user functions, first-order coordinates, data variables, and the
    clearance joints of this package; user functions of the system (pre-step, post-step,
    post-Newton, residual) are called as ever. Settings and user functions are put back afterwards;
    the solver is left in `mbs.sys["dynamicSolver"]`.

    Args:
        mbs: the system, assembled.
        settings: Exudyn's.
        tolerance: of the run, relative: velocities to the largest speed, eccentricities to their
            clearances; from 1e-8 to 0.1. None takes fixed steps of the settings' size.
        scales: what errors are relative to, where they are not to be found from the motion.
        tuning: the numbers of step control, to vary them.
        next_corner: time (s) -> the next instant at which a load has a corner, s, or infinity;
            steps end on them.
        bodies: node number -> name and mass (kg) of its body; nodes that are not named have no say
            in errors. None: all nodes have one.
        advice: makes the words for early stops.
        max_steps: a run that would need more, repeated ones too, stops.
        quiet: False shows the progress on standard error.

    Returns:
        How the run ended, why, what to change, and what it took. After an early stop too; the
        sensors hold what was computed.

    Raises:
        InputError: the system is not assembled, there is nothing to solve, the settings ask for
            what has no error estimate, or a joint starts with a film's surfaces in touch or a
            contact deeper than its laws hold; the system is left as it was.
        exudyn.ExudynError: a user function failed.
    """
    refuse_unusable(settings, tolerance)
    problem = Problem.of(mbs, bodies)
    words = advice(problem, tolerance is not None)
    if problem.joints is not None:
        problem.joints.refuse_start(words.joint)
    task = Task(problem, settings, tolerance, scales, tuning)
    solver, failure = task.solver, ""
    with Progress("run", task.end - task.start, quiet=quiet) as progress:
        monitor = Monitor(task, next_corner, progress, max_steps)
        mbs.sys["dynamicSolver"], mbs.sys["simulationSettings"] = solver, settings
        begun = clock.perf_counter()
        # matrices of a hundred rows: further threads only wait for each other
        with (
            monitor.attached(),
            prepared(settings, problem, task.smallest),
            _silent_console(),
            threadpool_limits(1),
        ):
            try:
                if not solver.SolveSystem(mbs, settings):
                    failure = solver.GetErrorString()
            except exu.ExudynError as error:
                failure = str(error)
                if "USER FUNCTION" in failure:  # an error in our own code is no failure of Newton's
                    raise
        wall_time = clock.perf_counter() - begun
        reached = problem.data.GetTime()
        progress.update(reached - task.start)
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


@contextmanager
def _silent_console() -> Iterator[None]:
    """Keep Exudyn's own messages off the console; the outcome says what happened."""
    before = exu.config.printToConsole
    exu.config.printToConsole = False
    try:
        yield
    finally:
        exu.config.printToConsole = before
