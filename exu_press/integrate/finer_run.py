"""The error of a run: its difference from the same run with finer steps, in a copy of the process.

A run itself does not show how far its motion amplifies local errors, as impacts do.
"""

import dataclasses
import math
import sys
from collections.abc import Callable
from typing import Any

import exudyn as exu
import numpy as np

from exu_press.errors import InputError
from exu_press.integrate.outcome import Outcome, RunError
from exu_press.integrate.system import System
from exu_press.integrate.task import Task
from exu_press.numerics.arrays import Array
from exu_press.terminal.progress import Progress
from fe_models.processes import Child, ChildError

__all__ = ["Run", "Watch", "with_error"]

FINER = 0.25
"""Tolerance of the finer run over that of the run; errors of velocities are proportional."""

AMPLIFIED, INSTANTS = 10.0, 100
"""Tolerances above which a motion amplifies errors, and number of instants that are compared."""

Watch = Callable[[float], str]
"""Time, s -> why the motion has come to its end there, or nothing."""

Run = Callable[[float, Watch, int, bool], tuple[Outcome, Task]]
"""Solves a system from its start: tolerance, watch, budget, quiet, as in `solve_dynamic`."""

Answer = tuple[str, list[Array], list[Array]]
"""Of a finer run: why it stopped early, or nothing, its velocities and the rows of its sensors."""


class SampledVelocities:
    """Velocities at equally distant instants, by Hermite's cubics between the ends of steps.

    Attributes:
        times: of the instants, s.
        rows: velocities at those that were reached.
    """

    def __init__(self, system: System, settings: exu.SimulationSettings) -> None:
        """Look at a system that is about to be solved."""
        start, end = settings.timeIntegration.startTime, settings.timeIntegration.endTime
        self.times = np.linspace(start, end, INSTANTS + 1)[1:]
        self.rows: list[Array] = []
        self._state, self._close = system.current, 1e-9 * (end - start)
        self._last: tuple[float, Array, Array] | None = None

    def sampling_watch(self, watch: Watch) -> Watch:
        """Return a watch that keeps the velocities, too."""

        def watch_and_sample(time: float) -> str:
            self._sample(time)
            return watch(time)

        return watch_and_sample

    def _sample(self, time: float) -> None:
        """Keep velocities at the instants within the step that ends at a time, s."""
        v1, a1 = np.array(self._state.velocities), np.array(self._state.accelerations)
        while self._last is not None and len(self.rows) < INSTANTS:
            begin, v0, a0 = self._last
            at = self.times[len(self.rows)]
            if at > time + self._close:
                break
            h = time - begin
            s = min((at - begin) / h, 1.0)
            smooth, rest = s * s * (3.0 - 2.0 * s), 1.0 - s
            slopes = h * s * rest * (rest * a0 - s * a1)
            self.rows.append((1.0 - smooth) * v0 + smooth * v1 + slopes)
        self._last = time, v1, a1


def with_error(
    run: Run,
    system: System,
    settings: exu.SimulationSettings,
    tolerance: float | None,
    watch: Watch,
    max_steps: int,
    quiet: bool,
) -> Outcome:
    """Return how a run ended, with its error where it got to its end.

    Raises:
        InputError: the steps are fixed, or this process cannot be copied.
    """
    if tolerance is None:
        raise InputError(
            "errors = True: allowed with a tolerance; compare fixed steps with steps of half the "
            "size"
        )
    _refuse_uncopied(system.mbs)
    motion, finer = SampledVelocities(system, settings), SampledVelocities(system, settings)

    def run_finer() -> Answer:
        integration, shorter = settings.timeIntegration, math.sqrt(FINER)
        integration.numberOfSteps = math.ceil(integration.numberOfSteps / shorter)
        integration.initialStepSize *= shorter
        integration.minimumStepSize *= shorter
        _write_nothing(system.mbs, settings)
        most = math.ceil(max_steps / FINER)
        try:
            outcome, _ = run(FINER * tolerance, finer.sampling_watch(watch), most, True)
            why = "" if outcome.status.reached_end else f"{outcome.status.value}: {outcome.reason}"
        except Exception as error:  # of the user's functions; the run itself tells its own
            why = " ".join(str(error).partition("\n\nAt:")[0].split())  # without the calls
        return why, finer.rows, _rows(system.mbs)

    with Child(run_finer) as copy:
        copy.request()
        outcome, task = run(tolerance, motion.sampling_watch(watch), max_steps, quiet)
        if not outcome.status.reached_end:
            return outcome
        with Progress("finer run", 1.0, "run", quiet=quiet) as progress:
            answer = _answer(copy)
            progress.update(1.0)
    return dataclasses.replace(outcome, error=_error(task, motion, answer))


def _refuse_uncopied(mbs: exu.MainSystem) -> None:
    """Refuse a process that cannot be copied."""
    if sys.platform != "linux":
        raise InputError(
            "errors = True: allowed on Linux, where a copy of the process does the finer run; "
            "build the system twice, and compare with a run of a quarter of the tolerance"
        )
    container: Any = mbs.GetSystemContainer()
    if container.renderer.IsActive():
        raise InputError(
            "errors = True: allowed without a window, as a copy of the process has none: stop the "
            "renderer"
        )


def _answer(copy: Child) -> Answer:
    """Return the finer run's answer; Ctrl-C ends it, and the run itself is not lost."""
    try:
        answer: Answer = copy.answer()
        return answer
    except KeyboardInterrupt:
        why = "interrupted"
    except ChildError as error:
        why = f"its process ended: {error}"
    return why, [], []


def _write_nothing(mbs: exu.MainSystem, settings: exu.SimulationSettings) -> None:
    """Switch off all files; the run itself writes them."""
    output = settings.solution
    output.file.write = output.restart.write = False
    output.recordImagesInterval = -1.0
    settings.timeIntegration.verboseModeFile = 0
    data: Any = mbs.systemData
    for number in range(data.NumberOfSensors()):
        mbs.SetSensorParameter(number, "writeToFile", False)


def _rows(mbs: exu.MainSystem) -> list[Array]:
    """Return the rows that each sensor has kept, time first; none where it keeps none."""
    data: Any = mbs.systemData
    return [
        np.array(mbs.GetSensorStoredData(number))
        if mbs.GetSensor(number)["storeInternal"]
        else np.zeros((0, 1))
        for number in range(data.NumberOfSensors())
    ]


def _error(task: Task, motion: SampledVelocities, answer: Answer) -> RunError:
    """Return the error of a run from its differences to the finer run."""
    reason, finer, sensors = answer
    coverage, scales = task.tuning.coverage, task.scales
    errors = coverage * np.array(
        [
            scales.norm((ours - theirs).tolist())
            for ours, theirs in zip(motion.rows, finer, strict=False)
        ]
    )
    errors /= scales.speed or 1.0
    above = [*motion.times[: len(errors)][~(errors <= AMPLIFIED * task.tolerance)]]
    if reason:
        above.append(motion.times[min(len(errors), len(motion.times) - 1)])
    pairs = [] if reason else zip(_rows(task.system.mbs), sensors, strict=True)
    differences = [_differences(*pair) for pair in pairs]
    return RunError(
        motion=math.inf if reason else float(errors.max(initial=0.0)),
        since=float(above[0]) if above else math.inf,
        sensors=[coverage * largest for largest, _ in differences],
        peaks=[coverage * of_peak for _, of_peak in differences],
        reason=reason,
    )


def _differences(rows: Array, finer: Array) -> tuple[Array, Array]:
    """Return the largest differences of a sensor's values from a finer run's, and of its peaks.

    Rows are (rows, 1 + values), time first; they count up to the last one of both runs.
    """
    if not (len(rows) and len(finer)):
        return np.zeros(0), np.zeros(0)
    times = rows[rows[:, 0] <= finer[-1, 0], 0]
    theirs = np.array([np.interp(times, finer[:, 0], column) for column in finer[:, 1:].T]).T
    largest = np.abs(rows[: len(times), 1:] - theirs).max(axis=0, initial=0.0)
    return largest, np.abs(np.abs(rows[:, 1:]).max(axis=0) - np.abs(finer[:, 1:]).max(axis=0))
