"""Exudyn's settings for a scene, each with its reason."""

import math

import exudyn as exu

from exu_press.scene import Scene

__all__ = ["settings_for"]

SMALLEST_PART = 2.0**-10
"""How far a step may be halved where Newton's method fails or a film's law does not hold."""


def settings_for(scene: Scene) -> exu.SimulationSettings:
    """Return the settings of the generalized-alpha integration of a scene.

    The step is the largest one not above `solver.step` that divides the run's duration.
    """
    solver = scene.solver
    assert solver is not None
    settings = exu.SimulationSettings()
    integration = settings.timeIntegration
    steps = max(1, math.ceil(scene.duration / solver.step * (1.0 - 1e-12)))
    integration.numberOfSteps = steps
    integration.endTime = scene.duration
    integration.verboseMode = 0
    integration.generalizedAlpha.spectralRadius = solver.spectral_radius

    # One Jacobian a step: with Exudyn's default (one as long as it seems to converge) dry contact
    # drifts by 4 % at 1e-4 s; a Jacobian an iteration costs more than the iterations it saves.
    newton = integration.newton
    newton.useModifiedNewton = True
    newton.modifiedNewtonJacUpdatePerStep = True
    # Each step starts from zero multipliers, so that this is relative to the joint forces; what it
    # leaves is 1e-10 m in a revolution, and tighter ones only cost iterations.
    newton.relativeTolerance = 1e-5
    newton.absoluteTolerance = 1e-7
    newton.maxIterations = 25
    # A contact opens and closes within Newton's iterations, so nothing is left to iterate on.
    integration.discontinuous.ignoreMaxIterations = False
    integration.discontinuous.maxIterations = 1

    integration.adaptiveStep = True
    integration.adaptiveStepDecrease = 0.5
    integration.minimumStepSize = scene.duration / steps * SMALLEST_PART

    # Two thirds of the dense solver's time, for the 30 to 90 unknowns here.
    settings.linearSolver.solverType = exu.LinearSolverType.EigenSparse
    settings.solution.file.write = False
    settings.solution.sensors.writePeriod = 0.0  # every step
    return settings
