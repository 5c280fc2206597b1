"""The task of a run: its numbers, and the settings of Exudyn that it needs, with reasons.

`solve_dynamic(..., tuning=SolverTuning(safety=0.8))` varies a number; `scripts/ablation.py` prints
what each of them buys in error and run time. Exudyn's settings are put back after the run.
"""

import math
from collections.abc import Iterator, Sequence
from contextlib import AbstractContextManager, contextmanager
from dataclasses import dataclass
from typing import Any

import exudyn as exu

from exu_press.errors import InputError
from exu_press.integrate.scales import ErrorScales, RunningScales
from exu_press.integrate.system import System

__all__ = [
    "SAME",
    "SolverTuning",
    "Task",
    "inertia_factor",
    "prepared_settings",
    "refuse_no_run",
    "refuse_unusable",
    "set_meanwhile",
]

SAME = 1e-6
"""Steps that differ by less, relative, are one size: the clock's last digits."""

TOLERANCES = 1e-8, 0.1
"""Between these a tolerance means something."""

SHORTEST_RUN = 1e-7
"""Time of which the 1e-10 s by which Exudyn may end early are a thousandth, s."""

MOST_HALVED = 2.0**10
"""Number of halvings of a fixed step where Newton's method fails."""

LARGEST_RADIUS = 0.95
"""Spectral radius of generalized-alpha above which what alternates from step to step lasts for so
many steps that it would set their size."""

RELATIVE_RESIDUAL = 1e-10
"""Residual over the first one, at which Newton's method ends if it cannot get further."""


@dataclass(frozen=True)
class SolverTuning:
    """The numbers of step control, error estimate, predictor and step change.

    All are ratios, unless a unit is named.

    Attributes:
        safety: error at which a step is aimed, of what it may be: fewer steps are repeated.
        factor_max: by what a step is lengthened at most. Steps that grow by half swing about what
            their errors ask for, and are a third more with a film.
        factor_min: by what a repeated step is shortened at most.
        first_step: over the largest one, without films.
        first_step_of_film: the same with a film, which takes up its load within a microsecond or
            so: a longer step leaves an overshoot of 3 % in the first loads.
        shortest_first: a first step, at least, over the shortest one: it can be repeated with
            smaller ones.
        rounding: of positions and speeds, over the largest one, in each step: times 1 / (1 -
            spectral radius)^2, over the step's square, it is what alternates in accelerations.
        least_share: error of a step with clearance joints, at least, over the tolerance: below 1e-4
            impacts become no more.
        penetration: allowed error of a penetration, over itself, as a part of what an
            eccentricity in free flight may be off by over the clearance. The impact that ends a
            damped contact hands the error on a thousandfold.
        least_penetration: over the clearance, up to which a penetration counts as this.
        vibrating: share of a step in velocities, over the tolerance, where impacts leave flexible
            bodies vibrating, which the estimate takes for an error.
        vibrating_penetration: instead of `penetration` there.
        modal_mass: change of the modes' mass, over that which keeps their frequencies
            (`exu_press.integrate.modal_mass`).
        kept_steps: number of the usual longest steps, 45 degrees of the crank, within which errors
            that a film keeps may add up to the tolerance.
        taken_back: part of its last change that a film's force takes back if it oscillates with
            the method; the steps of a passage to the film's other side go one way.
        refit: a step shorter than this, over the one that constrained velocities fit, makes them
            fit anew.
        look_ahead: time between the instants at which rates of constraints are differenced, over
            the step.
        regularisation: compliance given to constraints, over that of the masses. Where two of them
            nearly say the same, a hundredth of it made 5e-11 m of the last digits of positions,
            which contacts took for a motion.
        newton_tolerance: part of the usual forces, over the tolerance, to which Newton's method
            balances them.
        roundoff_after_iterations: iterations of Newton's method after which it accepts what
            rounding leaves; most steps take one or two.
        max_extrapolation: over the last step, how far ahead its rate of change is believed by the
            predictor.
        largest_jump: change of an inertia force within one step, over the run's largest one, above
            which impacts are not resolved.
        fixed_steps: the tolerance whose Newton's method fixed steps have.
        coverage: stated error of a run over its difference from a run with a quarter of the
            tolerance. Where errors go with the tolerance, they are 4/3 of it; with this the stated
            ones cover the true ones in 60 of 63 of Exudyn's scripts.
    """

    safety: float = 0.4
    factor_max: float = 1.2
    factor_min: float = 0.05
    first_step: float = 1.0 / 64.0
    first_step_of_film: float = 1e-4
    shortest_first: float = 10.0

    rounding: float = 4e-15
    least_share: float = 1e-2
    penetration: float = 0.0625
    least_penetration: float = 1e-3
    vibrating: float = 1.08
    vibrating_penetration: float = 0.6
    modal_mass: float = 1.0
    kept_steps: float = 30.0
    taken_back: float = 0.25

    refit: float = 0.35
    look_ahead: float = 0.01
    regularisation: float = 1e-8

    newton_tolerance: float = 0.2
    roundoff_after_iterations: int = 4
    max_extrapolation: float = 2.0

    largest_jump: float = 0.65
    fixed_steps: float = 5e-5
    coverage: float = 10.0 / 3.0


class Task:
    """A run as it is asked for.

    Attributes:
        system: to be solved.
        solver: an exu.MainSolverImplicitSecondOrder, which is about to solve it.
        scales: of the motion.
        tuning: numbers.
        tolerance: of the run; with fixed steps, of Newton's method.
        fixed: whether steps are of one size.
        start, end: of the run, s.
        smallest, first, largest: step, s; usual is the size of the longest ones of such a motion.
        shortest_first: size of a first step that can be repeated with smaller ones, s; in shorter
            steps rounding turns the forces of films.
        no_shorter: up to which a step cannot be shorter, s: it is the difference of two times,
            whose last digits are rounded.
        spectral_radius: at infinity, of generalized-alpha.
    """

    def __init__(
        self,
        system: System,
        settings: exu.SimulationSettings,
        tolerance: float | None,
        scales: ErrorScales,
        tuning: SolverTuning,
    ) -> None:
        """Take a system and what is asked of it."""
        integration = settings.timeIntegration
        self.system, self.tuning = system, tuning
        self.solver: Any = exu.MainSolverImplicitSecondOrder()  # whose type stub forgets `self`
        self.fixed = tolerance is None
        self.tolerance = tuning.fixed_steps if tolerance is None else tolerance
        self.start, self.end = integration.startTime, integration.endTime
        self.spectral_radius = integration.generalizedAlpha.spectralRadius
        self.largest = largest = (self.end - self.start) / integration.numberOfSteps
        self.usual = scales.step or largest
        self.smallest = integration.minimumStepSize
        self.shortest_first = room = tuning.shortest_first * self.smallest
        if self.fixed:
            self.smallest = largest / MOST_HALVED
            self.first = max(2.0 * self.smallest, room) if system.has_film else largest
        else:
            fraction = tuning.first_step_of_film if system.has_film else tuning.first_step
            usual = max(fraction * largest, room)
            self.first = max(integration.initialStepSize or usual, self.smallest)
        self.first = min(self.first, largest)
        latest = max(abs(self.start), abs(self.end))
        self.no_shorter = self.smallest * (1.0 + SAME) + 2.0 * math.ulp(latest)
        rounding = tuning.rounding / (1.0 - min(self.spectral_radius, LARGEST_RADIUS)) ** 2
        self.scales = RunningScales(scales, system, largest, self.first, rounding)


def inertia_factor(solver: Any) -> float:
    """Return by what masses count in Newton's matrix, (1 - alpha_m)/(1 - alpha_f)."""
    factor: float = (1.0 - solver.alphaM) / (1.0 - solver.alphaF)
    return factor


def refuse_no_run(settings: exu.SimulationSettings, tolerance: float | None) -> None:
    """Refuse a tolerance outside its range, and a run without an end or a duration."""
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


def refuse_unusable(
    settings: exu.SimulationSettings,
    tolerance: float | None,
    sample: float | None = None,
) -> None:
    """Refuse an integrator without an error estimate, a run without an end, or a wrong period."""
    refuse_no_run(settings, tolerance)
    integration = settings.timeIntegration
    start, end = integration.startTime, integration.endTime
    if end - start < SHORTEST_RUN:
        raise InputError(
            f"settings.timeIntegration.endTime = {end!r}, startTime = {start!r}: allowed is a run "
            f"of {SHORTEST_RUN:g} s or more, as Exudyn may end it 1e-10 s early; count time in "
            "another unit"
        )
    if sample is not None and not 0.0 < sample < math.inf:
        raise InputError(f"sample = {sample!r}: allowed is a period in seconds, or None")
    alpha, solver = integration.generalizedAlpha, str(integration.solverType).rsplit(".", 1)[-1]
    if solver != "GeneralizedAlpha" or alpha.useNewmark or alpha.useIndex2Constraints:
        raise InputError(
            f"settings.timeIntegration.solverType = {solver}, generalizedAlpha.useNewmark = "
            f"{alpha.useNewmark}, .useIndex2Constraints = {alpha.useIndex2Constraints}: allowed is "
            "GeneralizedAlpha with constraints of index 3, whose local error is known"
        )
    radius, largest = alpha.spectralRadius, 1.0 if tolerance is None else LARGEST_RADIUS
    if not 0.0 < radius <= largest:
        raise InputError(
            f"settings.timeIntegration.generalizedAlpha.spectralRadius = {radius!r}: allowed is a "
            f"number above 0.0, up to {largest:g}; with 0.0 steps ring as they change, and above "
            "this accelerations that alternate behind an impact hardly fade"
        )


@contextmanager
def set_meanwhile(values: Sequence[tuple[Any, str, Any]]) -> Iterator[None]:
    """Give attributes of objects other values, as (owner, name, value), and put them back."""
    original = [(owner, name, getattr(owner, name)) for owner, name, _ in values]
    try:
        for owner, name, value in values:
            setattr(owner, name, value)
        yield
    finally:
        for owner, name, value in original:
            setattr(owner, name, value)


def prepared_settings(settings: exu.SimulationSettings, task: Task) -> AbstractContextManager[None]:
    """Set what step control needs in Exudyn's settings; the outcome has its messages.

    One Jacobian a step: with Exudyn's default (one as long as it seems to converge) dry contact
    drifts by 4 % at 1e-4 s; one an iteration costs more than the iterations it saves. A contact of
    ours opens and closes within Newton's iterations, so that Exudyn's discontinuous iterations are
    those of its own contacts and friction alone. An error above 1 lets it repeat the step.

    Exudyn's own dense solver factorises its matrix in place, so that Eigen's dense one takes over.
    """
    integration = settings.timeIntegration
    newton, discontinuous = integration.newton, integration.discontinuous
    linear, contacts = settings.linearSolver, task.system.contacts
    needed: list[tuple[Any, str, Any]] = [
        (newton, "useModifiedNewton", True),
        (newton, "modifiedNewtonJacUpdatePerStep", True),
        (newton, "modifiedNewtonContractivity", 0.5),
        (newton, "relativeTolerance", RELATIVE_RESIDUAL),
        (newton, "maxIterations", 25),
        (discontinuous, "ignoreMaxIterations", False),
        (discontinuous, "maxIterations", discontinuous.maxIterations if contacts else 1),
        (discontinuous, "useRecommendedStepSize", True),
        (integration, "adaptiveStep", True),
        (integration, "adaptiveStepDecrease", 0.5),
        (integration, "minimumStepSize", task.smallest),
        (integration, "adaptiveStepRecoverySteps", 2**30),  # growth is decided in `stepping`
        (integration, "verboseMode", 0),
        (exu.config, "printToConsole", False),
    ]
    if linear.solverType == exu.LinearSolverType.EXUdense:
        needed.append((linear, "solverType", exu.LinearSolverType.EigenDense))
    return set_meanwhile(needed)
