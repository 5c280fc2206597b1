"""What the campaign varies beside step and tolerance: spectral radius, Newton mode, modes."""

import time
from dataclasses import dataclass
from functools import partial

import exudyn as exu

from exu_press.integrate import ErrorScales, Outcome, SolverStatus, SolverTuning
from exu_press.integrate.system import System
from exu_press.integrate.task import Task, prepared_settings
from exu_press.joints import user_force_of
from exu_press.model import build
from exu_press.model.settings import settings_for
from exu_press.result import record
from exu_press.scene import Scene
from exu_press.studies.precision.cases import Case, Extent
from exu_press.studies.precision.stated import StatedErrors
from exu_press.studies.precision.timing import (
    FIXED,
    TOLERANCE,
    Attempt,
    TimedRun,
    attempt,
    run,
    timed_run_of,
)

__all__ = ["Modes", "newton_modes", "spectral_radii"]

MODES = "modes, default tolerance"

RADII = (0.5, 0.65, 0.95)
"""Beside the default of 0.8."""
VARIED_TOLERANCES = (1e-2, 1e-3, 1e-4)
VARIED_STEPS = (1e-4, 2e-5, 1e-5)  # s

SMALLEST = 1e-8
"""How small a fixed step may become where Newton's method fails, s."""

NEWTON_MODES = {"full Newton": (False, False), "modified Newton": (True, False)}
"""Name -> (modified, a Jacobian every step); the package's own is modified with one every step."""


@dataclass(frozen=True)
class Modes(Case):
    """A flexible scene with other numbers of modes, against its own.

    Attributes:
        modes: numbers of modes that are tried, at the default tolerance.
    """

    modes: tuple[int, ...] = ()

    def attempts(self, amount: Extent) -> list[Attempt]:
        """Return a run for each number."""
        bodies = self._scene.bodies
        scenes = {
            n: self._scene.replace({f"bodies.{name}.modes": n for name in bodies})
            for n in self.modes
        }
        return [Attempt(MODES, "modes", float(n), partial(run, s)) for n, s in scenes.items()]

    def compare_stated_errors(self, amount: Extent, horizon: float) -> list[StatedErrors]:
        """Return nothing: stated errors are of the tolerance."""
        return []


def spectral_radii(scene: Scene, amount: Extent) -> list[Attempt]:
    """Return the runs with other spectral radii, at tolerances."""
    return [
        attempt(
            f"{TOLERANCE}, radius {radius:g}",
            scene.replace({"solver.spectral_radius": radius}),
            "tolerance",
            value,
        )
        for radius in RADII
        for value in VARIED_TOLERANCES
        if value >= amount.finest_tolerance
    ]


def newton_modes(scene: Scene, amount: Extent) -> list[Attempt]:
    """Return the runs with other Newton modes, at fixed steps."""
    return [
        Attempt(f"{FIXED}, {mode}", "step", h, partial(_with_newton, scene, mode, h))
        for mode in NEWTON_MODES
        for h in VARIED_STEPS
        if h >= amount.finest_step
    ]


def _with_newton(scene: Scene, mode: str, step: float) -> TimedRun:
    """Run fixed steps with another Newton mode, which is no key of a scene."""
    scene = scene.replace({"solver.step": step})
    model = build(scene)
    settings = settings_for(scene)
    newton = settings.timeIntegration.newton
    silent, exu.config.printToConsole = exu.config.printToConsole, False
    start, cpu_start = time.perf_counter(), time.process_time()
    try:
        task = Task(System.of_mbs(model.mbs), settings, None, ErrorScales(), SolverTuning())
        task.smallest = SMALLEST
        model.mbs.SetPostStepUserFunction(lambda mbs, time: not model.watch(time))
        with prepared_settings(settings, task):
            newton.useModifiedNewton, newton.modifiedNewtonJacUpdatePerStep = NEWTON_MODES[mode]
            model.mbs.SolveDynamic(settings, showHints=False)
        status, reason = SolverStatus.COMPLETED, ""
    except exu.ExudynError as error:
        status, reason = SolverStatus.NOT_CONVERGED, str(error).strip().splitlines()[0]
    finally:
        wall_time, cpu_time = time.perf_counter() - start, time.process_time() - cpu_start
        exu.config.printToConsole = silent
    solver = model.mbs.sys["dynamicSolver"]
    outcome = Outcome(
        status=status,
        reason=reason,
        end_time=model.mbs.systemData.GetTime(),
        wall_time=wall_time,
        steps=solver.it.currentStepIndex,
        rejected_steps=0,
        newton_iterations=solver.it.newtonStepsCount,
        law_evaluations=user_force_of(model.mbs).evaluations,
    )
    result = record(model, outcome)
    model.SC.Reset()
    return timed_run_of(result, cpu_time)
