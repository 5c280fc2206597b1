"""The report of a wear study: every jump in a table, and the course to zoom."""

from pathlib import Path
from typing import Any

from exu_press.page import Live
from exu_press.page.study import Column, study_viewer
from exu_press.quantities.uncertain import significant
from exu_press.report.html import table
from exu_press.report.study import reading, scaled, study_page
from exu_press.studies.sweep.units import shown_unit, with_unit

__all__ = ["wear_report"]


def wear_report(file: Path) -> str:
    """Return the page of a wear study, from wear.json."""
    with reading(file, "a wear study of exu_press") as told:
        strokes = [float(each) for each in told["strokes"]]
        curves = _curves(told)
        rows = [
            [f"{n:.6g}", f"{jump:.4g}", *(_cell(values[i]) for _, _, values in curves)]
            for i, (n, jump) in enumerate(zip(strokes, told["jump"], strict=True))
        ]
        live = _live(strokes, curves) if len(strokes) > 1 else None
        ended = f"; {told['reason']}" if told["reason"] else ""
    head = ("strokes", "jump", *(with_unit(name, unit) for name, unit, _ in curves))
    return study_page(
        file,
        f"Wear over {significant(strokes[-1], 4)} strokes",
        f"jumps: {len(strokes) - 1}{ended}",
        [("Course", live), ("Jumps", table(head, rows))],
        "The course.",
    )


def _curves(told: dict[str, Any]) -> list[tuple[str, str, list[float | None]]]:
    """Return name, unit and values of all that is told over the strokes."""
    found = [
        (f"{name}, largest clearance", "um", scaled(joint["clearance"], 1e6))
        for name, joint in told["joints"].items()
    ]
    found += [
        (f"guideways of {body}, depth", "um", scaled(depths, 1e6))
        for body, depths in told["guides"].items()
    ]
    for name, values in told["quantities"].items():
        unit, scale = shown_unit(name, filter(None, values))
        found.append((name, unit, scaled(values, scale)))
    return found


def _cell(value: float | None) -> str:
    return "" if value is None else f"{value:.6g}"


def _live(strokes: list[float], curves: list[tuple[str, str, list[float | None]]]) -> Live | None:
    columns = [Column(name, unit, values) for name, unit, values in curves]
    told = [f"after {n:.6g} strokes" for n in strokes]
    kind = Column("study", "", ["wear"] * len(strokes))
    first = ("strokes", columns[0].name)
    return study_viewer([Column("strokes", "", strokes), kind], columns, told, first, "study")
