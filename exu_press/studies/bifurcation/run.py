"""The long run over a key of the scene, up and down, or over two: periods, exponents."""

import math
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from exu_press.errors import InputError
from exu_press.model.state import State
from exu_press.parallel import Chain
from exu_press.scene import Scene
from exu_press.studies.attractor import attractor
from exu_press.studies.base import Row, Runs, arguments_of, scene_from
from exu_press.studies.base.command import StudyCommand
from exu_press.studies.bifurcation.report import BifurcationReport, Branch
from exu_press.studies.bifurcation.study import FROM_THE_START, Bifurcation

__all__ = ["BifurcationCommand", "bifurcation", "rescale_state", "run_point"]


def bifurcation(study: Bifurcation, directory: str | Path, **how: Any) -> BifurcationReport:
    """Do the runs that are missing, write bifurcation.json, and return the report.

    On the ways up and down each run starts in the state at the end of the previous one, so that
    hysteresis shows. Both ways, and the values of a second key, run side by side. After a run that
    failed, the next one starts as the scene does.

    Args:
        study: to be run.
        directory: of this study alone.
        how: workers, dask, quiet of `exu_press.studies.base.Runs`.
    """
    values = study.values
    with Runs(study, directory, report=BifurcationReport, function=run_point, **how) as runs:
        if study.bifurcation.way == FROM_THE_START:
            points = [(value, second) for second in study.seconds for value in values]
            rows = iter(runs.rows([_arguments(study, *point, None) for point in points]))
            branches = [
                Branch(FROM_THE_START, values, [next(rows) for _ in values], second)
                for second in study.seconds
            ]
        else:
            ways = {"up": values, "down": values[::-1]}
            names = [name for name in ways if name in study.bifurcation.way]
            chain_rows: list[list[Row]] = []
            branches, chains = [], []
            for second in study.seconds:
                for name in names:
                    chain_rows.append([])
                    branches.append(Branch(name, ways[name], chain_rows[-1], second))
                    chains.append(_follow_values(study, ways[name], second, chain_rows[-1]))
            runs.follow(chains, len(chains) * len(values))
    report = BifurcationReport(study, branches)
    report.save(Path(directory))
    return report


def _follow_values(
    study: Bifurcation, values: Sequence[float], second: float | None, rows: list[Row]
) -> Chain:
    """Yield the arguments of one run after another, and add their rows to `rows`."""
    last = None
    for value in values:
        row = yield _arguments(study, value, second, last)
        rows.append(row)
        last = value, row


def _arguments(
    study: Bifurcation, value: float, second: float | None, last: tuple[float, Row] | None
) -> dict[str, Any]:
    """Return the arguments of `run_point`; `last` is the previous value and its row."""
    scene: Scene = study.scene_at(study.point_at(value, second))
    settings = study.bifurcation
    arguments: dict[str, Any] = {
        **arguments_of(scene),
        "skip": settings.skip,
        "revolutions": settings.revolutions,
        "longest": settings.longest,
        "start": None,
    }
    if last is not None and "state" in last[1]:
        arguments["start"] = last[1]["state"]
        arguments["speed"] = study.scene_at(study.point_at(last[0], second)).speed_rpm
    return arguments


def rescale_state(state: State, old_speed: float, new_speed: float) -> State:
    """Return a state on the section rescaled to another speed of the crank.

    Time, velocities and accelerations are rescaled with it, so that they satisfy the constraints.

    Args:
        state: on the section.
        old_speed: speed at which it was found, in any unit.
        new_speed: likewise.
    """
    ratio = new_speed / old_speed
    q, q_t, *further = state["coordinates"]
    return {
        **state,
        "time": state["time"] / ratio,
        "step": state["step"] / ratio,
        "coordinates": [q, (ratio * np.array(q_t)).tolist(), *further],
        "accelerations": (ratio**2 * np.array(state["accelerations"])).tolist(),
    }


def run_point(arguments: dict[str, Any]) -> dict[str, Any]:
    """Return the motion in the long run at one value of the key.

    Args:
        arguments: "scene", "skip", "revolutions", "longest", and "start": a state on the section,
            and "speed", the one at which it was found; or None.

    Returns:
        status, reason, points (n, k), period (None where there is none), decided, in_words, error,
        exponent: [value, low or None, high] per revolution, motion, state.
    """
    scene, start = scene_from(arguments), arguments["start"]
    if start is not None:
        start = rescale_state(start, arguments["speed"], scene.speed_rpm)
    motion = attractor(
        scene,
        revolutions=arguments["revolutions"],
        skip=arguments["skip"],
        most=arguments["longest"],
        start=start,
    )
    if motion.stopped:
        raise InputError(motion.stopped)
    low = motion.exponent.low
    return {
        "status": "completed",
        "reason": "",
        "points": motion.points.tolist(),
        "period": motion.period.revolutions,
        "decided": motion.period.is_decided,
        "in_words": str(motion.period),
        "finer": motion.period.finer,
        "error": motion.error,
        "exponent": [
            motion.exponent.value,
            low if math.isfinite(low) else None,
            motion.exponent.high,
        ],
        "motion": motion.exponent.sign,
        "state": motion.state,
    }


class BifurcationCommand(StudyCommand):
    """`exu-press bifurcation`."""

    example = "exu-press bifurcation clearance.toml --out out/clearance"
    study = Bifurcation
    run = staticmethod(bifurcation)
