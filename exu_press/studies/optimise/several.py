"""Several objectives, or keys with values to choose from: optuna's samplers."""

from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np

from exu_press.errors import InputError
from exu_press.numerics.arrays import Array
from exu_press.studies.base import Key, Range, Values
from exu_press.studies.optimise.study import NSGA, TPE

__all__ = ["FEW", "Asked", "advised", "searched"]

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
    try:
        import optuna
    except ModuleNotFoundError:
        raise InputError(
            "several objectives, or keys with [value, ...], need optuna; the cure is: "
            "pip install 'exu-press[optimise]'"
        ) from None
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
