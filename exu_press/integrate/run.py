"""Advance a model by Exudyn's generalized-alpha, watched: progress, Ctrl-C, early stops."""

import math
import signal
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from types import FrameType
from typing import Any

import exudyn as exu
import numpy as np
from threadpoolctl import threadpool_limits

from exu_press.integrate.error import StepError
from exu_press.integrate.flexible_jacobian import FlexibleJacobian
from exu_press.integrate.newton import Newton
from exu_press.integrate.outcome import Outcome, Status
from exu_press.integrate.resolution import unresolved
from exu_press.integrate.settings import largest_step, settings_for, smallest_step
from exu_press.integrate.step_change import StepChange
from exu_press.integrate.stepping import FixedSteps, StepControl
from exu_press.joints import overlay_of
from exu_press.model import Model
from exu_press.progress import Progress
from exu_press.scene import Scene

__all__ = ["integrate"]

SECONDS_BETWEEN_UPDATES = 0.1

THIN = 1e-6
"""m; the damping of a film of 1e-7 m, 1e17 N s/m, makes 10 N of a speed's last digit."""

SPENT = 1e-3
"""Film thickness over clearance at which a run that gets no further has lost its film."""

WIDE_CIRCLE = 0.3
"""Of the friction circle's radius, in crank radii."""


class _Watch:
    """Called by Exudyn before every step: counts, shows progress, stops when asked to."""

    def __init__(
        self, progress: Progress, before_try: Callable[[float], None], max_steps: int
    ) -> None:
        self.calls = 0
        self.interrupted = self.over_budget = False
        self._max_steps = max_steps
        self._progress = progress
        self._before_try = before_try
        self._next_update = time.monotonic() + SECONDS_BETWEEN_UPDATES

    def before_step(self, mbs: exu.MainSystem, now: float) -> bool:
        """Return whether to go on."""
        self.calls += 1
        if not self.calls % 16 and time.monotonic() > self._next_update:
            self._next_update = time.monotonic() + SECONDS_BETWEEN_UPDATES
            self._progress.update(now)
        self._before_try(now)
        self.over_budget = self.calls >= self._max_steps
        return not (self.interrupted or self.over_budget)

    @contextmanager
    def catching_interrupts(self) -> Iterator[None]:
        """Let Ctrl-C end the run after the step under way, so that nothing is lost."""
        if threading.current_thread() is not threading.main_thread():
            yield
            return

        def on_interrupt(number: int, frame: FrameType | None) -> None:
            self.interrupted = True

        before = signal.signal(signal.SIGINT, on_interrupt)
        try:
            yield
        finally:
            signal.signal(signal.SIGINT, before)


def integrate(model: Model, *, quiet: bool = True) -> Outcome:
    """Run a model to its end time or to an early stop; what was computed stays in its sensors."""
    mbs, scene = model.mbs, model.scene
    settings = settings_for(scene)
    failure = ""
    with Progress("run", scene.duration, quiet=quiet) as progress:
        joints = overlay_of(mbs) if model.clearance_joints else None
        solver: Any = exu.MainSolverImplicitSecondOrder()  # whose type stub forgets `self`
        mbs.sys["dynamicSolver"] = solver
        newton = Newton(mbs, solver, joints, scene.pin_speed)
        step_change = StepChange(mbs, solver, smooth=joints is None)
        if scene.flexible is not None:
            FlexibleJacobian(mbs, solver, joints)
        watch = _Watch(progress, step_change.before_try, _max_steps(model))
        mbs.SetPreStepUserFunction(watch.before_step)
        film_start = None if scene.film is None else step_change
        control = _step_control(model, solver, film_start)
        if control is not None:
            control.attach(mbs, solver, newton)
        else:
            FixedSteps(
                scene.duration / settings.timeIntegration.numberOfSteps,
                film_start=film_start,
            ).attach(mbs, solver, newton)
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
    status, reason = _how_it_ended(model, watch, end_time, control, failure)
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


def _step_control(model: Model, solver: Any, film_start: StepChange | None) -> StepControl | None:
    """Return what makes the steps follow the scene's tolerance, if it has one."""
    scene, settings = model.scene, model.scene.solver
    assert settings is not None
    if settings.tolerance is None:
        return None
    return StepControl(
        StepError(model, solver, settings.tolerance),
        duration=scene.duration,
        smallest=smallest_step(scene),
        largest=largest_step(scene),
        film_start=film_start,
        next_corner=model.next_corner,
    )


def _how_it_ended(
    model: Model, watch: _Watch, end_time: float, control: StepControl | None, failure: str
) -> tuple[Status, str]:
    """Return status and reason of a run."""
    scene = model.scene
    if end_time >= scene.duration * (1.0 - 1e-9):
        return _resolution(model)
    where = _place(model, end_time)
    if watch.interrupted:
        return Status.INTERRUPTED, f"interrupted {where}"
    if watch.over_budget:
        return Status.TOO_MANY_STEPS, (
            f"{_max_steps(model)} steps were used up {where}, "
            f"{end_time / scene.duration:.1%} of the run; try fewer revolutions, a larger "
            f"{'solver.step' if control is None else 'solver.tolerance'} or solver.max_steps"
            f"{_seizing(model)}"
        )
    for name, ratio in _spent_films(model):
        return Status.FILM_BROKE_DOWN, (
            f"film broke down {where}, eccentricity ratio {ratio:.4f} ({name}); "
            "try film.at_contact = 'mixed', or a larger film.viscosity or film.length"
        )
    if control is not None and not control.error <= 1.0:
        return Status.STEP_TOO_SMALL, (
            f"the tolerance needs a step below {smallest_step(scene):.2g} s {where}"
            f"{_busiest_joint(model)}; "
            f"try a larger solver.tolerance or a smaller solver.min_step{_seizing(model)}"
        )
    key = "solver.step" if control is None else "solver.tolerance"
    return Status.NOT_CONVERGED, (
        f"Newton's method did not converge {where}{_busiest_joint(model)}, down to a step of "
        f"{smallest_step(scene):.2g} s; try a smaller {key}{_seizing(model)}{_thin_film(scene)}"
        + (f" [{failure.strip().splitlines()[0]}]" if failure.strip() else "")
    )


def _spent_films(model: Model) -> Iterator[tuple[str, float]]:
    """Yield the films that end the run, with their eccentricity ratios at its end."""
    film = model.scene.film
    if film is None or film.at_contact != "stop":
        return
    for name, joint in model.clearance_joints.items():
        if joint.outside is not None:
            yield name, joint.outside
        elif name == "crank_pin":
            gap = overlay_of(model.mbs).state(joint).gap
            if gap < SPENT * joint.clearance:
                yield name, 1.0 - gap / joint.clearance


def _resolution(model: Model) -> tuple[Status, str]:
    """Return status and reason of a run that reached its end."""
    worst = unresolved(model)
    solver = model.scene.solver
    if worst is None or solver is None:
        return Status.COMPLETED, ""
    help_ = (
        f"solver.step = {worst.step_needed:.0e}"
        if solver.tolerance is None
        else f"solver.tolerance = {0.1 * solver.tolerance:.0e}"
    )
    return Status.UNDER_RESOLVED, (
        f"under-resolved {_place(model, worst.time)}: {worst.what}; peaks are the step's; "
        f"try {help_}"
    )


def _place(model: Model, time: float) -> str:
    """Return time and crank angle in words."""
    scene = model.scene
    degrees = math.degrees(scene.start_angle + scene.angular_speed * time) % 360.0
    return f"at t = {time:.6g} s, crank angle {degrees:.2f} deg"


def _busiest_joint(model: Model) -> str:
    """Return in words which clearance joint carries the largest force at the end, if one does."""
    if not model.clearance_joints:
        return ""
    overlay = overlay_of(model.mbs)
    forces = {n: math.hypot(*overlay.state(j).force) for n, j in model.clearance_joints.items()}
    name = max(forces, key=lambda name: forces[name] if math.isfinite(forces[name]) else -1.0)
    return f", {name} carrying {forces[name]:.3g} N"


def _seizing(model: Model) -> str:
    """Return in words that the crank pin's friction circle is wide enough to seize.

    Near dead centre the rod's force passes within it: friction then holds the pin fast, whatever
    the force, and a crank that turns at constant speed makes it grow without bound.
    """
    scene = model.scene
    size, friction, contact = scene.press or scene.slider_crank, scene.friction, scene.contact
    if size is None or friction is None or contact is None or friction.law == "none":
        return ""
    circle = contact.radius * math.sin(math.atan(friction.mu_static))
    if "crank_pin" not in model.clearance_joints or circle < WIDE_CIRCLE * size.crank_radius:
        return ""
    return (
        f"; the crank pin seizes near dead centre (friction circle {circle:.2g} m, crank radius "
        f"{size.crank_radius:.2g} m): try a smaller friction.mu_static or contact.radius"
    )


def _thin_film(scene: Scene) -> str:
    """Return in words that a film is so thin that rounding moves its forces, or nothing."""
    clearance = None if scene.clearance is None else scene.clearance.crank_pin
    if scene.film is None or clearance is None or clearance >= THIN:
        return ""
    return "; a film this thin is too stiff for rounded speeds: try a larger clearance.crank_pin"


def _max_steps(model: Model) -> int:
    solver = model.scene.solver
    assert solver is not None
    return solver.max_steps


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
