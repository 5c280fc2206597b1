"""Advance a model by Exudyn's generalized-alpha, and say how it ended."""

import time
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import exudyn as exu
import numpy as np
from threadpoolctl import threadpool_limits

from exu_press.integrate.ending import how_it_ended
from exu_press.integrate.error import StepError
from exu_press.integrate.flexible_jacobian import FlexibleJacobian
from exu_press.integrate.newton import Newton
from exu_press.integrate.outcome import Outcome
from exu_press.integrate.settings import largest_step, settings_for, smallest_step
from exu_press.integrate.step_change import StepChange
from exu_press.integrate.stepping import FixedSteps, StepControl
from exu_press.integrate.watch import Watch
from exu_press.joints import overlay_of
from exu_press.model import Model
from exu_press.progress import Progress

__all__ = ["integrate"]


def integrate(model: Model, *, quiet: bool = True) -> Outcome:
    """Run a model to its end time or to an early stop; what was computed stays in its sensors."""
    mbs, scene = model.mbs, model.scene
    settings = settings_for(scene)
    assert scene.solver is not None
    failure = ""
    with Progress("run", scene.duration, quiet=quiet) as progress:
        joints = overlay_of(mbs) if model.clearance_joints else None
        solver: Any = exu.MainSolverImplicitSecondOrder()  # whose type stub forgets `self`
        mbs.sys["dynamicSolver"], mbs.sys["simulationSettings"] = solver, settings
        flexible = scene.flexible is not None
        newton = Newton(mbs, solver, joints, scene.pin_speed, flexible=flexible)
        step_change = StepChange(mbs, solver, smooth=joints is None)
        if flexible:
            FlexibleJacobian(mbs, solver, joints)
        watch = Watch(progress, step_change.before_try, scene.solver.max_steps)
        mbs.SetPreStepUserFunction(watch.before_step)
        film_start = None if scene.film is None else step_change
        control = _step_control(model, solver, newton, film_start)
        if control is not None:
            control.attach(mbs)
        else:
            step = scene.duration / settings.timeIntegration.numberOfSteps
            FixedSteps(step, solver, newton, film_start=film_start).attach(mbs)
        start = time.perf_counter()
        # matrices of a hundred rows: further threads only wait for each other
        with watch.catching_interrupts(), _silent_console(), threadpool_limits(1):
            try:
                if not solver.SolveSystem(mbs, settings):
                    failure = solver.GetErrorString()
            except exu.ExudynError as error:
                failure = str(error)
                if "USER FUNCTION" in failure:  # an error in our own code is no failure of Newton's
                    raise
        wall_time = time.perf_counter() - start
        progress.update(solver.it.currentTime)
    end_time = mbs.systemData.GetTime()
    status, reason = how_it_ended(model, watch, end_time, control, failure)
    steps = _recorded_steps(model)
    return Outcome(
        status=status,
        reason=reason,
        end_time=end_time,
        wall_time=wall_time,
        steps=steps,
        rejected_steps=watch.calls - steps,
        newton_iterations=solver.it.newtonStepsCount,
        law_evaluations=joints.evaluations if joints else 0,
    )


def _step_control(
    model: Model, solver: Any, newton: Newton, film_start: StepChange | None
) -> StepControl | None:
    """Return what makes the steps follow the scene's tolerance, if it has one."""
    scene, settings = model.scene, model.scene.solver
    assert settings is not None
    if settings.tolerance is None:
        return None
    return StepControl(
        StepError(model, solver, settings.tolerance),
        solver,
        newton,
        duration=scene.duration,
        smallest=smallest_step(scene),
        largest=largest_step(scene),
        film_start=film_start,
        next_corner=model.next_corner,
    )


def _recorded_steps(model: Model) -> int:
    """Return the number of accepted steps: the sensors hold the start and each of them."""
    sensor = model.sensors[model.mechanism.slider, "position"]
    return len(np.asarray(model.mbs.GetSensorStoredData(sensor))) - 1


@contextmanager
def _silent_console() -> Iterator[None]:
    """Keep Exudyn's own messages off the console; the outcome says what happened."""
    before = exu.config.printToConsole
    exu.config.printToConsole = False
    try:
        yield
    finally:
        exu.config.printToConsole = before
