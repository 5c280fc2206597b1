"""Exudyn's own solver on a system of a test's, without files and without a word."""

import exudyn as exu


def solve(mbs, settings):
    """Solve an assembled system; sensors record every step, in memory."""
    settings.timeIntegration.verboseMode = 0
    settings.solution.file.write = False
    settings.solution.sensors.writePeriod = 0.0
    exu.config.printToConsole = False
    try:
        mbs.SolveDynamic(settings)
    finally:
        exu.config.printToConsole = True


def fixed_steps(duration, step):
    """Return settings with steps of one size."""
    settings = exu.SimulationSettings()
    settings.timeIntegration.numberOfSteps = round(duration / step)
    settings.timeIntegration.endTime = duration
    settings.timeIntegration.generalizedAlpha.spectralRadius = 0.9
    return settings
