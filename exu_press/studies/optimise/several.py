"""Several objectives, or keys with values to choose from: optuna's samplers, and the front."""

from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from exu_press.errors import required_package
from exu_press.numerics.arrays import Array
from exu_press.studies.base import Key, Range, Values
from exu_press.studies.optimise.study import NSGA, TPE

__all__ = ["FEW", "Asked", "advised", "chosen", "front", "searched"]

Asked = Callable[[Sequence[Mapping[str, Any]]], tuple[Array, Array]]
"""From points to objectives (m, s), less is better, NaN without, and violations of limits (m,)."""

FEW = 1000
"""Trials up to which optuna's documentation advises the tree-structured Parzen estimator (table of
samplers: 100 to 1000 for TPE, 100 to 10000 for NSGA-II)."""

SIDE_BY_SIDE = 8
"""Points asked for at a time, whatever the number of workers: it decides what comes next."""

GENERATIONS = 15
"""About so many has NSGA-II."""


def advised(trials: int) -> str:
    """Return the sampler for a number of trials."""
    return TPE if trials <= FEW else NSGA


def searched(
    ask: Asked, keys: Mapping[str, Key], objectives: int, trials: int, method: str, seed: int
) -> None:
    """Search a front.

    Args:
        ask: evaluates points, and remembers them.
        keys: how they vary.
        objectives: number of them.
        trials: at most.
        method: TPE or NSGA.
        seed: of the random numbers.

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
        each = [study.ask() for _ in range(min(SIDE_BY_SIDE, trials - done))]
        values, violations = ask([_point(trial, keys) for trial in each])
        for trial, found, violation in zip(each, values, violations, strict=True):
            if np.isfinite(found).all():
                trial.set_constraint("limits", float(violation))
                study.tell(trial, found.tolist())
            else:
                study.tell(trial, state=optuna.trial.TrialState.FAIL)
        done += len(each)


def _point(trial: Any, keys: Mapping[str, Key]) -> dict[str, Any]:
    """Return the point that a trial proposes."""
    point: dict[str, Any] = {}
    for name, each in keys.items():
        if isinstance(each, Values):
            place = trial.suggest_categorical(name, list(range(len(each.values))))
            point[name] = each.values[place]
        else:
            assert isinstance(each, Range)
            point[name] = float(trial.suggest_float(name, each.low, each.high, log=each.log))
    return point


def front(values: Array, violations: Array) -> NDArray[np.intp]:
    """Return the places of points that no other one dominates, by their first objective.

    A point dominates another one if it is not worse in any objective and better in one.

    Args:
        values: (points, objectives), less is better; NaN of a point that has none.
        violations: (points,), of limits; points with any are left out.

    >>> front(np.array([[1.0, 3.0], [2.0, 2.0], [3.0, 3.0]]), np.zeros(3)).tolist()
    [0, 1]
    """
    fine = np.flatnonzero(np.isfinite(values).all(axis=1) & (violations <= 0.0))
    kept: list[int] = []
    seen: set[bytes] = set()
    for place in fine:
        one, others = values[place], values[fine]
        worse = (others <= one).all(axis=1) & (others < one).any(axis=1)
        if not worse.any() and one.tobytes() not in seen:
            kept.append(int(place))
            seen.add(one.tobytes())
    kept.sort(key=lambda place: float(values[place, 0]))
    return np.array(kept, dtype=np.intp)


def chosen(values: Array, weights: Sequence[float]) -> int:
    """Return the point of a front that is nearest to the best of each objective.

    Objectives are scaled to 0 to 1 over the front; a weight stretches its own.

    >>> chosen(np.array([[0.0, 1.0], [0.2, 0.2], [1.0, 0.0]]), [1.0, 1.0])
    1
    """
    span = np.ptp(values, axis=0)
    scaled = (values - values.min(axis=0)) / np.where(span > 0.0, span, 1.0)
    return int(np.argmin(np.linalg.norm(scaled * np.asarray(weights), axis=1)))
