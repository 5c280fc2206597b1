"""Exudyn's settings for a scene, each with its reason."""

import math

import exudyn as exu

from exu_press.mechanism import mechanism_of
from exu_press.scene import Scene

__all__ = ["FIRST_OF_FILM", "largest_step", "settings_for", "smallest_step"]

SMALLEST_PART = 2.0**-10
"""How far a step may be halved where Newton's method fails or a film's law does not hold."""

FALL = 0.03
"""Of free fall's acceleration, what counts as usual at least where there is clearance: parts fall
through it, however slowly the crank turns. Asked for less (below 30 rpm), Newton's method iterates
on what rounding leaves: at 0.01 rpm a hundred times for each step of 1e-4 s."""

ROUNDING = 1e-10
"""Of the first residual: where Newton's method ends if it cannot get further."""

FIRST_OF_FILM = 1e-7
"""First step with a film, s: the journals start centred and without load, and a film takes up its
load within about a microsecond. A longer first step would make it ring, a shorter one is lost in
rounding."""


def largest_step(scene: Scene) -> float:
    """Return the fixed step, or the largest one that a tolerance may lead to, s."""
    solver = scene.solver
    assert solver is not None
    return solver.step or math.radians(solver.max_step_deg) / scene.angular_speed


def smallest_step(scene: Scene) -> float:
    """Return the step below which a run is given up, s."""
    solver = scene.solver
    assert solver is not None
    if solver.step is None:
        return solver.min_step
    smallest = solver.step * SMALLEST_PART
    return smallest if scene.film is None else min(smallest, 0.5 * FIRST_OF_FILM)


def settings_for(scene: Scene) -> exu.SimulationSettings:
    """Return the settings of the generalized-alpha integration of a scene.

    A fixed step is the largest one not above `solver.step` that divides the run's duration.
    """
    solver = scene.solver
    assert solver is not None
    settings = exu.SimulationSettings()
    integration = settings.timeIntegration
    steps = max(1, math.ceil(scene.duration / largest_step(scene) * (1.0 - 1e-12)))
    integration.numberOfSteps = steps
    integration.endTime = scene.duration
    integration.verboseMode = 0
    integration.generalizedAlpha.spectralRadius = solver.spectral_radius

    # One Jacobian a step: with Exudyn's default (one as long as it seems to converge) dry contact
    # drifts by 4 % at 1e-4 s; a Jacobian an iteration costs more than the iterations it saves.
    newton = integration.newton
    newton.useModifiedNewton = True
    newton.modifiedNewtonJacUpdatePerStep = True
    newton.modifiedNewtonContractivity = 0.5
    # So that accelerations are right to this part of the usual ones; not of the first residual:
    # that one holds what a film would answer to speeds that are not yet balanced, in a stiff film a
    # million times more.
    part = 0.2 if solver.step is None else 0.1
    newton.absoluteTolerance = part * (solver.tolerance or 1e-4) * _usual_force(scene)
    newton.relativeTolerance = ROUNDING
    newton.maxIterations = 25
    # A contact opens and closes within Newton's iterations, so nothing is left to iterate on.
    # The step control's word counts: above 1 the step is repeated.
    integration.discontinuous.ignoreMaxIterations = False
    integration.discontinuous.maxIterations = 1
    integration.discontinuous.iterationTolerance = 1.0
    integration.discontinuous.useRecommendedStepSize = True

    integration.adaptiveStep = True
    integration.adaptiveStepDecrease = 0.5
    integration.minimumStepSize = smallest_step(scene)
    integration.adaptiveStepRecoverySteps = 2**30  # growth is decided in `stepping`

    # For the 20 to 160 unknowns here no slower than the sparse one, and its matrix is read at once.
    settings.linearSolver.solverType = exu.LinearSolverType.EigenDense
    settings.solution.file.write = False
    settings.solution.sensors.writePeriod = 0.0  # every step
    return settings


def _usual_force(scene: Scene) -> float:
    """Return what the whole mechanism's usual acceleration takes, N."""
    mechanism = mechanism_of(scene)
    mass = sum(body.mass for body in mechanism.bodies)
    falls = any(joint.kind != "ideal" for joint in mechanism.joints)
    least = FALL * scene.gravity if falls else 0.0
    return mass * max(scene.angular_speed * scene.pin_speed, least)
