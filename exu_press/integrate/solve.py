"""Advance any assembled Exudyn system with a tolerance instead of a step, and say how it ended.

The words of `Advice` are those for any Exudyn system. A scene's own (`exu_press.solving`) name its
keys.
"""

import math
import time as clock
import warnings
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager, nullcontext
from dataclasses import dataclass
from enum import Enum
from typing import Any

import exudyn as exu
import numpy as np

from exu_press.errors import InputError
from exu_press.integrate.controller import Controller
from exu_press.integrate.monitor import Monitor
from exu_press.integrate.problem import Node, Problem
from exu_press.integrate.scales import ErrorScales
from exu_press.integrate.settings import SolverTuning, Task, prepared, refuse_unusable
from exu_press.integrate.stepping import Unresolved
from exu_press.joints.joint import ClearanceJoint
from exu_press.numerics.threads import one_thread
from exu_press.terminal.progress import Progress

__all__ = ["ARRIVED", "Advice", "Outcome", "SolverStatus", "solve_dynamic"]

NO_SCALES = ErrorScales()
DEFAULTS = SolverTuning()

SPENT = 1e-3
"""Film thickness over clearance at which a run that gets no further has lost its film."""


FEW = 80
"""Equations up to which NumPy solves them in one thread by itself."""

EXUDYN_ENDS = 1e-10
"""Before its end, at most how early Exudyn ends a run, s."""


ARRIVED = "arrived"
"""A watch's word for a run that has reached its aim: it is completed."""


class SolverStatus(Enum):
    """The end of a run; all but COMPLETED have exit status 3.

    UNDER_RESOLVED reached its end too, but its steps did not resolve its impacts: its peaks are not
    to be trusted. The others are early stops.
    """

    COMPLETED = "completed"
    UNDER_RESOLVED = "under-resolved"
    INTERRUPTED = "interrupted"
    STALLED = "stalled"
    FILM_BROKE_DOWN = "film broke down"
    STEP_TOO_SMALL = "step below minimum"
    TOO_MANY_STEPS = "too many steps"
    NOT_CONVERGED = "not converged"


@dataclass(frozen=True)
class Outcome:
    """SolverStatus, reason and statistics of an integration.

    Attributes:
        status: how it ended.
        reason: when, where, why, and what to try; empty when completed.
        end_time: the time reached, s.
        wall_time: the integration alone, s.
        steps: accepted steps.
        rejected_steps: steps that were repeated with half the size.
        newton_iterations: of all steps.
        law_evaluations: how often the clearance joints' forces were asked for.
    """

    status: SolverStatus
    reason: str
    end_time: float
    wall_time: float
    steps: int
    rejected_steps: int
    newton_iterations: int
    law_evaluations: int

    def check(self) -> "Outcome":
        """Return this outcome where the run was completed.

        Raises:
            RuntimeError: it was not; with the reason.
        """
        if self.status is not SolverStatus.COMPLETED:
            raise RuntimeError(f"{self.status.value}: {self.reason}")
        return self


class Advice:
    """Words for the places and the settings of a system."""

    def __init__(self, problem: Problem, by_tolerance: bool) -> None:
        """Speak of a problem, stepped by tolerance or with fixed steps."""
        self.problem, self.by_tolerance = problem, by_tolerance

    @property
    def setting(self) -> str:
        """The key that makes steps larger or smaller."""
        return "tolerance" if self.by_tolerance else "step"

    def place(self, time: float) -> str:
        """Return where the run was at a time, s."""
        return f"at t = {time:.6g} s"

    def joint(self, joint: ClearanceJoint) -> str:
        """Return the name of a clearance joint."""
        assert self.problem.joints is not None
        return self.problem.joints.number(joint)

    def film(self) -> str:
        """Return the cure for a film that broke down."""
        return "a mixed film (contact=, asperity_onset=), or a larger viscosity or length"

    def smallest(self) -> str:
        """Return what helps where steps became too small."""
        return "a larger tolerance or a smaller settings.timeIntegration.minimumStepSize"

    def budget(self) -> str:
        """Return what helps where too many steps were needed."""
        return f"an earlier end time, a larger {self.setting} or max_steps"

    def long(self, step: float, joint: ClearanceJoint | None) -> str:
        """Return why a run of such a mean step, s, is long, and what makes it shorter.

        Args:
            step: s.
            joint: that limits most steps, if one does.
        """
        words = f"steps of {step:.2g} s"
        if joint is not None:
            words += f", as {self.joint(joint)} needs them{self.stiff(joint)}"
        return f"{words}; a larger {self.setting} makes it shorter"

    def stiff(self, joint: ClearanceJoint) -> str:
        """Return which keys make a joint need small steps, or nothing."""
        return ""

    def convergence(self) -> str:
        """Return what helps where Newton's method did not converge."""
        if self.by_tolerance:
            return f"a smaller {self.setting}"
        return f"another {self.setting}, or a tolerance instead"

    def redundancy(self, redundant: int) -> str:
        """Return what helps where so many constraints say the same as others."""
        return (
            f"{redundant} constraint{'s say' if redundant > 1 else ' says'} the same as others: "
            "leave out the redundant ones, or settings.linearSolver.solverType = EigenDense with "
            "ignoreSingularJacobian = True"
        )

    def cause(self) -> str:
        """Return what is known of the system that explains why it does not get on, or nothing."""
        function: Any = self.problem.mbs.GetPreStepUserFunction()
        if function != 0:
            return " (a pre-step function that changes constraints: offsetUserFunction instead)"
        return " (or no offset that jumps)" if self.problem.untold_rates else ""

    def resolution(self, worst: Unresolved) -> str:
        """Return what resolves a run that leapt over its impacts."""
        return f"a {self.setting} ten times smaller"

    def announce(self, outcome: Outcome) -> None:
        """Warn of an outcome that a script may go on without looking at."""
        if outcome.status not in (SolverStatus.COMPLETED, SolverStatus.INTERRUPTED):
            text = f"solve_dynamic: {outcome.status.value}: {outcome.reason}"
            warnings.warn(text, stacklevel=3)


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
    event: Callable[[exu.MainSystem, float], float] | None = None,
    bodies: Mapping[int, tuple[str, float]] | None = None,
    advice: Callable[[Problem, bool], Advice] = Advice,
    max_steps: int = 1_000_000,
    update_initial_values: bool = False,
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
            function is called once for each of them, with its end, as in fixed steps of that size:
            what a controller sets is held. None: the largest step. 0.0: before every step, as are
            always functions that change what constraints prescribe.
        event: function (system, time in s) -> number; steps end where it changes its sign, within
            a millionth of the largest step. Not with fixed steps.
        bodies: node number -> name and mass (kg) of its body; nodes that are not named are
            excluded from errors. None: none is.
        advice: makes the words for early stops.
        max_steps: a run that would need more, repeated ones too, stops.
        update_initial_values: whether the next run starts where this one ends, as Exudyn's
            `updateInitialValues`.
        quiet: False shows the progress on standard error.

    Returns:
        How the run ended, why, what to change, and what it took. After an early stop too, of which
        a warning tells as well; the sensors hold what was computed.

    Raises:
        InputError: the system is not assembled, there is nothing to solve, the settings ask for
            what has no error estimate, a joint starts with a film's surfaces in touch or a
            contact deeper than its laws hold, or the start is far off a constraint; the system is
            left as it was.
        exudyn.ExudynError: a user function failed.
    """
    refuse_unusable(settings, tolerance, sample)
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
    task = Task(problem, settings, tolerance, scales, tuning, absolute)
    solver, failure = task.solver, ""
    with Progress("run", task.end - task.start, quiet=quiet) as progress:
        monitor = Monitor(
            task, next_corner, watch, progress, max_steps, sample, event, words.long, controller
        )
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
                if not solved:
                    failure = solver.GetErrorString()
            except exu.ExudynError as error:
                failure = str(error)
                if "USER FUNCTION" in failure:  # an error in our own code is no failure of Newton's
                    raise
        wall_time = clock.perf_counter() - begun
        reached = problem.data.GetTime()
        progress.update(reached - task.start)
    if monitor.far_off:
        raise InputError(monitor.far_off)
    if update_initial_values:
        _start_from_here(mbs)
    status, reason = _how_it_ended(task, monitor, words, time=reached, failure=failure)
    outcome = Outcome(
        status=status,
        reason=reason,
        end_time=reached,
        wall_time=wall_time,
        steps=monitor.steps,
        rejected_steps=monitor.tries - monitor.steps,
        newton_iterations=solver.it.newtonStepsCount,
        law_evaluations=problem.joints.evaluations if problem.joints else 0,
    )
    words.announce(outcome)
    if task.scales.unseen:
        warnings.warn(
            "solve_dynamic: the system is taken to be at rest: nothing moved by more than "
            f"{task.scales.rest:.2g} m/s, as rounded positions may, and errors were not judged; "
            "fixed steps (tolerance=None) follow such a motion",
            stacklevel=2,
        )
    return outcome


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


def _how_it_ended(
    task: Task, monitor: Monitor, advice: Advice, *, time: float, failure: str
) -> tuple[SolverStatus, str]:
    """Return status and reason of a run.

    Args:
        task: that was solved.
        monitor: of the run.
        advice: words for what to try.
        time: reached, s.
        failure: message of Exudyn, if it failed.
    """
    problem, smallest = task.problem, task.smallest
    gone = (time - task.start) / (task.end - task.start)
    exudyn_ended = not failure and 0.0 < task.end - time <= EXUDYN_ENDS and monitor.go_on
    if gone >= 1.0 - 1e-9 or exudyn_ended or monitor.stalled == ARRIVED:
        worst = monitor.resolution.worst() if monitor.resolution is not None else None
        if worst is None:
            return SolverStatus.COMPLETED, ""
        return SolverStatus.UNDER_RESOLVED, (
            f"under-resolved {advice.place(worst.time)}: {worst.jump:.0%} of the largest inertia "
            f"force ({problem.nodes[worst.node].name}) within a step of {worst.step:.2g} s; peaks "
            f"are the step's; try {advice.resolution(worst)}"
        )
    if monitor.stalled:
        return SolverStatus.STALLED, monitor.stalled
    where = advice.place(time)
    if monitor.interrupted:
        return SolverStatus.INTERRUPTED, f"interrupted {where}"
    if not monitor.go_on:
        return SolverStatus.INTERRUPTED, f"stopped by a user function {where}"
    if monitor.over_budget:
        return SolverStatus.TOO_MANY_STEPS, (
            f"{monitor.max_steps} steps were used up {where}, {gone:.1%} of the run; try "
            f"{advice.budget()}{advice.cause()}"
        )
    for joint, ratio in _spent_films(problem):
        return SolverStatus.FILM_BROKE_DOWN, (
            f"film broke down {where}, eccentricity ratio {ratio:.4f} ({advice.joint(joint)}); "
            f"try {advice.film()}"
        )
    busiest = _busiest_joint(problem, advice)
    if not monitor.control.error <= 1.0:
        cure = _redundancy(task, monitor, advice) or f"try {advice.smallest()}{advice.cause()}"
        return SolverStatus.STEP_TOO_SMALL, (
            f"the tolerance needs a step below {smallest:.2g} s {where}{busiest}"
            f"{_unfit_start(monitor)}; {cure}"
        )
    found = _what_is_wrong(task, monitor, advice, time)
    if found:
        return SolverStatus.NOT_CONVERGED, f"Newton's method did not converge {where}: {found}"
    said = f" [{failure.strip().splitlines()[0]}]" if failure.strip() else ""
    return SolverStatus.NOT_CONVERGED, (
        f"Newton's method did not converge {where}{busiest}, down to a step of {smallest:.2g} s; "
        f"try {advice.convergence()}{advice.cause()}{said}"
    )


def _what_is_wrong(task: Task, monitor: Monitor, advice: Advice, time: float) -> str:
    """Return what of a system keeps Newton's method from converging after a time, s, or nothing."""
    problem = task.problem
    if problem.joints is None:  # whose films may have forces beyond all numbers
        for node in _without_forces(task, time):
            return f"the force on {node.name} is no number there; check loads and user functions"
    redundancy = _redundancy(task, monitor, advice)
    if redundancy:
        return redundancy
    if monitor.without_mass and not monitor.steps:
        names = (
            n.name for n, m in zip(problem.nodes, task.scales.masses, strict=True) if m == math.inf
        )
        return f"nothing holds the coordinates without mass ({', '.join(names)})"
    if problem.switching and task.solver.it.discontinuousIteration > 1:
        return (
            "contacts or friction of Exudyn's switch to and fro in steps of any size; try less "
            "stiffness, more damping, friction that is regularised over a wider zone of speeds "
            "(dryFrictionProportionalZone), or settings.timeIntegration.discontinuous."
            "ignoreMaxIterations = True, with which steps are taken as such switches leave them"
        )
    return ""


def _redundancy(task: Task, monitor: Monitor, advice: Advice) -> str:
    """Return what to do about constraints that say the same, or nothing."""
    if task.problem.mbs.sys["simulationSettings"].linearSolver.ignoreSingularJacobian:
        return ""
    redundant = monitor.constraints.redundant()
    return advice.redundancy(redundant) if redundant else ""


def _unfit_start(monitor: Monitor) -> str:
    """Return what a first step tells that no size makes good, or nothing."""
    jump = monitor.first_jump()
    if not 0.0 < jump < math.inf:
        return ""
    return (
        f", as its first step changes a speed by {jump:.2g} m/s: the start does not fit what "
        "constraints and functions ask for right after it"
    )


def _without_forces(task: Task, time: float) -> Iterator[Node]:
    """Yield the nodes whose forces are no numbers right after a time, s."""
    problem, solver = task.problem, task.solver
    current, start = problem.current, problem.start
    tried = np.array(current.positions), np.array(current.velocities)
    current.positions[:], current.velocities[:] = start.positions, start.velocities
    problem.data.SetTime(time + task.smallest)
    solver.ComputeODE2RHS(problem.mbs)
    forces = np.array(solver.GetSystemResidual())[: len(current.positions)]
    problem.data.SetTime(time)
    current.positions[:], current.velocities[:] = tried
    for node in problem.nodes:
        if not np.isfinite(forces[node.start : node.start + node.size]).all():
            yield node


def _spent_films(problem: Problem) -> Iterator[tuple[ClearanceJoint, float]]:
    """Yield the films that end the run, with their eccentricity ratios at its end."""
    if problem.joints is None:
        return
    for joint in problem.joints.joints:
        if joint.contact_onset < math.inf:
            continue  # what lies beyond the film is in its model
        if joint.outside is not None:
            yield joint, joint.outside
        else:
            gap = problem.joints.state(joint).gap
            if gap < SPENT * joint.clearance:
                yield joint, 1.0 - gap / joint.clearance


def _busiest_joint(problem: Problem, advice: Advice) -> str:
    """Return in words which clearance joint carries the largest force at the end, if one does."""
    if problem.joints is None:
        return ""
    states = [(math.hypot(*problem.joints.state(j).force), j) for j in problem.joints.joints]
    force, joint = max(states, key=lambda s: s[0] if math.isfinite(s[0]) else -1.0)
    carries = f"carrying {force:.3g} N" if math.isfinite(force) else "whose laws give no numbers"
    return f", {advice.joint(joint)} {carries}"
