"""The public `solve_dynamic`: error-controlled steps with clearance joints, else refinement."""

import math
import warnings
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any, Literal

import exudyn as exu
import numpy as np

from exu_press.errors import InputError
from exu_press.exudyn_systems.failure import agreed_until, why_not_converged
from exu_press.exudyn_systems.level import Levels
from exu_press.exudyn_systems.refine import Refinement, grid
from exu_press.exudyn_systems.samples import Variables
from exu_press.integrate import Outcome, RunError, SolverStatus
from exu_press.integrate import solve_dynamic as solve_adaptively
from exu_press.integrate.task import refuse_no_run
from exu_press.joints import holds_joints

__all__ = ["RefinedOutcome", "solve_dynamic"]

BUDGET = 40, 1_000_000  # steps of all levels: over the user's own number, and at least
IMPLICIT = "GeneralizedAlpha", "TrapezoidalIndex2"  # exudyn's implicit solvers


@dataclass(frozen=True)
class RefinedOutcome(Outcome):
    """How a refinement ended: also steps and processor time (s) of each level, and its system."""

    levels: list[tuple[int, float]] = field(default_factory=list)
    mbs: Any = None


def solve_dynamic(
    system: exu.MainSystem | Callable[[], exu.MainSystem],
    settings: exu.SimulationSettings,
    *,
    tolerance: float | None = 1e-3,
    errors: bool = False,
    method: Literal["refine", "adaptive"] | None = None,
    max_steps: int | None = None,
    max_time: float = math.inf,
    **adaptive: Any,
) -> Outcome:
    """Do what `mbs.SolveDynamic(settings)` does, with a tolerance instead of a step.

    A system that holds a clearance joint of this package takes error-controlled steps
    (`exu_press.integrate.solve_dynamic`). Every other one is refined: Exudyn's own solver runs with
    constant steps, in levels of rising numbers of steps, until the error of the last one is within
    the tolerance. The differences of levels at up to 200 instants, and the observed order of
    convergence, tell that error. What is compared, each in its own norm:

    - displacements of nodes, over the largest one of any node from its start,
    - rotations of nodes, over the largest turn of any node from its start (at most pi),
    - coordinates of each other node (modes, scalar coordinates, slopes of cables), in their
      Euclidean norm over its largest change,
    - each first-order coordinate, and each value of each sensor, over its largest magnitude.

    No scale is below a millionth of the largest one of its like: rounding moves what is smaller.

    Earlier levels run in copies of this process: functions that remember begin afresh; two run at
    once if both are needed. The system, its sensors and its files hold the last one. No level has
    fewer steps than an eighth of `numberOfSteps`. One in which a body turns by more than 0.5 rad a
    step, or an oscillation above the tolerance has fewer than 10 steps in a period, decides
    nothing. Three levels whose observed order lies between 0.5 and 4 decide.

    Args:
        system: assembled; or a function that builds and returns one, for each level anew.
        settings: Exudyn's. Steps are constant: `adaptiveStep`, its default, is off in levels.
        tolerance: relative, from 1e-8 to 0.1; with clearance joints, None takes fixed steps.
        errors: whether error-controlled steps state their error. A refinement always does: that of
            all coordinates is relative, those of sensors and their peaks are in their units.
        method: "refine" or "adaptive" (error-controlled steps), to overrule the choice.
        max_steps: of all levels together; None: 1e6, and in a refinement at least 40 times the
            settings' `numberOfSteps`.
        max_time: elapsed time of a refinement, s.
        adaptive: what else error-controlled steps take.

    Returns:
        How the run ended. A refinement that misses the tolerance has the status NOT_CONVERGED; its
        reason, and a warning, say what was reached and what would do.

    Raises:
        InputError: the input is wrong, or copies of the process are not safe.
        exudyn.ExudynError: a user function failed.
    """
    build = None if isinstance(system, exu.MainSystem) else system
    mbs: Any = system if build is None else build()
    if method not in (None, "refine", "adaptive"):
        raise InputError(f'method = {method!r}: allowed are "refine", "adaptive" and None')
    if not mbs.systemIsConsistent:
        raise InputError("mbs is not assembled: call mbs.Assemble() after its last item")
    if method == "adaptive" or (method is None and holds_joints(mbs)):
        if max_time < math.inf:
            raise InputError("max_time: allowed with refinement")
        adaptive |= {} if max_steps is None else {"max_steps": max_steps}
        return solve_adaptively(mbs, settings, tolerance=tolerance, errors=errors, **adaptive)
    if adaptive:
        raise InputError(
            f"{', '.join(adaptive)}: allowed with error-controlled steps, which a system with "
            'clearance joints takes, and any other one with method="adaptive"'
        )
    _refuse_unusable(settings, tolerance)
    integration = settings.timeIntegration
    users, duration = int(integration.numberOfSteps), integration.endTime - integration.startTime
    rows = max(1, round(duration / (settings.solution.sensors.writePeriod or math.inf)))
    coarsest, count = grid(users, rows)
    runs = Levels(mbs, settings, count, max_time, build)
    if build is None:
        runs.refuse_copy()
    budget = max(BUDGET[0] * users, BUDGET[1]) if max_steps is None else max_steps
    refinement = Refinement(runs, Variables(mbs), float(tolerance or 0.0), users, rows, budget)
    last = refinement.refine(coarsest)
    holds_finest = bool(refinement.levels) and refinement.levels[-1] is last
    converged = holds_finest and refinement.meets_tolerance()
    reason = "" if converged else why_not_converged(refinement)
    if reason:
        warnings.warn(f"solve_dynamic: not converged: {reason}", stacklevel=2)
    return RefinedOutcome(
        status=SolverStatus.COMPLETED if converged else SolverStatus.NOT_CONVERGED,
        reason=reason,
        end_time=last.end,
        wall_time=runs.elapsed_time(),
        steps=last.steps,
        rejected_steps=0,
        newton_iterations=last.iterations,
        law_evaluations=0,
        error=_stated_error(refinement) if holds_finest else None,
        levels=refinement.cost,
        mbs=runs.mbs,
    )


def _refuse_unusable(settings: exu.SimulationSettings, tolerance: float | None) -> None:
    """Refuse what cannot be refined."""
    if tolerance is None:
        raise InputError("tolerance = None: allowed is a number; mbs.SolveDynamic has fixed steps")
    refuse_no_run(settings, tolerance)
    solver = str(settings.timeIntegration.solverType).rsplit(".", 1)[-1]
    if solver not in IMPLICIT:
        raise InputError(
            f"settings.timeIntegration.solverType = {solver}: allowed are {' and '.join(IMPLICIT)}"
            "; explicit solvers, and their control of steps, stay with mbs.SolveDynamic"
        )
    if settings.solution.restart.continueIfAvailable:
        raise InputError("settings.solution.restart.continueIfAvailable = True: allowed is False")


def _stated_error(refinement: Refinement) -> RunError | None:
    """Return the errors of the last level, where three levels tell them."""
    judgement, sizes = refinement.judgement, refinement.variables.sensors
    if judgement is None:
        return None
    first, ends = len(judgement.errors) - 1 - sum(sizes), np.cumsum(sizes)[:-1]
    values = (judgement.errors * refinement.scales())[first:-1]
    return RunError(
        motion=float(judgement.errors[:first].max(initial=0.0)),
        since=math.inf if refinement.meets_tolerance() else agreed_until(refinement),
        sensors=np.split(values, ends) if sizes else [],
        peaks=np.split(judgement.peaks, ends) if sizes else [],
    )
