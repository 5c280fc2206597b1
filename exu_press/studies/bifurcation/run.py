"""The long run over a key of the scene, up and down, or over two: periods, exponents."""

import math
from collections.abc import Sequence
from itertools import product
from pathlib import Path
from typing import Any

import numpy as np

from exu_press.errors import InputError
from exu_press.model.state import State
from exu_press.parallel import Chain
from exu_press.scene import Scene
from exu_press.studies.attractor import attractor
from exu_press.studies.attractor.orbit import require_orbit
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

    Arguments and errors are those of `exu_press.studies.base.Runs`, and InputError of a scene
    without an orbit, as `require_orbit` raises it.
    """
    values = study.values
    require_orbit(study.scene_at(study.point_at(values[0], study.seconds[0])))
    with Runs(study, directory, report=BifurcationReport, function=run_point, **how) as runs:
        ways = {"up": values, "down": values[::-1], FROM_THE_START: values}
        names = [name for name in ways if name in study.bifurcation.way]
        branches, chains = [], []
        for second, name in product(study.seconds, names):
            rows: list[Row] = [{} for _ in values]
            branches.append(Branch(name, ways[name], rows, second))
            numbers = range(len(values))
            for chain in [(n,) for n in numbers] if name == FROM_THE_START else [numbers]:
                chains.append(_follow_values(study, branches[-1], rows, chain))
        runs.follow(chains, len(branches) * len(values))
    report = BifurcationReport(study, branches)
    report.save(Path(directory))
    return report


def _follow_values(
    study: Bifurcation, branch: Branch, rows: list[Row], numbers: Sequence[int]
) -> Chain:
    """Yield the arguments of some of a branch's runs, each after the one before, and keep rows."""
    last = None
    for n in numbers:
        rows[n] = yield _arguments(study, branch.values[n], branch.second, last)
        last = branch.values[n], rows[n]


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
