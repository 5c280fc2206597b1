"""Settings of the integration from a scene's keys."""

import dataclasses
import math
from collections.abc import Iterator
from functools import partial

import exudyn as exu

from exu_press.integrate import ErrorScales, Outcome, SolverStatus, SolverTuning, solve_dynamic
from exu_press.integrate.error import Criterion, default_criteria
from exu_press.integrate.task import Task
from exu_press.scene import Scene, mechanism_of
from exu_press.solving.advice import SceneAdvice, leapt_over_load
from exu_press.solving.solvable_model import SolvableModel

__all__ = ["DEFAULTS", "scales", "settings_for", "solve"]

DEFAULTS = SolverTuning()

FALL = 0.03
"""Least acceleration scale with clearance, over that of free fall: bodies fall through clearances,
however slowly the crank turns. With less (below 30 rpm), Newton's method iterates on rounding: at
0.01 rpm a hundred times in each step of 1e-4 s."""

USUAL_STEP = math.radians(1.5)
"""Default of the crank's largest rotation in a step, rad."""


def solve(model: SolvableModel, *, tuning: SolverTuning = DEFAULTS, quiet: bool = True) -> Outcome:
    """Run a model to its end time or to an early stop; its sensors keep the results.

    Args:
        model: of a scene; items that were added to `model.mbs` and assembled take part.
        tuning: the numbers of step control, to vary them.
        quiet: False shows the progress on standard error.
    """
    scene = model.scene
    solver = scene.solver
    masses = {body.name: body.mass for body in model.mechanism.bodies}
    settings = settings_for(scene, keeps_redundant=model.constraints.keeps_redundant)
    settings.timeIntegration.startTime = model.begin
    settings.timeIntegration.endTime = model.begin + scene.duration
    if solver.tolerance is not None:
        settings.timeIntegration.initialStepSize = model.first_step
    outcome = solve_dynamic(
        model.mbs,
        settings,
        tolerance=solver.tolerance,
        scales=scales(scene),
        criteria=lambda task: [*default_criteria(task), *_spring_errors(model, task)],
        next_corner=model.next_corner,
        watch=model.watch,
        event=model.event,
        # modes and drive: excluded from the norm
        bodies={node: (name, masses.get(name, math.inf)) for name, node in model.nodes.items()},
        advice=lambda system, by_tolerance: SceneAdvice(model, system, by_tolerance),
        tuning=tuning,
        max_steps=solver.max_steps,
        quiet=quiet,
    )
    leapt = leapt_over_load(model) if outcome.status is SolverStatus.COMPLETED else ""
    if leapt:
        return dataclasses.replace(outcome, status=SolverStatus.UNDER_RESOLVED, reason=leapt)
    return outcome


def _spring_errors(model: SolvableModel, task: Task) -> Iterator[Criterion]:
    """Yield the errors of springs' forces, which ideal joints and guides may bear unmoved."""
    if not model.mechanism.springs:
        return
    from exu_press.integrate.criteria.interpolated_force import InterpolatedForceError

    for spring in model.mechanism.springs:
        sensors = [model.sensors[f"spring_{spring.name}", level] for level in ("ends", "velocity")]
        values = partial(map, model.mbs.GetSensorValues, sensors)
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
