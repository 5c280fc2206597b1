"""Settings of the integration from a scene's keys."""

import math
from collections.abc import Iterator
from functools import partial

import exudyn as exu

from exu_press.integrate import ErrorScales
from exu_press.integrate.error import Criterion
from exu_press.integrate.task import Task
from exu_press.model.system import System
from exu_press.scene import Scene, mechanism_of

__all__ = ["scales", "settings_for", "spring_errors"]

FALL = 0.03
"""Least acceleration scale with clearance, over that of free fall: bodies fall through clearances,
however slowly the crank turns. With less (below 30 rpm), Newton's method iterates on rounding: at
0.01 rpm a hundred times in each step of 1e-4 s."""

USUAL_STEP = math.radians(1.5)
"""Default of the crank's largest rotation in a step, rad."""


def spring_errors(system: System, task: Task) -> Iterator[Criterion]:
    """Yield the errors of springs' forces, which ideal joints and guides may bear unmoved."""
    if not system.mechanism.springs:
        return
    from exu_press.integrate.criteria.interpolated_force import InterpolatedForceError

    for spring in system.mechanism.springs:
        sensors = [system.sensors[f"spring_{spring.name}", level] for level in ("ends", "velocity")]
        values = partial(map, system.mbs.GetSensorValues, sensors)
        yield InterpolatedForceError(task, values, spring.force_on_second_end)


def settings_for(scene: Scene, *, keeps_redundant: bool = False) -> exu.SimulationSettings:
    """Return Exudyn's settings of a scene, for constraints some of which may be redundant.

    A fixed step is the largest one not above `solver.step` that divides the run's duration.
    """
    solver = scene.solver
    settings = exu.SimulationSettings()
    integration = settings.timeIntegration
    largest = solver.step or math.radians(solver.max_step_deg) / scene.angular_speed
    integration.numberOfSteps = _steps(scene.duration, largest)
    integration.endTime = scene.duration
    integration.minimumStepSize = solver.min_step
    integration.verboseMode = 0
    if any(load.fade is not None for load in scene.applied_loads.values()):
        integration.computeLoadsJacobian = 2  # by positions and velocities
    integration.generalizedAlpha.spectralRadius = solver.spectral_radius
    # For the 20 to 160 unknowns here no slower than the sparse one, and its matrix is read at once.
    settings.linearSolver.solverType = exu.LinearSolverType.EigenDense
    settings.linearSolver.ignoreSingularJacobian = keeps_redundant
    settings.solution.file.write = False
    settings.solution.sensors.writePeriod = 0.0  # every step
    return settings


def _steps(duration: float, largest: float) -> int:
    """Return how many steps of one size, at most `largest`, a duration (s) is divided into."""
    return max(1, math.ceil(duration / largest * (1.0 - 1e-12)))


def scales(scene: Scene) -> ErrorScales:
    """Return the scales of errors: the crank pin's speed, and the force of its acceleration.

    With a slow crank, the speed of a journal that has fallen through its clearance. The step does
    not depend on the scene's largest one.
    """
    mechanism = mechanism_of(scene)
    in_guides = (guide.clearance or 0.0 for guide in scene.guides.values())
    widest = max([0.0, *in_guides, *(joint.clearance for joint in scene.joints.values())])
    usual = scene.angular_speed * scene.pin_speed
    return ErrorScales(
        speed=max(scene.pin_speed, math.sqrt(4.0 * scene.gravity * widest)),
        force=sum(body.mass for body in mechanism.bodies)
        * max(usual, FALL * scene.gravity if widest else 0.0),
        step=scene.duration / _steps(scene.duration, USUAL_STEP / scene.angular_speed),
        gravity=scene.gravity,
    )
