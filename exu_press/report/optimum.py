"""The report of an optimum: all trials as points, those of the front with their scenes."""

from pathlib import Path
from typing import Any

from exu_press.page import Live
from exu_press.page.study import Column, study_viewer
from exu_press.plots.words import ONE_LINE, describe
from exu_press.report.html import table
from exu_press.report.study import reading, shown_column, study_page
from exu_press.scene import Scene
from exu_press.scene.file import scene_tables
from exu_press.schema.csv_table import read_csv
from exu_press.studies.optimise.lines import beyond_end
from exu_press.studies.sweep.units import shown_unit, with_unit

__all__ = ["optimum_report"]

FRONT = "front"


def optimum_report(file: Path) -> str:
    """Return the page of an optimum, from optimise.json, trials.csv and the scenes beside it."""
    with reading(file, "an optimum of exu_press") as told:
        columns = read_csv(file.parent / "trials.csv")
        head = list(columns)
        trials = [dict(zip(head, row, strict=True)) for row in zip(*columns.values(), strict=True)]
        front = [one["keys"] for one in told["front"]]
        chosen, at_ends = int(told["chosen"]), list(map(str, told["at_ends"]))
        keys = list(front[chosen])
        places = [_place(front, trial, keys) for trial in trials]
    # complete: nothing is asked
    scene = Scene.from_dict(scene_tables(file.parent / "chosen.toml"), resolve=False)
    live = _live(head, trials, keys, places)
    units = {name: shown_unit(name, [t[name] for t in trials if t[name]]) for name in head[:-1]}
    rows = [
        [str(run), *(_shown(trial[name], k) for name, (_, k) in units.items()), of_front]
        for run, (trial, place) in enumerate(zip(trials, places, strict=True))
        for of_front in [_of_front(place, chosen)]
    ]
    names = (with_unit(name, unit) for name, (unit, _) in units.items())
    return study_page(
        file,
        f"Optimum: {describe([scene], ONE_LINE)}",
        "; ".join([f"{len(trials)} trials, {len(front)} on the front", *map(beyond_end, at_ends)]),
        [("Points", live), ("Trials", table(("run", *names, "front"), rows, name="runs"))],
        "The front: all trials, and those that no other one beats.",
        scene=scene,
        drawn="front.png",
    )


def _live(
    head: list[str], trials: list[dict[str, Any]], keys: list[str], places: list[int | None]
) -> Live | None:
    """Return the trials as points; one of the front opens with its scene."""

    def column(name: str) -> Column:
        return shown_column(name, [trial[name] for trial in trials])

    found = [name for name in head[:-1] if name not in keys]
    on_front = ["trial" if place is None else "front" for place in places]
    opens = [
        "a trial that others beat" if place is None else f"exu-press run front/{place + 1:02}.toml"
        for place in places
    ]
    across = (found[0], found[1]) if len(found) > 1 else (keys[0], found[0])
    columns = [Column(FRONT, "", on_front), *(column(name) for name in keys)]
    return study_viewer(columns, [column(name) for name in found], opens, across, colour=FRONT)


def _place(front: list[dict[str, Any]], trial: dict[str, Any], keys: list[str]) -> int | None:
    """Return a trial's place in the front, None of one that is beaten."""
    if not trial[FRONT]:
        return None
    return next(n for n, one in enumerate(front) if all(one[k] == trial[k] for k in keys))


def _of_front(place: int | None, chosen: int) -> str:
    if place is None:
        return ""
    return f"{place + 1:02}.toml" + (", chosen" if place == chosen else "")


def _shown(value: Any, scale: float) -> str:
    if isinstance(value, float):
        return f"{scale * value:.6g}"
    return "" if value is None else str(value)
