"""A row of precision.json, and orders of a series of rows."""

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from statistics import linear_regression
from typing import Any

from exu_press.studies.precision.errors import Errors
from exu_press.studies.precision.timing import OUTCOME, Attempt, Outcome, TimedRun

__all__ = ["ERRORS", "Row", "order_of", "orders_of", "row_of", "series_of"]

ERRORS = ("error_position", "error_velocity", "error_peak_acceleration")


@dataclass(frozen=True)
class Row(Outcome):
    """One run.

    Attributes:
        setting: "step", "tolerance" or "modes".
        value: of the setting, s, dimensionless or a number.
        error_position: largest up to the horizon, m; None if the run failed or there is no
            reference.
        error_velocity: the same, m/s.
        error_peak_acceleration: relative.
        at_most: names of the errors that the reference does not resolve: they are at most this.
        wall_time: median, s.
        cpu_time: median of the processor time, s.
        wall_times: of every repetition, s.
        error_peaks: of the peaks of a whole run in which trajectories diverge, relative.
    """

    case: str
    solver: str
    setting: str
    value: float
    error_position: float | None
    error_velocity: float | None
    error_peak_acceleration: float | None
    at_most: tuple[str, ...]
    wall_time: float
    cpu_time: float
    wall_times: tuple[float, ...]
    error_peaks: float | None

    def resolved_error(self, error: str) -> float | None:
        """Return an error; None where it is missing or below what the reference resolves."""
        value: float | None = getattr(self, error)
        return None if error in self.at_most else value


def row_of(
    case: str,
    attempt: Attempt,
    run: TimedRun,
    errors: Errors,
    floor: Errors,
    peaks: float | None,
) -> Row:
    """Return the row of a run; errors below the floor are raised to it and marked."""
    names = dict(zip(ERRORS, ("position", "velocity", "peak_acceleration"), strict=True))
    values: dict[str, Any] = {}
    at_most = []
    for error, name in names.items():
        value, least = getattr(errors, name), getattr(floor, name)
        if value is not None and least is not None and value <= least > 0.0:
            value = least
            at_most.append(error)
        values[error] = value
    return Row(
        case=case,
        solver=attempt.solver,
        setting=attempt.setting,
        value=attempt.value,
        at_most=tuple(at_most),
        wall_time=run.wall_time,
        cpu_time=run.cpu_time,
        wall_times=run.wall_times,
        error_peaks=peaks,
        **{name: getattr(run, name) for name in OUTCOME},
        **values,
    )


def series_of(rows: Iterable[Row]) -> dict[tuple[str, str], list[Row]]:
    """Return the rows by case and solver, each series from its coarsest setting on."""
    series: dict[tuple[str, str], list[Row]] = {}
    for row in rows:
        series.setdefault((row.case, row.solver), []).append(row)
    return {key: sorted(some, key=lambda row: -row.value) for key, some in series.items()}


def orders_of(rows: Iterable[Row]) -> list[dict[str, Any]]:
    """Return the observed orders of every series over steps or tolerances."""
    return [
        {
            "case": case,
            "solver": solver,
            "setting": series[0].setting,
            **{error: order_of(series, error) for error in ERRORS},
        }
        for (case, solver), series in series_of(rows).items()
        if len(series) > 1 and series[0].setting != "modes"
    ]


def order_of(series: Sequence[Row], error: str = "error_position") -> float | None:
    """Return the observed order: the slope of error over setting at its three finest points."""
    points = [
        (math.log(row.value), math.log(value))
        for row in series
        if row.status == "completed"
        and (value := row.resolved_error(error)) is not None
        and value > 0.0
    ][-3:]
    return linear_regression(*zip(*points, strict=True)).slope if len(points) > 1 else None
