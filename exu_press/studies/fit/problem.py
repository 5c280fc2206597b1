"""A fit as a solver sees it: scaled keys in, residuals in units of uncertainties out."""

import dataclasses
import hashlib
import json
import math
from collections.abc import Callable, Sequence
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np

from exu_press.errors import InputError
from exu_press.numerics.arrays import Array
from exu_press.parallel.task import COMPLETED, Row
from exu_press.result import Result
from exu_press.scene import Scene
from exu_press.studies.base import Range
from exu_press.studies.base.evaluation import Evaluation, Point, error_in, numbers_in
from exu_press.studies.curve_file import computed
from exu_press.studies.fit.curve import Curve, Matched, matched
from exu_press.studies.fit.study import Fit

__all__ = ["Problem", "file_of"]

FINER = 0.1
"""Tolerance (or fixed step) of the runs that curves' errors are found with, over the study's."""

FAR = 0.1
"""Scaled distance from where the runs' errors are known at which they are found anew."""

REMAINS = 0.5
"""Part of a curve's difference from a finer run: that has errors of its own, and other keys other
ones."""

OF_DEVIATION = 0.5
"""Standard deviation over the error of a number, which 95 % of true values are within."""


class Problem:
    """The residuals of a fit.

    What runs miss is part of the residuals' variance. A number has its own error. That of a curve
    is its difference d from a finer run, which is taken away. It has one shape all along, so that
    what remains is one further unknown: the covariance is I + e e^T, with e = REMAINS d.

    Attributes:
        study: to be run.
        evaluation: its runs.
        errors: of runs in the unit of residuals, (numbers,): of curves with their signs.
    """

    def __init__(
        self, study: Fit, directory: Path, run: Callable[[Sequence[Scene]], Sequence[Row]]
    ) -> None:
        """Take the study; `run` keeps the files of runs where there are curves."""
        self.study = study
        self.evaluation = Evaluation(study, (), run)
        self._directory = directory
        self._keys = {n: each for n, each in study.keys.items() if isinstance(each, Range)}
        every = [*(one.under for one in study.measured), *(one.under for one in study.curve)]
        self._under: list[Point] = [u for n, u in enumerate(every) if u not in every[:n]]
        sizes = [len(one.read.at) for one in study.curve]
        ends = len(study.measured) + np.cumsum([0, *sizes])
        self._curves = [slice(a, b) for a, b in pairwise(ends)]
        self.errors = np.zeros(ends[-1])
        self._known_at: Array | None = None

    @property
    def count(self) -> float:
        """Number of independent measured numbers, less the sensors' unknown parameters."""
        curves = sum(one.count - one.nuisances for one in self.study.curve)
        return len(self.study.measured) + curves

    def point(self, x: Array) -> dict[str, float]:
        """Return the keys' values at a scaled point."""
        return {
            name: float(each.at(np.asarray(min(max(share, 0.0), 1.0))))
            for (name, each), share in zip(self._keys.items(), x, strict=True)
        }

    def scaled(self, name: str, value: float) -> float:
        """Return the scaled value of a key."""
        return float(self._keys[name].share(np.asarray(value)))

    def __call__(self, points: Array) -> Array:
        """Return residuals, (points, numbers); NaN in all of a row one of whose runs failed.

        They are without what runs miss, times the root of their inverse covariance.
        """
        found = self._of_runs(points)
        number = len(self.study.measured)
        found[:, :number] /= np.hypot(1.0, OF_DEVIATION * self.errors[:number])
        for curve in self._curves:
            found[:, curve] -= self.errors[curve]
            remains = REMAINS * self.errors[curve]
            square = float(remains @ remains)
            if square > 0.0:
                part = (1.0 - 1.0 / (1.0 + square) ** 0.5) / square
                found[:, curve] -= part * np.outer(found[:, curve] @ remains, remains)
        return found

    def _of_runs(self, points: Array, **finer: float) -> Array:
        """Return residuals in units of the measured uncertainties, as `__call__`."""
        asked = [{**self.point(x), **under, **finer} for x in points for under in self._under]
        rows = self.evaluation.rows_of(asked)
        number = len(self._under)
        return np.array(
            [
                self._residuals(asked[place : place + number], rows[place : place + number])
                for place in range(0, len(asked), number)
            ]
        )

    def scenes(self, x: Array) -> list[Scene]:
        """Return the scenes of a point, one for each place of measuring."""
        return [self.study.scene_at({**self.point(x), **under}) for under in self._under]

    def computed(self, x: Array) -> tuple[list[float], list[tuple[Array, Matched | None]]]:
        """Return the numbers at a point, and each curve as measured and as computed, SI."""
        rows = self.evaluation.rows_of([{**self.point(x), **under} for under in self._under])
        numbers = [
            numbers_in(rows[self._under.index(one.under)], [one.quantity])[0]
            for one in self.study.measured
        ]
        scenes = self.scenes(x)
        return numbers, [
            self._matched(one, scenes[self._under.index(one.under)]) for one in self.study.curve
        ]

    def renew_errors(self, x: Array, checked: Callable[[Array], Sequence[Row]]) -> bool:
        """Find the runs' errors at a point, if it is far from where they are known; return if so.

        Args:
            x: scaled keys; a point that has run.
            checked: returns the rows with errors at such a point, one a place of measuring.

        Raises:
            InputError: the finer runs that curves need failed.
        """
        if self._known_at is not None and np.abs(x - self._known_at).max(initial=0.0) <= FAR:
            return False
        rows, found = checked(x), []
        for one in self.study.measured:
            error = error_in(rows[self._under.index(one.under)], one.quantity)
            found.append((error or 0.0) / one.uncertainty * one.weight**0.5)
        self.errors[: len(found)] = found
        if self._curves:
            solver = self.study.scene.solver
            assert solver is not None
            name = "tolerance" if solver.step is None else "step"
            finer = {
                f"solver.{name}": FINER * getattr(solver, name),
                "solver.max_step_deg": FINER**0.5 * solver.max_step_deg,
                "solver.max_steps": math.ceil(solver.max_steps / FINER),
            }
            apart = (self._of_runs(x[None]) - self._of_runs(x[None], **finer))[0, len(found) :]
            if not np.isfinite(apart).all():
                raise InputError(
                    f"{'; '.join(self.evaluation.told())}: no run with a {FINER:g} times as large "
                    f"solver.{name} tells the errors of curves; the cure is narrower ranges, or "
                    "what the runs' reasons say"
                )
            self.errors[len(found) :] = apart
        self._known_at = x
        return True

    def check_curves(self, x: Array, rows: Sequence[Row]) -> None:
        """Check that channels are there, and that no curve lasts longer than runs are predictable.

        Args:
            x: a point that has run.
            rows: its runs with errors, one for each place of measuring.

        Raises:
            InputError: one is not.
        """
        scenes = self.scenes(x)
        for one in self.study.curve:
            place = self._under.index(one.under)
            path = self._directory / file_of(scenes[place])
            if not path.exists():
                raise InputError(f"{one.file}: the run at the start failed")
            found = Result.load(path)
            if self._matched(one, scenes[place])[1] is None:
                raise InputError(
                    f"{one.file}: reaches from {one.read.at[0]:g} to {one.read.at[-1]:g} "
                    f"({one.read.over}) and beyond the run; the cure is more revolutions, or a "
                    "smaller shift"
                )
            horizon = rows[place].get("horizon")
            end = one.read.at[-1]
            if one.read.over == "crank_angle":
                turned = np.degrees(found["crank_angle"])
                end = np.interp(end, turned, found.time)
            if horizon is not None and end > horizon:
                raise InputError(
                    f"{one.file}: lasts to {end:g} s, and the motion is predictable to "
                    f"{horizon:.3g} s; the cure is a shorter curve, or to fit numbers of it"
                )

    def _residuals(self, asked: Sequence[Point], rows: Sequence[Row]) -> Array:
        """Return the residuals of one point's runs."""
        found: list[Any] = []
        for one in self.study.measured:
            (value,) = numbers_in(rows[self._under.index(one.under)], [one.quantity])
            found.append(np.array([(value - one.value) / one.uncertainty * one.weight**0.5]))
        for curve in self.study.curve:
            place = self._under.index(curve.under)
            size = len(curve.read.at)
            if rows[place]["status"] != COMPLETED:
                found.append(np.full(size, np.nan))
                continue
            wanted, told = self._matched(curve, self.study.scene_at(asked[place]))
            scale = (curve.weight * curve.count / size) ** 0.5 / curve.uncertainty
            found.append(np.full(size, np.nan) if told is None else (told.values - wanted) * scale)
        every = np.concatenate(found)
        return every if np.isfinite(every).all() else np.full(len(every), np.nan)

    def _matched(self, curve: Curve, scene: Scene) -> tuple[Array, Matched | None]:
        result = Result.load(self._directory / file_of(scene))
        at, values, unit = computed(curve.file, curve.read, result)
        wanted = curve.values(unit)
        told = matched(curve, wanted, at, values)
        return wanted, None if told is None else dataclasses.replace(told, unit=unit)


def file_of(scene: Scene) -> str:
    """Return where the run of a scene is kept, in the study's directory."""
    text = json.dumps(scene.to_dict(), sort_keys=True)
    return f"runs/{hashlib.sha256(text.encode()).hexdigest()[:16]}.nc"
