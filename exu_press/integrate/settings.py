"""Exudyn's settings for steps by tolerance, each with its reason; put back after the run."""

import math
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import exudyn as exu

from exu_press.errors import InputError
from exu_press.integrate.problem import Problem

__all__ = ["prepared", "refuse_unusable"]

RELATIVE_RESIDUAL = 1e-10
"""Of the first residual: where Newton's method ends if it cannot get further."""

TOLERANCES = 1e-8, 0.1
"""Between these a tolerance means something."""

IMPLICIT = "GeneralizedAlpha"


def refuse_unusable(settings: exu.SimulationSettings, tolerance: float | None) -> None:
    """Refuse what cannot be integrated.

    Raises:
        InputError: the tolerance lies outside its range, the run has no end, or the integrator is
            not Exudyn's generalized-alpha for second-order systems.
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
    solver = str(integration.solverType).rsplit(".", 1)[-1]
    if solver != IMPLICIT:
        raise InputError(
            f"settings.timeIntegration.solverType = {solver}: allowed is {IMPLICIT}, whose local "
            "error is known"
        )
    alpha = integration.generalizedAlpha
    if not 0.0 < alpha.spectralRadius <= 1.0:
        raise InputError(
            "settings.timeIntegration.generalizedAlpha.spectralRadius = "
            f"{alpha.spectralRadius!r}: allowed is a number above 0.0, up to 1.0; with 0.0 no step "
            "can be changed without ringing"
        )
    if alpha.useNewmark or alpha.useIndex2Constraints:
        raise InputError(
            "settings.timeIntegration.generalizedAlpha: useNewmark and useIndex2Constraints are "
            "not allowed; the error estimate and the changes of step are generalized-alpha's, with "
            "constraints of index 3"
        )


@contextmanager
def prepared(settings: exu.SimulationSettings, problem: Problem, smallest: float) -> Iterator[None]:
    """Set what step control needs in Exudyn's settings, and put everything back.

    One Jacobian a step: with Exudyn's default (one as long as it seems to converge) dry contact
    drifts by 4 % at 1e-4 s; a Jacobian an iteration costs more than the iterations it saves.

    A contact of ours opens and closes within Newton's iterations, so nothing is left to iterate on.
    The step control's word counts: above 1 the step is repeated. Data variables of Exudyn's own
    contacts and friction keep the iterations that the settings give them.

    Exudyn's own dense solver factorises its matrix in place, so that Eigen's dense one takes over.
    """
    integration = settings.timeIntegration
    newton, discontinuous = integration.newton, integration.discontinuous
    linear = settings.linearSolver
    in_place = linear.solverType == exu.LinearSolverType.EXUdense
    wanted: list[tuple[Any, dict[str, Any]]] = [
        (
            linear,
            {"solverType": exu.LinearSolverType.EigenDense if in_place else linear.solverType},
        ),
        (
            newton,
            {
                "useModifiedNewton": True,
                "modifiedNewtonJacUpdatePerStep": True,
                "modifiedNewtonContractivity": 0.5,
                "relativeTolerance": RELATIVE_RESIDUAL,
                "absoluteTolerance": newton.absoluteTolerance,
                "maxIterations": 25,
            },
        ),
        (
            discontinuous,
            {
                "ignoreMaxIterations": False,
                "maxIterations": discontinuous.maxIterations if problem.switching else 1,
                "iterationTolerance": min(discontinuous.iterationTolerance, 1.0),
                "useRecommendedStepSize": True,
            },
        ),
        (
            integration,
            {
                "adaptiveStep": True,
                "adaptiveStepDecrease": 0.5,
                "minimumStepSize": smallest,
                "adaptiveStepRecoverySteps": 2**30,  # growth is decided in `stepping`
                "verboseMode": 0,
            },
        ),
    ]
    before = [(part, {name: getattr(part, name) for name in new}) for part, new in wanted]
    try:
        for part, new in wanted:
            for name, value in new.items():
                setattr(part, name, value)
        yield
    finally:
        for part, old in before:
            for name, value in old.items():
                setattr(part, name, value)
