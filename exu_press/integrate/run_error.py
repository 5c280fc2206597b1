"""The error of a run: its difference from the same run with finer steps, in a copy of the process.

Nothing within a run tells how far the motion amplifies what its steps miss, as impacts do, or a
body that turns about its middle axis.
"""

import dataclasses
import math
import sys
from collections.abc import Callable
from typing import Any

import exudyn as exu
import numpy as np

from exu_press.errors import InputError
from exu_press.integrate.motion import Motion, Watch
from exu_press.integrate.outcome import Outcome, RunError
from exu_press.integrate.problem import Problem
from exu_press.integrate.scales import FoundScales
from exu_press.numerics.arrays import Array
from exu_press.terminal.progress import Progress
from fe_models.processes import Child, ChildError

__all__ = ["Run", "with_error"]

FINER = 0.25
"""Tolerance of the finer run over the run's; errors of velocities go with it."""

COVERED = 10.0 / 3.0
"""Error over the difference. Where errors go with the tolerance, they are 4/3 of it; with this the
stated ones cover the true ones in 60 of 63 of Exudyn's scripts, and in 86 of 88 systems by chance.
"""

AMPLIFIED = 10.0
"""Tolerances above which an error is more than that of steps alone."""

Run = Callable[[float, Watch, int, bool], tuple[Outcome, FoundScales]]
"""Solves a problem from its start: tolerance, watch, budget, quiet, as in `solve_dynamic` -> how it
ended, and the scales of its errors."""


def with_error(
    run: Run,
    problem: Problem,
    settings: exu.SimulationSettings,
    tolerance: float | None,
    period: float,
    watch: Watch,
    max_steps: int,
    quiet: bool,
) -> tuple[Outcome, FoundScales]:
    """Return how a run ended, with its error where it got to its end, and the scales of errors.

    Args:
        run: solves the problem.
        problem: to be solved.
        settings: Exudyn's, of the run; the others as in `solve_dynamic`.
        period: on whose multiples steps end, s, or 0.0: it may bound them.

    Raises:
        InputError: no finer run in a copy of this process would tell.
    """
    if tolerance is None:
        raise InputError(
            "errors = True: allowed with a tolerance; compare fixed steps with steps of half the "
            "size"
        )
    _refuse_uncopied(problem.mbs)
    motion, finer = Motion(problem, settings), Motion(problem, settings)

    def with_finer_steps() -> tuple[str, Array, list[Array]]:
        integration = settings.timeIntegration
        shorter = math.sqrt(FINER)
        periods = (integration.endTime - integration.startTime) / (period or math.inf)
        at_least = max(integration.numberOfSteps, periods)
        integration.numberOfSteps = math.ceil(at_least / shorter)
        integration.initialStepSize *= shorter
        integration.minimumStepSize *= shorter
        _write_nothing(problem.mbs, settings)
        most = math.ceil(max_steps / FINER)
        try:
            outcome = run(FINER * tolerance, finer.beside(watch), most, True)[0]
            why = "" if outcome.status.ended else f"{outcome.status.value}: {outcome.reason}"
        except Exception as error:  # of the user's functions; the run itself tells its own
            why = " ".join(str(error).partition("\n\nAt:")[0].split())  # without the calls
        return why, np.array(finer.rows), _rows(problem.mbs)

    with Child(with_finer_steps) as copy:
        copy.request()
        outcome, scales = run(tolerance, motion.beside(watch), max_steps, quiet)
        if not outcome.status.ended:
            return outcome, scales
        with Progress("finer run", 1.0, "run", quiet=quiet) as progress:
            found = _answer(copy)
            progress.update(1.0)
    error = _error(problem.mbs, scales, motion, found, AMPLIFIED * tolerance)
    return dataclasses.replace(outcome, error=error), scales


def _refuse_uncopied(mbs: exu.MainSystem) -> None:
    """Refuse to copy this process where the copy would not do."""
    if sys.platform != "linux":
        raise InputError(
            "errors = True: allowed on Linux, where a copy of the process does the finer run; "
            "build the system twice, and compare with a run of a quarter of the tolerance"
        )
    container: Any = mbs.GetSystemContainer()
    if container.renderer.IsActive():
        raise InputError(
            "errors = True: allowed without a window, which the copy of the process has not: stop "
            "the renderer"
        )


def _answer(copy: Child) -> tuple[str, Array, list[Array]]:
    """Return why the finer run stopped early, or nothing, its motion and the rows of its sensors.

    Ctrl-C ends it, and the run itself is not lost.
    """
    try:
        answer: tuple[str, Array, list[Array]] = copy.answer()
        return answer
    except KeyboardInterrupt:
        why = "interrupted"
    except ChildError as error:
        why = f"its process ended: {error}"
    return why, np.zeros((0, 0)), []


def _write_nothing(mbs: exu.MainSystem, settings: exu.SimulationSettings) -> None:
    """Leave all files to the run itself."""
    output = settings.solution
    output.file.write = output.restart.write = False
    output.recordImagesInterval = -1.0
    settings.timeIntegration.verboseModeFile = 0
    for number in range(_count(mbs)):
        mbs.SetSensorParameter(number, "writeToFile", False)


def _count(mbs: exu.MainSystem) -> int:
    """Return the number of a system's sensors."""
    data: Any = mbs.systemData
    return int(data.NumberOfSensors())


def _rows(mbs: exu.MainSystem) -> list[Array]:
    """Return the rows that each sensor has kept, time first; none where it keeps none."""
    return [
        np.array(mbs.GetSensorStoredData(number))
        if mbs.GetSensor(number)["storeInternal"]
        else np.zeros((0, 1))
        for number in range(_count(mbs))
    ]


def _error(
    mbs: exu.MainSystem,
    scales: FoundScales,
    motion: Motion,
    finer: tuple[str, Array, list[Array]],
    amplified: float,
) -> RunError:
    """Return the error of a run by its differences from a finer one.

    Args:
        mbs: the system.
        scales: of errors, at the run's end.
        motion: of the run.
        finer: of the finer run: why it stopped early, its motion, rows of its sensors.
        amplified: error from which on it is above that of steps alone.
    """
    reason, rows, sensors = finer
    errors = COVERED * motion.apart(rows, scales)
    above = [*motion.times[: len(errors)][~(errors <= amplified)]]
    if reason:
        above.append(motion.times[min(len(errors), len(motion.times) - 1)])
    both = [] if reason else zip(_rows(mbs), sensors, strict=True)
    found = [_of_sensor(*pair) for pair in both]
    return RunError(
        motion=math.inf if reason else float(errors.max(initial=0.0)),
        since=float(above[0]) if above else math.inf,
        sensors=[worst for worst, _ in found],
        peaks=[peak for _, peak in found],
        reason=reason,
    )


def _of_sensor(rows: Array, finer: Array) -> tuple[Array, Array]:
    """Return the errors of a sensor's values, up to the last row of both runs, and of its peaks.

    Args:
        rows: time, s, and values, (rows, 1 + values); none where they were not kept.
        finer: likewise, of the finer run.
    """
    if not (len(rows) and len(finer)):
        return np.zeros(0), np.zeros(0)
    times = rows[rows[:, 0] <= finer[-1, 0], 0]
    ours, read = rows[: len(times), 1:], np.zeros((len(times), rows.shape[1] - 1))
    for k in range(read.shape[1]):
        read[:, k] = np.interp(times, finer[:, 0], finer[:, k + 1])
    peaks = np.abs(rows[:, 1:]).max(axis=0) - np.abs(finer[:, 1:]).max(axis=0)
    return COVERED * np.abs(ours - read).max(axis=0, initial=0.0), COVERED * np.abs(peaks)
