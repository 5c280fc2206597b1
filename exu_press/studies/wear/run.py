"""Wear a press over many strokes: clearances grow, their shapes follow, the runs are repeated."""

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
from exu_press.studies.wear.shape import Depths, begun, worn_scene
from exu_press.studies.wear.study import WearStudy

__all__ = ["WearCommand", "run_worn", "wear"]

LONGEST, SHORTEST = 4.0, 0.2
"""Times the last jump that the next one may be."""

CAUTION = 0.8
"""Jump over the one that just meets the tolerance."""

FIRST = 2.0
"""Tolerances that the first jump wears at most."""

TRIES = 8
"""Shorter and shorter jumps after one whose run failed."""


def wear(study: WearStudy, directory: str | Path, **how: Any) -> WearReport:
    """Run the study, going on where its directory was left; write wear.json and worn.toml.

    A jump takes the depths on by the midpoint rule: a run at the start of the jump tells what a
    stroke wears, half the jump is taken with it, and what a stroke wears there holds for the whole
    jump. Where the first run's wear would have held all along, the end would be another one: by so
    much a jump and its two halves differ. The difference, over the clearance, is kept below the
    tolerance; the next jump follows from it.

    Args:
        study: to be run.
        directory: of this study alone.
        how: workers, dask, quiet of `exu_press.studies.base.Runs`; a run needs the one before, so
            that more workers than one are idle.
    """
    points: list[Point] = []
    ended: list[str] = []
    if how.get("dask") is None:
        how["workers"] = how.get("workers") or 1
    with Runs(
        study, directory, report=WearReport, label="wear, at most", function=run_worn, **how
    ) as runs:
        runs.follow([_course(study, points, ended)], 2 * study.wear.most_jumps + 1)
    report = WearReport(study, points, "".join(ended))
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


def _course(study: WearStudy, points: list[Point], ended: list[str]) -> Chain:
    """Yield the arguments of one run after another, and add the points."""
    scene, own = study.scene, study.wear
    clearance = {name: float(scene.joints[name].clearance) for name in study.joints}
    depths = {name: begun(scene, name) for name in study.joints}

    def arguments(worn: Mapping[str, Depths]) -> dict[str, Any]:
        return arguments_of(worn_scene(scene, worn))

    def failed(row: Row) -> str:
        return f"run {row['status']}: {row['reason']}" if row["status"] != COMPLETED else ""

    row = yield arguments(depths)
    ways = dict.fromkeys(row.get("guideways", {}), 0.0)
    points.append(Point(0.0, 0.0, 0.0, depths, ways, row))
    if why := failed(row):
        ended.append(f"the first {why}")
        return
    rate = _rates(row, study)
    fastest = max(
        (depths[n].after(1.0, clearance[n], rate[n]).deepest - depths[n].deepest) / clearance[n]
        for n in study.joints
    )
    jump = FIRST * own.tolerance / fastest if fastest > 0.0 else math.inf
    done = error = 0.0
    tries = jumps = 0
    while done < own.strokes:
        if jumps == own.most_jumps:
            ended.append(f"{jumps} jumps were not enough (wear.most_jumps)")
            return
        jump = min(jump, own.strokes - done)
        half = {n: depths[n].after(0.5 * jump, clearance[n], rate[n]) for n in depths}
        row = yield arguments(half)
        if not (why := failed(row)):
            middle = _rates(row, study)
            after = {n: depths[n].after(jump, clearance[n], middle[n]) for n in depths}
            apart = {
                n: depths[n]
                .after(jump, clearance[n], rate[n])
                .differ(half[n].after(0.5 * jump, clearance[n], middle[n]))
                for n in depths
            }
            off = max(apart[n] / clearance[n] for n in apart) / own.tolerance
            longer = min(LONGEST, max(SHORTEST, CAUTION / math.sqrt(max(off, 1e-12))))
            if off > 1.0:
                jump *= longer
                continue
            worn_ways = {body: ways[body] + jump * row["guideways"][body] for body in ways}
            row = yield arguments(after)
            why = failed(row)
        if why and tries < TRIES:
            tries += 1
            jump *= SHORTEST
            continue
        if why:
            ended.append(f"after {done:.4g} strokes a {why}")
            return
        tries, jumps, done, depths, ways = 0, jumps + 1, done + jump, after, worn_ways
        error += max(apart.values())
        rate = _rates(row, study)
        points.append(Point(done, jump, error, depths, ways, row))
        jump *= longer


def _rates(row: Row, study: WearStudy) -> dict[str, Contacts]:
    """Return where every joint rubs in a stroke."""
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
