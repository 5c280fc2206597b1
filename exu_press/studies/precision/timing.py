"""One run, timed: the median of several after a warm-up.

Processor time is the time of the run's one thread; on a machine with nothing else to do
it is the wall time, and on a busy one it can still be compared.
"""

import statistics
import time
from collections.abc import Callable, Iterable
from dataclasses import dataclass, field, fields, replace
from typing import Any

from exu_press.model import build
from exu_press.result import Result, record
from exu_press.scene import Scene
from exu_press.studies.precision.errors import Trajectory, trajectory_of

__all__ = [
    "FIXED",
    "LONG_RUN",
    "OUTCOME",
    "TOLERANCE",
    "Attempt",
    "Outcome",
    "TimedRun",
    "attempt",
    "fixed_steps",
    "run",
    "run_scene",
    "shift_start",
    "time_runs",
    "timed_run_of",
    "tolerances",
]

FIXED = "fixed step"
TOLERANCE = "tolerance"

START_SHIFT = 2e-4
"""Shift of a start, deg: a tenth of a micrometre at the pin of a crank of 30 mm."""

LONG_RUN = 5.0
"""s; a run that takes longer is not repeated: noise of tenths of seconds does not matter there."""


@dataclass(frozen=True, kw_only=True)
class Outcome:
    """End of a run, and what the integrator counted; None where it does not say.

    Attributes:
        status: "completed" or how it failed.
        steps: accepted ones.
        rejected_steps: repeated ones.
        newton_iterations: of all steps.
        law_evaluations: of the joints' forces, or of the right-hand side.
    """

    status: str = "completed"
    reason: str = ""
    steps: int | None = None
    rejected_steps: int | None = None
    newton_iterations: int | None = None
    law_evaluations: int | None = None


OUTCOME = tuple(field.name for field in fields(Outcome))


@dataclass(frozen=True)
class TimedRun(Outcome):
    """Trajectory and cost of one run.

    Attributes:
        trajectory: None if it failed.
        wall_times: of the integration alone, of every repetition, s.
        cpu_times: processor time of the same, s.
        starts: of repetitions from starts that differ by less than is known.
    """

    trajectory: Trajectory | None
    wall_times: tuple[float, ...]
    cpu_times: tuple[float, ...]
    starts: tuple[Trajectory, ...] = ()

    @property
    def wall_time(self) -> float:
        """Median, s."""
        return statistics.median(self.wall_times)

    @property
    def cpu_time(self) -> float:
        """Median, s."""
        return statistics.median(self.cpu_times)


@dataclass(frozen=True)
class Attempt:
    """A solver with one setting, ready to run.

    Attributes:
        solver: as it is shown.
        setting: that is varied: "step", "tolerance".
        value: of the setting, s or dimensionless.
        run: does it once.
        again: does it once more for its time, as one of several starts; None: `run` does.
    """

    solver: str
    setting: str
    value: float
    run: Callable[[], TimedRun] = field(repr=False)
    again: Callable[[int], TimedRun] | None = field(default=None, repr=False)


def time_runs(attempt: Attempt, repeats: int, longest: float = LONG_RUN) -> TimedRun:
    """Run an attempt several times; the trajectory is that of the first run.

    Args:
        longest: once does where a run takes longer than this, s.
    """
    first = attempt.run()
    runs = [first]
    if first.status == "completed" and first.cpu_time < longest:
        again = attempt.again or (lambda _: replace(attempt.run(), trajectory=None))
        runs += [again(number) for number in range(1, repeats)]
    return replace(
        first,
        wall_times=tuple(run.wall_time for run in runs),
        cpu_times=tuple(run.cpu_time for run in runs),
        starts=tuple(run.trajectory for run in runs[1:] if run.trajectory is not None),
    )


def timed_run_of(result: Result, cpu_time: float) -> TimedRun:
    """Return a result of the package as a measurement, with its processor time, s."""
    info: dict[str, Any] = {**result.info}
    return TimedRun(
        trajectory=trajectory_of(result) if result.completed else None,
        wall_times=(float(info["wall_time"]),),
        cpu_times=(cpu_time,),
        status="completed" if result.completed else info["status"],  # coarse steps are its subject
        **{name: info[name] for name in OUTCOME if name != "status"},
    )


def run_scene(scene: Scene, setting: str, value: float) -> TimedRun:
    """Run a scene with `setting` ("step" or "tolerance") at a value."""
    return run(scene.replace({f"solver.{setting}": value}))


def run(scene: Scene) -> TimedRun:
    """Run a scene as it is."""
    model = build(scene)
    start = time.process_time()
    outcome = model.solve()
    cpu_time = time.process_time() - start
    result = record(model, outcome)
    model.SC.Reset()  # system and solver hold each other, and all they recorded
    return timed_run_of(result, cpu_time)


def fixed_steps(scene: Scene, steps: Iterable[float]) -> list[Attempt]:
    """Return the runs with fixed steps, s."""
    return [attempt(FIXED, scene, "step", h) for h in steps]


def tolerances(scene: Scene, values: Iterable[float]) -> list[Attempt]:
    """Return the runs with tolerances."""
    return [attempt(TOLERANCE, scene, "tolerance", value) for value in values]


def attempt(solver: str, scene: Scene, setting: str, value: float) -> Attempt:
    """Return a run of a solver, repeated from slightly shifted starts."""
    return Attempt(
        solver,
        setting,
        value,
        run=lambda: run_scene(scene, setting, value),
        again=lambda number: run_scene(shift_start(scene, number), setting, value),
    )


def shift_start(scene: Scene, number: int) -> Scene:
    """Return a scene whose start is shifted by `number` times START_SHIFT."""
    return scene.replace({"start_angle_deg": scene.start_angle_deg + number * START_SHIFT})
