"""Optimisation of several objectives, or of keys with discrete values: samplers and the front."""

from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from exu_press.errors import required_package
from exu_press.numerics.arrays import Array
from exu_press.studies.base import Key, Range, Values
from exu_press.studies.optimise.study import NSGA, TPE

__all__ = ["FEW", "Ask", "advise_sampler", "choose_compromise", "front", "search_front"]

Ask = Callable[[Sequence[Mapping[str, Any]]], tuple[Array, Array]]
"""From points to objectives (m, s), less is better, NaN without, and violations of limits (m,)."""

FEW = 1000
"""Trials up to which optuna's documentation advises the tree-structured Parzen estimator (table of
samplers: 100 to 1000 for TPE, 100 to 10000 for NSGA-II)."""

SIDE_BY_SIDE = 8
"""Points evaluated together, whatever the number of workers, as the next ones depend on it."""

GENERATIONS = 15
"""Approximate number of generations of NSGA-II."""


def advise_sampler(trials: int) -> str:
    """Return the sampler for a number of trials."""
    return TPE if trials <= FEW else NSGA


def search_front(
    ask: Ask, keys: Mapping[str, Key], objectives: int, trials: int, method: str, seed: int
) -> None:
    """Search a front.

    Args:
        ask: evaluates points, and stores them.
        trials: at most.
        method: TPE or NSGA.

    Raises:
        InputError: optuna is not installed.
    """
    use = "several objectives, or keys with [value, ...]"
    optuna = required_package("optuna", use, "'exu-press[optimise]'")
    optuna.logging.set_verbosity(optuna.logging.WARNING)

    sampler: Any
    if method == NSGA:
        population = max(SIDE_BY_SIDE, trials // GENERATIONS // SIDE_BY_SIDE * SIDE_BY_SIDE)
        sampler = optuna.samplers.NSGAIISampler(population_size=population, seed=seed)
    else:
        sampler = optuna.samplers.TPESampler(
            n_startup_trials=max(SIDE_BY_SIDE, trials // 5),
            multivariate=True,
            constant_liar=True,
            seed=seed,
        )
    study = optuna.create_study(directions=["minimize"] * objectives, sampler=sampler)
    done = 0
    while done < trials:
        batch = [study.ask() for _ in range(min(SIDE_BY_SIDE, trials - done))]
        values, violations = ask([_point(trial, keys) for trial in batch])
        for trial, objective, violation in zip(batch, values, violations, strict=True):
            if np.isfinite(objective).all():
                trial.set_constraint("limits", float(violation))
                study.tell(trial, objective.tolist())
            else:
                study.tell(trial, state=optuna.trial.TrialState.FAIL)
        done += len(batch)


def _point(trial: Any, keys: Mapping[str, Key]) -> dict[str, Any]:
    point: dict[str, Any] = {}
    for name, key in keys.items():
        if isinstance(key, Values):
            number = trial.suggest_categorical(name, list(range(len(key.values))))
            point[name] = key.values[number]
        else:
            assert isinstance(key, Range)
            point[name] = float(trial.suggest_float(name, key.low, key.high, log=key.log))
    return point


def front(values: Array, violations: Array) -> NDArray[np.intp]:
    """Return the numbers of points that no point dominates, by their first objective.

    A point dominates another if it is not worse in any objective and better in one.

    Args:
        values: (points, objectives), less is better; NaN of a point without values.
        violations: of limits, (points,); points with any are excluded.

    >>> front(np.array([[1.0, 3.0], [2.0, 2.0], [3.0, 3.0]]), np.zeros(3)).tolist()
    [0, 1]
    """
    valid = np.flatnonzero(np.isfinite(values).all(axis=1) & (violations <= 0.0))
    numbers: list[int] = []
    known: set[bytes] = set()
    for number in valid:
        point, points = values[number], values[valid]
        dominates = (points <= point).all(axis=1) & (points < point).any(axis=1)
        if not dominates.any() and point.tobytes() not in known:
            numbers.append(int(number))
            known.add(point.tobytes())
    numbers.sort(key=lambda number: float(values[number, 0]))
    return np.array(numbers, dtype=np.intp)


def choose_compromise(values: Array, weights: Sequence[float]) -> int:
    """Return the number of the point of a front nearest to the best of each objective.

    Objectives are scaled to 0 to 1 over the front, and multiplied by their weights.

    >>> choose_compromise(np.array([[0.0, 1.0], [0.2, 0.2], [1.0, 0.0]]), [1.0, 1.0])
    1
    """
    span = np.ptp(values, axis=0)
    scaled = (values - values.min(axis=0)) / np.where(span > 0.0, span, 1.0)
    return int(np.argmin(np.linalg.norm(scaled * np.asarray(weights), axis=1)))
