"""The task of a run: its numbers, and the settings of Exudyn that it needs, with reasons.

`solve_dynamic(..., tuning=SolverTuning(safety=0.8))` varies a number; `scripts/ablation.py` prints
what each of them buys in error and run time. Exudyn's settings are put back after the run.
"""

import math
import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any

import exudyn as exu

from exu_press.errors import InputError
from exu_press.integrate.problem import Problem
from exu_press.integrate.scales import ErrorScales, FoundScales

__all__ = [
    "SAME",
    "SWITCHED",
    "SolverTuning",
    "Task",
    "inertia_factor",
    "prepared",
    "refuse_unusable",
]

SAME = 1e-6
"""Steps that differ by less, relative, are one size: the clock's last digits."""

FIXED_STEPS = 5e-5
"""The tolerance whose Newton's method fixed steps have."""

MOST_HALVED = 2.0**10
"""Number of halvings of a fixed step where Newton's method fails."""

RELATIVE_RESIDUAL = 1e-10
"""Residual over the first one, at which Newton's method ends if it cannot get further."""

LARGE = 20
"""Coordinates of a system from which on a Jacobian takes far longer than an iteration."""

TOLERANCES = 1e-8, 0.1
"""Between these a tolerance means something."""

SWITCHED = 0.5
"""Above it a switch is iterated on: Exudyn's GeneralContact says 1 where a contact has opened or
closed, and its usual limit of 1 lets what has opened go on to pull."""

SHORTEST_RUN = 1e-7
"""Time of which the 1e-10 s by which Exudyn may end early are a thousandth, s."""

FIRST_STEP = 1.0 / 64.0
"""Over the largest one; with a film, `first_step_of_film`."""

FORESEEN = 100.0
"""How many times as long a run is at least as the time for which first accelerations foretell its
speeds. Where the largest step was the whole run, they did for all of it."""

IMPLICIT = "GeneralizedAlpha", "TrapezoidalIndex2"
"""Exudyn's solvers that take the same settings; the second one is the first with other numbers."""


LARGEST_RADIUS = 0.95
"""Spectral radius of generalized-alpha above which what alternates from step to step lasts for so
many steps that it would set their size."""

USUAL_RADIUS = 0.9
"""Spectral radius that is taken instead, and in the place of Newmark's method."""


@dataclass(frozen=True)
class SolverTuning:
    """The numbers of step control, error estimate, predictor and step change.

    All are ratios, unless a unit is named.

    Attributes:
        safety: error at which a step is aimed, of what it may be. The reserve saves repeated steps.
        factor_max: by what a step is lengthened at most. Steps that grow by half swing about what
            their errors ask for, and are a third more with a film.
        factor_max_at_start: the same without impacts, until an error first limits a step: the first
            one is a guess, and each change of a step takes as long as several steps. What such a
            change leaves is amplified longest: fivefold ones made twice the error of a chain.
        first_step_of_film: first step over the largest one with a film, which takes up its load
            within a microsecond or so: a longer step leaves an overshoot of 3 % in the first loads.
        many_steps: times tolerance^(-1/2), the number of steps of a run from which on each may
            miss less, as their errors add up (`exu_press.integrate.error`).
        foreseen: over the time so far, for how long velocities are believed to turn on likewise, to
            one side: errors of speeds add up to errors of places then. With 1 a rotor that a torque
            runs up is twice as far off; without a limit a bar that falls on a hinge, which might go
            on to turn, takes twice the steps.
        velocity_constant: of generalized-alpha's local error h^3 times the second derivative of the
            acceleration: 0.083 to 0.077 for spectral radii at infinity of 1 to 0.8, doubled.
        rounding: of positions and speeds, over the largest one, in each step: times 1 / (1 -
            spectral radius)^2, over the step's square, it is what alternates in accelerations.
            Measured at radii of 0.8 and 0.9 and steps of 2 and 10 us on a governor of rods and
            springs.
        beside_joints: allowed error of a body's velocity in a step of a system with clearance
            joints, over what an eccentricity may.
        penetration: allowed error of a penetration, over itself, as a part of what an
            eccentricity in free flight may be off by over the clearance. The impact that ends a
            damped contact hands the error on a thousandfold.
        vibrating: of the tolerance, what a body's velocity may be off by in a step where impacts
            leave flexible bodies vibrating at their own frequencies, which the estimate takes for
            an error.
        vibrating_penetration: instead of `penetration` there.
        modal_mass: change of the modes' mass, over that which keeps their frequencies
            (`exu_press.integrate.modal_mass`).
        kept_steps: within so many of the usual longest steps, 45 degrees of the crank, errors that
            a film keeps may add up to the tolerance.
        refit: a step shorter than this, over the one that constrained velocities fit, makes them
            fit anew.
    """

    safety: float = 0.4
    factor_max: float = 1.2
    factor_max_at_start: float = 3.0
    first_step_of_film: float = 1e-4
    many_steps: float = 10.0
    foreseen: float = 3.0

    velocity_constant: float = 2.0 / 12.0
    rounding: float = 4e-15
    beside_joints: float = 1.0 / 6.0
    penetration: float = 0.0625
    vibrating: float = 0.18
    vibrating_penetration: float = 0.6
    modal_mass: float = 1.0
    kept_steps: float = 30.0

    refit: float = 0.35


class Task:
    """A run as it is asked for.

    Attributes:
        problem: to be solved.
        solver: an exu.MainSolverImplicitSecondOrder, which is about to solve it.
        scales: of the motion.
        tuning: numbers.
        tolerance: of the run; with fixed steps, of Newton's method.
        absolute: errors of velocities below it do not count, m/s.
        fixed: whether steps are of one size.
        start: of the run, s.
        end: of the run, s.
        largest: step, s.
        usual: size of the longest steps of such a motion, s.
        smallest: step, s.
        no_shorter: up to which a step cannot be shorter, s: it is told as a difference of two
            times, whose last digits are rounded.
        first: step, s.
        impacts: whether bodies may strike each other, in clearance joints or Exudyn's contacts.
        every_jacobian: whether each step gets a fresh one: impacts change it all the time, and in
            small systems it costs little.
        spectral_radius: at infinity, of generalized-alpha.
        switches: Exudyn's settings of iterations on them.
        iterations: on switches, that a step is given at most.
        unsettled: whether a step counts whose switches have not settled by then.
    """

    def __init__(
        self,
        problem: Problem,
        settings: exu.SimulationSettings,
        tolerance: float | None,
        scales: ErrorScales,
        tuning: SolverTuning,
        absolute: float = 0.0,
    ) -> None:
        """Take a problem and what is asked of it."""
        integration = settings.timeIntegration
        self.problem, self.tuning = problem, tuning
        self.solver: Any = exu.MainSolverImplicitSecondOrder()  # whose type stub forgets `self`
        self.fixed = tolerance is None
        self.tolerance = FIXED_STEPS if tolerance is None else tolerance
        self.start, self.end = integration.startTime, integration.endTime
        self.spectral_radius = _spectral_radius(settings, self.fixed)
        self.largest = largest = (self.end - self.start) / integration.numberOfSteps
        self.usual = scales.step or largest
        self.smallest = integration.minimumStepSize
        room = 10.0 * self.smallest  # to repeat a first step in
        if self.fixed:
            self.smallest = largest / MOST_HALVED
            self.first = max(2.0 * self.smallest, room) if problem.lubricated else largest
        else:
            part = tuning.first_step_of_film if problem.lubricated else FIRST_STEP
            usual = max(part * largest, room)
            self.first = max(integration.initialStepSize or usual, self.smallest)
        self.first = min(self.first, largest)
        latest = max(abs(self.start), abs(self.end))
        self.no_shorter = self.smallest * (1.0 + SAME) + 2.0 * math.ulp(latest)
        self.impacts = problem.joints is not None or problem.switching
        costly = len(problem.reference) >= LARGE or problem.forces_in_python
        self.every_jacobian = self.fixed or self.impacts or not costly
        self.switches = integration.discontinuous
        self.iterations = self.switches.maxIterations if problem.switching else 1
        ignored = problem.switching and self.switches.ignoreMaxIterations
        self.unsettled = ignored and not self.fixed
        stir = tuning.rounding / (1.0 - min(self.spectral_radius, LARGEST_RADIUS)) ** 2
        self.absolute = absolute
        floor = absolute / self.tolerance
        foreseen = largest  # in clearance joints, less: until they are crossed
        if problem.joints is None:
            foreseen = min(largest, (self.end - self.start) / FORESEEN)
        self.scales = FoundScales(scales, problem, foreseen, self.first, stir, floor)


def inertia_factor(solver: Any) -> float:
    """Return by what masses count in Newton's matrix, (1 - alpha_m)/(1 - alpha_f)."""
    factor: float = (1.0 - solver.alphaM) / (1.0 - solver.alphaF)
    return factor


def refuse_unusable(
    settings: exu.SimulationSettings,
    tolerance: float | None,
    sample: float | None = None,
    *,
    hold: bool = False,
) -> None:
    """Refuse what cannot be integrated; warn where another method is taken than asked for.

    Raises:
        InputError: the tolerance or the period lies outside its range, the run has no end, or the
            integrator is not one of Exudyn's implicit ones.
    """
    integration = settings.timeIntegration
    low, high = TOLERANCES
    a_number = isinstance(tolerance, float | int)
    if tolerance is not None and not (a_number and low <= tolerance <= high):
        raise InputError(f"tolerance = {tolerance!r}: allowed is a number from {low:g} to {high:g}")
    start, end = integration.startTime, integration.endTime
    if not start < end < math.inf:
        raise InputError(
            f"settings.timeIntegration.endTime = {end!r}: allowed is a time after startTime = "
            f"{start!r} s"
        )
    if end - start < SHORTEST_RUN:
        raise InputError(
            f"settings.timeIntegration.endTime = {end!r}, startTime = {start!r}: allowed is a run "
            f"of {SHORTEST_RUN:g} s or more, as Exudyn may end it 1e-10 s early; count time in "
            "another unit"
        )
    if sample is not None and not 0.0 <= sample < math.inf:
        raise InputError(f"sample = {sample!r}: allowed is a period in seconds, or 0.0")
    if hold and sample == 0.0:
        raise InputError("hold = True: allowed with a period; sample = 0.0 has none")
    solver = str(integration.solverType).rsplit(".", 1)[-1]
    if solver not in IMPLICIT:
        raise InputError(
            f"settings.timeIntegration.solverType = {solver}: allowed is {IMPLICIT[0]}, whose "
            "local error is known"
        )
    alpha = integration.generalizedAlpha
    if not 0.0 < alpha.spectralRadius <= 1.0:
        raise InputError(
            "settings.timeIntegration.generalizedAlpha.spectralRadius = "
            f"{alpha.spectralRadius!r}: allowed is a number above 0.0, up to 1.0; with 0.0 no step "
            "can be changed without ringing"
        )
    radius = _spectral_radius(settings, tolerance is None)
    if _switched(settings):
        warnings.warn(
            "the settings ask for Newmark's method or constraints of index 2: solved with "
            f"{IMPLICIT[0]}, constraints of index 3 and spectralRadius = {radius:g}, whose local "
            "error is known",
            stacklevel=3,
        )
    elif radius != alpha.spectralRadius:
        warnings.warn(
            "settings.timeIntegration.generalizedAlpha.spectralRadius = "
            f"{alpha.spectralRadius:g}: solved with {radius:g}; above {LARGEST_RADIUS:g} "
            "accelerations that alternate behind an impact, or a change of the step, hardly fade",
            stacklevel=3,
        )


def _switched(settings: exu.SimulationSettings) -> bool:
    """Return whether the settings ask for another implicit method than ours."""
    integration = settings.timeIntegration
    alpha, solver = integration.generalizedAlpha, str(integration.solverType)
    return bool(alpha.useNewmark or alpha.useIndex2Constraints or not solver.endswith(IMPLICIT[0]))


def _spectral_radius(settings: exu.SimulationSettings, fixed: bool) -> float:
    """Return it; Newmark's method has none, and 1.0 does not damp constraints of index 3."""
    given: float = settings.timeIntegration.generalizedAlpha.spectralRadius
    replaced = _switched(settings) or (given > LARGEST_RADIUS and not fixed)
    return min(given, USUAL_RADIUS) if replaced else given


@contextmanager
def prepared(settings: exu.SimulationSettings, task: Task) -> Iterator[None]:
    """Set what step control needs in Exudyn's settings, and put everything back.

    With clearance joints one Jacobian a step: with Exudyn's default (one as long as it seems to
    converge) dry contact drifts by 4 % at 1e-4 s; a Jacobian an iteration costs more than the
    iterations it saves.

    A contact of ours opens and closes within Newton's iterations, so nothing is left to iterate on.
    The step control's word counts: above 1 the step is repeated. Data variables of Exudyn's own
    contacts and friction keep the iterations that the settings give them.

    Exudyn's own dense solver factorises its matrix in place, so that Eigen's dense one takes over.
    """
    integration = settings.timeIntegration
    newton, discontinuous = integration.newton, integration.discontinuous
    alpha = integration.generalizedAlpha
    linear = settings.linearSolver
    wanted: list[tuple[Any, str, Any]] = [
        (newton, "useModifiedNewton", True),
        (newton, "modifiedNewtonJacUpdatePerStep", task.every_jacobian),
        (newton, "modifiedNewtonContractivity", 0.5),
        (newton, "relativeTolerance", RELATIVE_RESIDUAL),
        (newton, "maxIterations", 25),
        (discontinuous, "ignoreMaxIterations", task.unsettled),
        (discontinuous, "iterationTolerance", min(discontinuous.iterationTolerance, SWITCHED)),
        (discontinuous, "maxIterations", task.iterations),
        (discontinuous, "useRecommendedStepSize", True),
        (integration, "adaptiveStep", True),
        (integration, "adaptiveStepDecrease", 0.5),
        (integration, "minimumStepSize", task.smallest),
        (integration, "adaptiveStepRecoverySteps", 2**30),  # growth is decided in `stepping`
        (integration, "verboseMode", 0),
        (alpha, "computeInitialAccelerations", alpha.computeInitialAccelerations),
        (alpha, "spectralRadius", task.spectral_radius),
        (alpha, "useNewmark", False),
        (alpha, "useIndex2Constraints", False),
    ]
    if linear.solverType == exu.LinearSolverType.EXUdense:
        wanted.append((linear, "solverType", exu.LinearSolverType.EigenDense))
    before = [(part, name, getattr(part, name)) for part, name, _ in wanted]
    try:
        for part, name, value in wanted:
            setattr(part, name, value)
        yield
    finally:
        for part, name, value in before:
            setattr(part, name, value)
