"""Fronts and minima that are known in closed form, through the code of the command."""

import sys

import numpy as np
import pytest

from exu_press import InputError
from exu_press.studies.base import Range, Values
from exu_press.studies.optimise.several import (
    advise_sampler,
    choose_compromise,
    front,
    search_front,
)
from exu_press.studies.optimise.single import evolve, merit, simplex, spread_points
from exu_press.studies.optimise.study import NSGA, TPE, Limit

KEYS = {f"x{n}": Range(low=0.0, high=1.0) for n in range(4)}


class Zdt1:
    """E. Zitzler, K. Deb, L. Thiele, Evolutionary Computation 8 (2000) 173-195: T1.

    Its front is f2 = 1 - sqrt(f1), f1 from 0 to 1.
    """

    def __init__(self, failing=False, limit=None):
        self.values, self.violations, self.points = [], [], []
        self.failing, self.limit = failing, limit

    def __call__(self, points):
        x = np.array([list(point.values()) for point in points])
        g = 1.0 + 9.0 * x[:, 1:].mean(axis=1)
        found = np.column_stack([x[:, 0], g * (1.0 - np.sqrt(x[:, 0] / g))])
        if self.failing:
            found[x[:, 1] > 0.7] = np.nan
        beyond = np.zeros(len(x)) if self.limit is None else np.maximum(x[:, 0] - self.limit, 0.0)
        self.values += list(found)
        self.violations += list(beyond)
        self.points += list(points)
        return found, beyond

    @property
    def front(self):
        values = np.array(self.values)
        return values[front(values, np.array(self.violations))]


@pytest.mark.parametrize(
    ("method", "trials", "wide", "off"),
    [(TPE, 240, 0.4, 0.15), pytest.param(NSGA, 1600, 0.8, 0.15, marks=pytest.mark.long)],
)
def test_zdt1(method, trials, wide, off):
    problem = Zdt1()
    search_front(problem, KEYS, 2, trials, method, 1)
    found = problem.front
    assert len(found) >= 8
    assert np.ptp(found[:, 0]) > wide
    distance = found[:, 1] - (1.0 - np.sqrt(found[:, 0]))
    assert distance.min() >= -1e-12
    assert np.median(distance) < off


def test_failed_points_and_limits():
    problem = Zdt1(failing=True, limit=0.5)
    search_front(problem, KEYS, 2, 96, TPE, 1)
    assert any(np.isnan(value).all() for value in problem.values)
    assert np.isfinite(problem.front).all()
    assert problem.front[:, 0].max() <= 0.5
    assert problem.front[:, 1].min() >= 1.0 - np.sqrt(0.5)


def test_keys_with_values_to_choose_from():
    asked = []

    def ask(points):
        asked.extend(points)
        best = [abs(p["x"] - 0.3) + (p["law"] != "finite") for p in points]
        return np.array(best)[:, None], np.zeros(len(points))

    keys = {"x": Range(low=0.0, high=1.0), "law": Values(("short", "finite", "pinkus"))}
    search_front(ask, keys, 1, 64, advise_sampler(64), 0)
    best = min(asked, key=lambda p: abs(p["x"] - 0.3) + (p["law"] != "finite"))
    assert best["law"] == "finite"
    assert best["x"] == pytest.approx(0.3, abs=0.05)


def test_front_and_choice():
    values = np.array([[1.0, 3.0], [2.0, 2.0], [2.0, 2.5], [3.0, 1.0], [0.0, 0.0], [0.5, np.nan]])
    violations = np.array([0.0, 0.0, 0.0, 0.0, 0.1, 0.0])
    assert front(values, violations).tolist() == [0, 1, 3]
    assert front(values[:1], np.array([1.0])).tolist() == []
    assert choose_compromise(values[[0, 1, 3]], [1.0, 1.0]) == 1
    assert choose_compromise(values[[0, 1, 3]], [10.0, 1.0]) == 0


class Bowl:
    """A bowl around (0.8, 0.3), of which only the part with x + y <= 1 is allowed."""

    def __init__(self):
        self.best = (np.inf, None)
        self.count = 0

    def __call__(self, points):
        points = np.clip(points, 0.0, 1.0)
        values = (points[:, 0] - 0.8) ** 2 + 4.0 * (points[:, 1] - 0.3) ** 2
        beyond = np.maximum(points.sum(axis=1) - 1.0, 0.0)
        self.count += len(points)
        for x, value, over in zip(points, values, beyond, strict=True):
            if over == 0.0 and value < self.best[0]:
                self.best = value, x
        return merit(values, beyond, 1.0)


LEAST = 0.8 * 0.1**2
"""On the line x + y = 1 by Lagrange's multiplier."""


def test_the_least_of_a_bowl_within_limits():
    walked, evolved = Bowl(), Bowl()
    points = spread_points(2, 16, 0)
    simplex(walked, points[int(walked(points).argmin())], 120)
    assert walked.count <= 160
    evolve(evolved, 2, 600, 0)
    assert [walked.best[0], evolved.best[0]] == pytest.approx([LEAST, LEAST], abs=2e-3)
    without_number = merit(np.array([1.0, np.nan, 2.0]), np.array([0.0, 0.0, 0.5]), 1.0)
    assert without_number.argsort().tolist() == [0, 2, 1]


def test_without_optuna_the_cure_is_told(monkeypatch):
    monkeypatch.setitem(sys.modules, "optuna", None)
    with pytest.raises(InputError, match=r"pip install 'exu-press\[optimise\]'"):
        search_front(Zdt1(), KEYS, 2, 8, TPE, 0)


def test_limits_of_different_size_are_missed_by_their_parts():
    """50 beyond 100 is more than 300 beyond 1000, and 2 below 4 as much as 500 below 1000."""
    small, large = Limit("a", below=100.0), Limit("b", below=1000.0)
    assert small.violation(150.0) == pytest.approx(0.5)
    assert large.violation(1300.0) == pytest.approx(0.3)
    assert Limit("a", above=4.0).violation(2.0) == Limit("b", above=1e3).violation(500.0) == 0.5
    assert Limit("a", below=-100.0).violation(-50.0) == pytest.approx(0.5)
    assert Limit("a", below=0.0).violation(3.0) == 3.0
    assert small.violation(99.0) == 0.0
