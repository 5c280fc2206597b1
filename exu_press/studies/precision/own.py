"""The package's own solvers on a scene: fixed steps and tolerances, from one start or several."""

import time
from collections.abc import Iterable

from exu_press.model import build
from exu_press.result import record
from exu_press.scene import Scene
from exu_press.studies.precision.measured import Attempt, Measured, measured_of

__all__ = [
    "FIXED",
    "TOLERANCE",
    "attempt",
    "fixed_steps",
    "moved",
    "run",
    "run_scene",
    "tolerances",
]

FIXED = "fixed step"
TOLERANCE = "tolerance"

MOVED = 2e-4
"""deg; a tenth of a micrometre at the pin of a crank of 30 mm."""


def run_scene(scene: Scene, setting: str, value: float) -> Measured:
    """Run a scene with `setting` ("step" or "tolerance") at a value."""
    return run(scene.replace(f"solver.{setting}", value))


def run(scene: Scene) -> Measured:
    """Run a scene as it is."""
    model = build(scene)
    start = time.process_time()
    outcome = model.solve()
    cpu_time = time.process_time() - start
    result = record(model, outcome)
    model.SC.Reset()  # system and solver hold each other, and all they recorded
    return measured_of(result, cpu_time)


def fixed_steps(scene: Scene, steps: Iterable[float]) -> list[Attempt]:
    """Return the runs with fixed steps, s."""
    return [attempt(FIXED, scene, "step", h) for h in steps]


def tolerances(scene: Scene, values: Iterable[float]) -> list[Attempt]:
    """Return the runs with tolerances."""
    return [attempt(TOLERANCE, scene, "tolerance", value) for value in values]


def attempt(solver: str, scene: Scene, setting: str, value: float) -> Attempt:
    """Return a run of a solver's, repeated from starts that differ by next to nothing."""
    return Attempt(
        solver,
        setting,
        value,
        run=lambda: run_scene(scene, setting, value),
        again=lambda number: run_scene(moved(scene, number), setting, value),
    )


def moved(scene: Scene, number: int) -> Scene:
    """Return a scene whose start differs by next to nothing: so many times MOVED."""
    return scene.replace(start_angle_deg=scene.start_angle_deg + number * MOVED)
