"""The residuals of a fit, in units of uncertainties, as a function of scaled keys."""

import dataclasses
import hashlib
import json
from collections.abc import Callable, Sequence
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np

from exu_press.errors import InputError
from exu_press.numerics.arrays import Array
from exu_press.parallel.task import COMPLETED, Row
from exu_press.result import Result
from exu_press.result.netcdf import read
from exu_press.scene import Scene
from exu_press.studies.base import Range
from exu_press.studies.base.evaluation import Evaluation, Point, error_in, numbers_in
from exu_press.studies.curve_file import channel_polynomials
from exu_press.studies.fit.measured import Curve, RecordedCurve, fit_sensor
from exu_press.studies.fit.study import Fit
from exu_press.verification.refinement import step_changes

__all__ = ["Problem", "file_of"]

FINER = 0.1
"""Tolerance (or fixed step) of the runs that give curves' errors, over the study's."""

FAR = 0.1
"""Scaled distance from the point of known errors of runs, above which they are renewed."""

REMAINS = 0.5
"""Uncertain fraction of a curve's error: the finer run has errors of its own, and other keys have
others."""

OF_DEVIATION = 0.5
"""Standard deviation over the error of a number, which is a 95 % interval."""


class Problem:
    """The residuals of a fit.

    The errors of runs add to the residuals' variance. A number has its own error. That of a curve
    is its difference d from a finer run, which is subtracted. Its shape is known, so that the
    remaining error is one further unknown: the covariance is I + e e^T, with e = REMAINS d.

    Attributes:
        errors: of runs in the unit of residuals, (numbers,): of curves with their signs.
    """

    def __init__(
        self, study: Fit, directory: Path, run: Callable[[Sequence[Scene]], Sequence[Row]]
    ) -> None:
        """Take the study; `run` saves the results of runs where there are curves."""
        self.study = study
        self.evaluation = Evaluation(study, (), run)
        self._directory = directory
        under = [*(m.under for m in study.measured), *(c.under for c in study.curve)]
        self._under: list[Point] = [u for n, u in enumerate(under) if u not in under[:n]]
        # with the number of their conditions
        self._measured = [(entry, self._under.index(entry.under)) for entry in study.measured]
        self._curves = [(curve, self._under.index(curve.under)) for curve in study.curve]
        ends = len(study.measured) + np.cumsum([0, *(len(c.read.at) for c in study.curve)])
        self._samples = [slice(a, b) for a, b in pairwise(ends)]
        self.errors = np.zeros(ends[-1])
        self._known_at: Array | None = None

    @property
    def count(self) -> float:
        """Number of independent measured numbers, less the sensors' unknown parameters."""
        curves = sum(curve.count - curve.nuisances for curve in self.study.curve)
        return len(self.study.measured) + curves

    def scale(self, name: str, value: float) -> float:
        """Return the scaled value of a key."""
        varied = self.study.keys[name]
        assert isinstance(varied, Range)
        return float(varied.share(np.asarray(value)))

    def __call__(self, points: Array) -> Array:
        """Return residuals, (points, numbers); NaN in all of a row if one of its runs failed.

        They are without the runs' errors, times the root of their inverse covariance.
        """
        residuals = self._of_runs(points)
        number = len(self.study.measured)
        residuals[:, :number] /= np.hypot(1.0, OF_DEVIATION * self.errors[:number])
        for curve in self._samples:
            residuals[:, curve] -= self.errors[curve]
            e = REMAINS * self.errors[curve]
            square = float(e @ e)
            if square > 0.0:
                factor = (1.0 - 1.0 / (1.0 + square) ** 0.5) / square
                residuals[:, curve] -= factor * np.outer(residuals[:, curve] @ e, e)
        return residuals

    def _of_runs(self, points: Array, **finer: float) -> Array:
        """Return residuals in units of the measured uncertainties, as `__call__`."""
        keys = [{**point, **finer} for x in points for point in self._points(x)]
        rows = self.evaluation.rows_of(keys)
        number = len(self._under)
        return np.array(
            [
                self._residuals(keys[first : first + number], rows[first : first + number])
                for first in range(0, len(keys), number)
            ]
        )

    def _points(self, x: Array) -> list[Point]:
        """Return all keys of a scaled point, for each condition of measurement."""
        return [{**self.study.point_of(x), **under} for under in self._under]

    def scenes(self, x: Array) -> list[Scene]:
        """Return the scenes of a point, one for each condition of measurement."""
        return list(map(self.study.scene_at, self._points(x)))

    def compute(self, x: Array) -> tuple[list[float], list[tuple[Array, RecordedCurve | None]]]:
        """Return the numbers at a point, and each curve as measured and as computed, SI."""
        rows = self.evaluation.rows_of(self._points(x))
        scenes = self.scenes(x)
        numbers = [numbers_in(rows[n], [entry.quantity])[0] for entry, n in self._measured]
        return numbers, [self._fit_sensor(curve, scenes[n]) for curve, n in self._curves]

    def renew_errors(self, x: Array, run_with_errors: Callable[[Array], Sequence[Row]]) -> bool:
        """Renew the runs' errors at a point far from that of the known ones; return whether.

        Args:
            x: scaled keys; a point that has run.
            run_with_errors: returns the rows with errors at such a point, one for each condition of
                measurement.

        Raises:
            InputError: the finer runs that curves need failed.
        """
        if self._known_at is not None and np.abs(x - self._known_at).max(initial=0.0) <= FAR:
            return False
        rows, errors = run_with_errors(x), []
        for entry, condition in self._measured:
            error = error_in(rows[condition], entry.quantity)
            errors.append((error or 0.0) / entry.uncertainty * entry.weight**0.5)
        self.errors[: len(errors)] = errors
        if self._curves:
            finer = step_changes(self.study.scene, FINER)
            change = self._of_runs(x[None]) - self._of_runs(x[None], **finer)
            difference = change[0, len(errors) :]
            if not np.isfinite(difference).all():
                raise InputError(
                    f"{self.evaluation.summary_line()}: no run with a {FINER:g} times as large "
                    f"{next(iter(finer))} tells the errors of curves; the cure is narrower "
                    "ranges, or what the runs' reasons say"
                )
            self.errors[len(errors) :] = difference
        self._known_at = x
        return True

    def check_curves(self, x: Array, rows: Sequence[Row]) -> None:
        """Check that channels exist, and that no curve lasts beyond the predictability horizon.

        Args:
            x: a point that has run.
            rows: its runs with errors, one for each condition of measurement.
        """
        scenes = self.scenes(x)
        for curve, condition in self._curves:
            path = self._directory / file_of(scenes[condition])
            if not path.exists():
                raise InputError(f"{curve.file}: the run at the start failed")
            result = read(path, Result)
            if self._fit_sensor(curve, scenes[condition])[1] is None:
                raise InputError(
                    f"{curve.file}: reaches from {curve.read.at[0]:g} to {curve.read.at[-1]:g} "
                    f"({curve.read.over}) and beyond the run; the cure is more revolutions, or a "
                    "smaller shift"
                )
            horizon = rows[condition].get("horizon")
            end = curve.read.at[-1]
            if curve.read.over == "crank_angle":
                end = np.interp(end, np.degrees(result["crank_angle"]), result.time)
            if horizon is not None and end > horizon:
                raise InputError(
                    f"{curve.file}: lasts to {end:g} s, and the motion is predictable to "
                    f"{horizon:.3g} s; the cure is a shorter curve, or to fit numbers of it"
                )

    def _residuals(self, keys: Sequence[Point], rows: Sequence[Row]) -> Array:
        blocks: list[Any] = []
        for entry, condition in self._measured:
            (value,) = numbers_in(rows[condition], [entry.quantity])
            blocks.append(np.array([(value - entry.value) / entry.uncertainty * entry.weight**0.5]))
        for curve, condition in self._curves:
            size = len(curve.read.at)
            block = np.full(size, np.nan)
            if rows[condition]["status"] == COMPLETED:
                measured, model = self._fit_sensor(curve, self.study.scene_at(keys[condition]))
                if model is not None:
                    scale = (curve.weight * curve.count / size) ** 0.5 / curve.uncertainty
                    block = (model.values - measured) * scale
            blocks.append(block)
        residuals = np.concatenate(blocks)
        return residuals if np.isfinite(residuals).all() else np.full(len(residuals), np.nan)

    def _fit_sensor(self, curve: Curve, scene: Scene) -> tuple[Array, RecordedCurve | None]:
        """Return a curve as measured, and as the sensor would record that of a scene's run."""
        result = read(self._directory / file_of(scene), Result)
        at, values, unit = channel_polynomials(curve.file, curve.read, result)
        measured = curve.values(unit)
        model = fit_sensor(curve, measured, at, values)
        return measured, None if model is None else dataclasses.replace(model, unit=unit)


def file_of(scene: Scene) -> str:
    """Return the file of a scene's run, in the study's directory."""
    text = json.dumps(scene.to_dict(), sort_keys=True)
    return f"runs/{hashlib.sha256(text.encode()).hexdigest()[:16]}.nc"
