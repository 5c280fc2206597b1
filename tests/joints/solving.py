"""Solvers on a system of a test's, without files and without a word."""

import exudyn as exu
from stand_in_system import settings

from exu_press.integrate import SolverStatus, solve_dynamic


def solve(mbs, chosen):
    """Solve an assembled system; sensors record every step, in memory."""
    chosen.timeIntegration.verboseMode = 0
    chosen.solution.sensors.writePeriod = 0.0
    exu.config.printToConsole = False
    try:
        mbs.SolveDynamic(chosen)
    finally:
        exu.config.printToConsole = True


def fixed_steps(duration, step):
    """Return settings with steps of one size."""
    return settings(duration, round(duration / step), generalizedAlpha__spectralRadius=0.9)


def completed(mbs, end, steps=200, tolerance=1e-4):
    """Solve an assembled system to a tolerance, up to its end."""
    outcome = solve_dynamic(mbs, settings(end, steps, period=0.0), tolerance=tolerance)
    assert outcome.status is SolverStatus.COMPLETED, outcome.reason
