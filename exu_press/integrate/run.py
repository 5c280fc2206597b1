"""Advance a model by Exudyn's generalized-alpha, watched: progress, Ctrl-C, early stops."""

import math
import signal
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType

import exudyn as exu
import numpy as np

from exu_press.integrate.error import StepError
from exu_press.integrate.outcome import Outcome, Status
from exu_press.integrate.settings import largest_step, settings_for, smallest_step
from exu_press.integrate.stepping import StepControl
from exu_press.joints import overlay_of
from exu_press.model import Model
from exu_press.progress import Progress

__all__ = ["integrate"]

SECONDS_BETWEEN_UPDATES = 0.1


class _Watch:
    """Called by Exudyn before every step: counts, shows progress, stops when asked to."""

    def __init__(self, progress: Progress) -> None:
        self.calls = 0
        self.interrupted = False
        self._progress = progress
        self._next_update = time.monotonic() + SECONDS_BETWEEN_UPDATES

    def before_step(self, mbs: exu.MainSystem, now: float) -> bool:
        """Return whether to go on."""
        self.calls += 1
        if not self.calls % 16 and time.monotonic() > self._next_update:
            self._next_update = time.monotonic() + SECONDS_BETWEEN_UPDATES
            self._progress.update(now)
        return not self.interrupted

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
        watch = _Watch(progress)
        mbs.SetPreStepUserFunction(watch.before_step)
        control = _step_control(model)
        if control is not None:
            control.attach(mbs)
        start = time.perf_counter()
        with watch.catching_interrupts(), _silent_console():
            try:
                mbs.SolveDynamic(settings, showHints=False)
            except exu.ExudynError as error:
                failure = str(error)
        wall_time = time.perf_counter() - start
        solver = mbs.sys["dynamicSolver"]
        progress.update(solver.it.currentTime)
    end_time = mbs.systemData.GetTime()
    status, reason = _how_it_ended(model, watch.interrupted, end_time, control, failure)
    steps = _recorded_steps(model)
    return Outcome(
        status=status,
        reason=reason,
        end_time=end_time,
        wall_time=wall_time,
        steps=steps,
        rejected_steps=max(0, watch.calls - steps - watch.interrupted),
        newton_iterations=solver.it.newtonStepsCount,
        law_evaluations=overlay_of(mbs).evaluations if model.clearance_joints else 0,
    )


def _step_control(model: Model) -> StepControl | None:
    """Return what makes the steps follow the scene's tolerance, if it has one."""
    scene, solver = model.scene, model.scene.solver
    assert solver is not None
    if solver.tolerance is None:
        return None
    return StepControl(
        StepError(model, solver.tolerance),
        duration=scene.duration,
        smallest=smallest_step(scene),
        largest=largest_step(scene),
        next_corner=model.next_corner,
    )


def _how_it_ended(
    model: Model, interrupted: bool, end_time: float, control: StepControl | None, failure: str
) -> tuple[Status, str]:
    """Return status and reason of a run."""
    scene = model.scene
    if end_time >= scene.duration * (1.0 - 1e-9):
        return Status.COMPLETED, ""
    degrees = math.degrees(scene.start_angle + scene.angular_speed * end_time) % 360.0
    where = f"at t = {end_time:.6g} s, crank angle {degrees:.2f} deg"
    if interrupted:
        return Status.INTERRUPTED, f"interrupted {where}"
    for name, joint in model.clearance_joints.items():
        if joint.outside is not None:
            return Status.FILM_BROKE_DOWN, (
                f"film broke down {where}, eccentricity ratio {joint.outside:.4f} ({name}); "
                "try film.at_contact = 'mixed', or a larger film.viscosity or film.length"
            )
    if control is not None and control.error > 1.0:
        return Status.STEP_TOO_SMALL, (
            f"the tolerance needs a step below {smallest_step(scene):.2g} s {where}; "
            "try a larger solver.tolerance or a smaller solver.min_step"
        )
    key = "solver.step" if control is None else "solver.tolerance"
    return Status.NOT_CONVERGED, (
        f"Newton's method did not converge {where}, down to a step of "
        f"{smallest_step(scene):.2g} s; try a smaller {key}"
        + (f" [{failure.strip().splitlines()[0]}]" if failure.strip() else "")
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
