"""The package's own solvers on a scene: fixed steps, tolerance, spectral radius, Newton mode."""

import time
from collections.abc import Iterable
from functools import partial

import exudyn as exu

from exu_press.integrate import Outcome, Status
from exu_press.integrate.problem import Problem
from exu_press.integrate.settings import prepared
from exu_press.joints import overlay_of
from exu_press.result import record
from exu_press.scene import Scene
from exu_press.solving import settings_for
from exu_press.studies.precision.measured import Attempt, Measured, measured_of

__all__ = [
    "FIXED",
    "TOLERANCE",
    "fixed_steps",
    "mode_numbers",
    "moved",
    "newton_modes",
    "run_scene",
    "spectral_radii",
    "tolerances",
]

FIXED = "fixed step"
TOLERANCE = "tolerance"
MODES = "modes, default tolerance"

SMALLEST = 1e-8
"""How small a fixed step may become where Newton's method fails, s."""

MOVED = 2e-4
"""deg; a tenth of a micrometre at the pin of a crank of 30 mm."""

NEWTON_MODES = {"full Newton": (False, False), "modified Newton": (True, False)}
"""Name -> (modified, a Jacobian every step); the package's own is modified with one every step."""


def run_scene(scene: Scene, setting: str, value: float) -> Measured:
    """Run a scene with `setting` ("step" or "tolerance") at a value."""
    return _run(scene.replace(f"solver.{setting}", value))


def _run(scene: Scene) -> Measured:
    model = scene.build()
    start = time.process_time()
    outcome = model.solve()
    cpu_time = time.process_time() - start
    result = record(model, outcome)
    model.SC.Reset()  # system and solver hold each other, and all they recorded
    return measured_of(result, cpu_time)


def fixed_steps(scene: Scene, steps: Iterable[float]) -> list[Attempt]:
    """Return the runs with fixed steps, s."""
    return [_attempt(FIXED, scene, "step", h) for h in steps]


def tolerances(scene: Scene, values: Iterable[float]) -> list[Attempt]:
    """Return the runs with tolerances."""
    return [_attempt(TOLERANCE, scene, "tolerance", value) for value in values]


def mode_numbers(scene: Scene, numbers: Iterable[int]) -> list[Attempt]:
    """Return the runs with other numbers of modes, at the scene's own tolerance."""
    return [
        Attempt(
            MODES,
            "modes",
            float(n),
            partial(_run, scene.replace({f"bodies.{name}.modes": n for name in scene.bodies})),
        )
        for n in numbers
    ]


def spectral_radii(scene: Scene, radii: Iterable[float], values: Iterable[float]) -> list[Attempt]:
    """Return the runs with other spectral radii, at tolerances."""
    values = tuple(values)
    return [
        _attempt(
            f"{TOLERANCE}, radius {radius:g}",
            scene.replace("solver.spectral_radius", radius),
            "tolerance",
            value,
        )
        for radius in radii
        for value in values
    ]


def newton_modes(scene: Scene, steps: Iterable[float]) -> list[Attempt]:
    """Return the runs with other Newton modes, at fixed steps, s."""
    steps = tuple(steps)
    return [
        Attempt(f"{FIXED}, {mode}", "step", h, partial(_with_newton, scene, mode, h))
        for mode in NEWTON_MODES
        for h in steps
    ]


def _attempt(solver: str, scene: Scene, setting: str, value: float) -> Attempt:
    again = partial(_from_start, scene, setting, value)
    return Attempt(solver, setting, value, partial(run_scene, scene, setting, value), again)


def _from_start(scene: Scene, setting: str, value: float, number: int) -> Measured:
    return run_scene(moved(scene, number), setting, value)


def moved(scene: Scene, number: int) -> Scene:
    """Return a scene whose start differs by next to nothing: so many times MOVED."""
    return scene.replace(start_angle_deg=scene.start_angle_deg + number * MOVED)


def _with_newton(scene: Scene, mode: str, step: float) -> Measured:
    """Run fixed steps with another Newton mode, which is no key of a scene."""
    scene = scene.replace("solver.step", step)
    model = scene.build()
    settings = settings_for(scene)
    newton = settings.timeIntegration.newton
    silent, exu.config.printToConsole = exu.config.printToConsole, False
    start, cpu_start = time.perf_counter(), time.process_time()
    try:
        with prepared(settings, Problem.of(model.mbs, None), SMALLEST):
            newton.useModifiedNewton, newton.modifiedNewtonJacUpdatePerStep = NEWTON_MODES[mode]
            model.mbs.SolveDynamic(settings, showHints=False)
        status, reason = Status.COMPLETED, ""
    except exu.ExudynError as error:
        status, reason = Status.NOT_CONVERGED, str(error).strip().splitlines()[0]
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
        law_evaluations=overlay_of(model.mbs).evaluations,
    )
    result = record(model, outcome)
    model.SC.Reset()
    return measured_of(result, cpu_time)
