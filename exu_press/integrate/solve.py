"""Advance any assembled Exudyn system with a tolerance instead of a step."""

import time as clock
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from typing import Any

import exudyn as exu
from threadpoolctl import threadpool_limits

from exu_press.integrate.constraints import (
    LOOK_AHEAD,
    Constraints,
    StepChange,
    fit_start,
    start_rates,
)
from exu_press.integrate.error import StepError
from exu_press.integrate.flexible_jacobian import FlexibleJacobian
from exu_press.integrate.monitor import Monitor, Resolution
from exu_press.integrate.newton import Newton
from exu_press.integrate.outcome import Advice, Outcome, how_it_ended
from exu_press.integrate.problem import Problem, weights
from exu_press.integrate.scales import FoundScales, Scales
from exu_press.integrate.settings import Tuning, prepared, refuse_unusable
from exu_press.integrate.stepping import FixedSteps, StepControl
from exu_press.progress import Progress

__all__ = ["solve_dynamic"]

FIXED_STEPS = 5e-5
"""The tolerance whose Newton's method fixed steps have."""

MOST_HALVED = 2.0**10
"""How often over a fixed step is halved where Newton's method fails."""

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
    integration = settings.timeIntegration
    start, end = integration.startTime, integration.endTime
    largest = (end - start) / integration.numberOfSteps
    films = problem.joints is not None and problem.joints.lubricated
    smallest = integration.minimumStepSize
    room = 10.0 * smallest  # to repeat a film's first step in, before rounding shows
    if tolerance is None:
        smallest = largest / MOST_HALVED
    solver: Any = exu.MainSolverImplicitSecondOrder()  # whose type stub forgets `self`
    accuracy = FIXED_STEPS if tolerance is None else tolerance
    found = FoundScales(scales, problem.length)
    jacobian = None
    if problem.modal_stiffness:
        jacobian = FlexibleJacobian(mbs, solver, problem.joints, tuning)
    newton = Newton(
        mbs,
        solver,
        problem.joints,
        found,
        accuracy,
        tuning,
        problem.nodes,
        jacobian,
    )
    constraints = Constraints(mbs, solver, problem.untold_rates)
    step_change = StepChange(mbs, solver, constraints, smooth=problem.joints is None, tuning=tuning)
    film_start = step_change if films else None
    least = 0.1 * accuracy if problem.joints is None else 0.0
    resolution = Resolution(found, integration.generalizedAlpha.spectralRadius, least, tuning)
    control: StepControl | FixedSteps
    estimate = StepError(problem, solver, found, accuracy, largest, end - start, tuning)
    if tolerance is None:
        first = min(largest, max(2.0 * smallest, room)) if films else largest
        control = FixedSteps(
            largest, solver, newton, start=start, first=first, film_start=film_start
        )
    else:
        of_film = min(largest, max(tuning.first_step_of_film * largest, room))
        usual = of_film if films else tuning.first_step * largest
        first = integration.initialStepSize or usual
        control = StepControl(
            estimate,
            solver,
            newton,
            end=end,
            smallest=smallest,
            largest=largest,
            first=first,
            tuning=tuning,
            film_start=film_start,
            next_corner=next_corner,
        )
    data: Any = mbs.systemData

    def begin() -> None:
        """Look at the state from which the run starts."""
        if problem.first_order:
            start_rates(mbs, solver)
        solver.ComputeMassMatrix(mbs)
        if tolerance is not None:  # within a fixed step, motions may change by less than rounding
            ahead = LOOK_AHEAD * largest
            fitted = fit_start(mbs, solver, constraints, problem.length or 1.0, ahead)
            if fitted is not None:
                step_change.start_from(*fitted)
                estimate.start = fitted[0].tolist()
        inertias, masses = weights(problem.nodes, solver.GetSystemMassMatrix())
        now = data.GetODE2Coordinates_tt(exu.ConfigurationType.Current, False).tolist()
        found.begin(
            starts=[node.start for node in problem.nodes],
            inertias=inertias,
            masses=masses,
            velocities=data.GetODE2Coordinates_t(exu.ConfigurationType.Current, False).tolist(),
            accelerations=now,
            places=(
                data.GetODE2Coordinates(exu.ConfigurationType.Current, False)
                + data.GetODE2Coordinates(exu.ConfigurationType.Reference)
            ).tolist(),
            longest=largest,
            widest=problem.joints.widest if problem.joints is not None else 0.0,
        )
        newton.stepped(start, now)

    failure = ""
    with Progress("run", end - start, quiet=quiet) as progress:
        monitor = Monitor(
            begin, step_change, newton, control, resolution, progress, start, max_steps
        )
        mbs.sys["dynamicSolver"], mbs.sys["simulationSettings"] = solver, settings
        begun = clock.perf_counter()
        # matrices of a hundred rows: further threads only wait for each other
        with (
            monitor.attached(mbs),
            prepared(settings, problem, smallest),
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
        reached = mbs.systemData.GetTime()
        progress.update(reached - start)
    status, reason = how_it_ended(
        problem,
        monitor,
        words,
        gone=(reached - start) / (end - start),
        time=reached,
        error=control.error,
        smallest=smallest,
        failure=failure,
    )
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
