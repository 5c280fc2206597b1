"""Wear a press over many strokes: clearances grow, their shapes follow, runs are repeated."""

import math
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from exu_press.laws.wear import Contacts
from exu_press.parallel import Chain
from exu_press.parallel.task import COMPLETED
from exu_press.studies.base import Row, Runs, arguments_of, row_of, scene_from
from exu_press.studies.base.command import StudyCommand
from exu_press.studies.wear.report import Point, WearReport
from exu_press.studies.wear.shape import Depths, initial_depths, worn_scene
from exu_press.studies.wear.study import WearStudy

__all__ = ["WearCommand", "run_worn", "wear"]

LONGEST, SHORTEST = 4.0, 0.2
"""Largest and smallest ratio of a jump to the previous one."""

CAUTION = 0.8
"""Safety factor of a jump's length."""

FIRST = 2.0
"""Largest wear of the first jump, in tolerances."""

TRIES = 8
"""Most shortened jumps after a failed run."""


def wear(study: WearStudy, directory: str | Path, **how: Any) -> WearReport:
    """Run the study, from the state of its directory on; write wear.json and worn.toml.

    A jump extrapolates the depths by the midpoint rule: with the wear per stroke of a run at its
    start to its middle, and with that of a run there over the whole jump. Its error is the
    difference from the jump with the first run's wear in the first half. This error over the
    clearance is kept below the tolerance, and decides the length of the next jump.

    Arguments and errors are those of `exu_press.studies.base.Runs`; a run needs the previous one,
    so that further workers are idle.
    """
    points: list[Point] = []
    reasons: list[str] = []
    if how.get("dask") is None:
        how["workers"] = how.get("workers") or 1
    with Runs(
        study, directory, report=WearReport, label="wear, at most", function=run_worn, **how
    ) as runs:
        runs.follow([_course(study, points, reasons)], 2 * study.wear.most_jumps + 1)
    report = WearReport(study, points, "".join(reasons))
    report.save(Path(directory))
    return report


def run_worn(arguments: dict[str, Any]) -> dict[str, Any]:
    """Run {"scene": ...}; return its row, and the wear of every joint and guideway in a stroke, m.

    Returns:
        as `row_of`, and what `wear_of_a_revolution` returns.
    """
    from exu_press.quantities.wear import wear_of_a_revolution
    from exu_press.verification.simulate import simulate

    result = simulate(scene_from(arguments))
    row = row_of(result)
    return row | (wear_of_a_revolution(result) if row["status"] == COMPLETED else {})


def _course(study: WearStudy, points: list[Point], reasons: list[str]) -> Chain:
    """Yield the arguments of one run after another, and add the points."""
    scene, own = study.scene, study.wear
    clearance = {name: float(scene.joints[name].clearance) for name in study.joints}
    depths = {name: initial_depths(scene, name) for name in study.joints}

    def arguments(by_joint: Mapping[str, Depths]) -> dict[str, Any]:
        return arguments_of(worn_scene(scene, by_joint))

    def failure(row: Row) -> str:
        return f"run {row['status']}: {row['reason']}" if row["status"] != COMPLETED else ""

    row = yield arguments(depths)
    ways = dict.fromkeys(row.get("guideways", {}), 0.0)
    points.append(Point(0.0, 0.0, 0.0, depths, ways, row))
    if why := failure(row):
        reasons.append(f"the first {why}")
        return
    rate = _rates(row, study)
    fastest = max(
        (depths[n].add_strokes(1.0, clearance[n], rate[n]).deepest - depths[n].deepest)
        / clearance[n]
        for n in study.joints
    )
    jump = FIRST * own.tolerance / fastest if fastest > 0.0 else math.inf
    done = error = 0.0
    tries = jumps = 0
    while done < own.strokes:
        if jumps == own.most_jumps:
            reasons.append(f"{jumps} jumps were not enough (wear.most_jumps)")
            return
        jump = min(jump, own.strokes - done)
        half = {n: depths[n].add_strokes(0.5 * jump, clearance[n], rate[n]) for n in depths}
        row = yield arguments(half)
        if not (why := failure(row)):
            middle = _rates(row, study)
            worn = {n: depths[n].add_strokes(jump, clearance[n], middle[n]) for n in depths}
            errors = {
                n: depths[n]
                .add_strokes(jump, clearance[n], rate[n])
                .difference(half[n].add_strokes(0.5 * jump, clearance[n], middle[n]))
                for n in depths
            }
            ratio = max(errors[n] / clearance[n] for n in errors) / own.tolerance
            factor = min(LONGEST, max(SHORTEST, CAUTION / math.sqrt(max(ratio, 1e-12))))
            if ratio > 1.0:
                jump *= factor
                continue
            worn_ways = {body: ways[body] + jump * row["guideways"][body] for body in ways}
            row = yield arguments(worn)
            why = failure(row)
        if why and tries < TRIES:
            tries += 1
            jump *= SHORTEST
            continue
        if why:
            reasons.append(f"after {done:.4g} strokes a {why}")
            return
        tries, jumps, done, depths, ways = 0, jumps + 1, done + jump, worn, worn_ways
        error += max(errors.values())
        rate = _rates(row, study)
        points.append(Point(done, jump, error, depths, ways, row))
        jump *= factor


def _rates(row: Row, study: WearStudy) -> dict[str, Contacts]:
    rates = {}
    for joint in study.joints:
        stored = dict(row["contacts"][joint])
        area = float(stored.pop("area"))
        rates[joint] = Contacts(**{n: np.array(v) for n, v in stored.items()}, area=area)
    return rates


class WearCommand(StudyCommand):
    """`exu-press wear`."""

    example = "exu-press wear million.toml --out out/million"
    study = WearStudy
    run = staticmethod(wear)
