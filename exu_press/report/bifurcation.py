"""The report of a bifurcation diagram: every point of the sections over the key, to zoom."""

from pathlib import Path
from typing import Any

from exu_press.page import Live
from exu_press.page.study import Column, study_viewer
from exu_press.report.html import table
from exu_press.report.study import reading, study_page
from exu_press.studies.bifurcation.lines import row_in_words
from exu_press.studies.sweep.units import unit_of, with_unit

__all__ = ["bifurcation_report"]


def bifurcation_report(file: Path) -> str:
    """Return the page of a bifurcation diagram, from bifurcation.json."""
    with reading(file, "a bifurcation of exu_press") as told:
        names = [str(told["key"]), *([told["second_key"]] if "second_key" in told else [])]
        rows = [(way, row) for way, branch in told["branches"].items() for row in branch]
        done = [(way, row) for way, row in rows if row["status"] == "completed"]
        live = _live(names, done) if done else None
        cells = [
            (*(f"{row[at]:g}" for at in ("value", "second") if at in row), way, *row_in_words(row))
            for way, row in rows
        ]
    head = (*map(with_unit, names), "way", "period", "exponent per revolution", "motion")
    return study_page(
        file,
        f"Bifurcation over {' and '.join(names)}",
        f"{len(rows)} runs, {len(rows) - len(done)} without a result",
        [("Points", live), ("Runs", table(head, cells))],
        "The diagram.",
    )


def _live(names: list[str], done: list[tuple[str, dict[str, Any]]]) -> Live | None:
    """Return every point of every section over the key."""
    each = [(way, row, point) for way, row in done for point in row["points"]]
    values = [
        Column(name, unit_of(name), [row[place] for _, row, _ in each])
        for name, place in zip(names, ("value", "second"), strict=False)
    ]
    ways = Column("way", "", [way for way, _, _ in each])
    periods = Column("period", "", [str(row["in_words"]) for _, row, _ in each])
    count = min(len(point) for _, _, point in each)
    sections = [
        Column(f"section, coordinate {k + 1}", "", [float(point[k]) for _, _, point in each])
        for k in range(count)
    ]
    exponents = Column("exponent per revolution", "", [row["exponent"][0] for _, row, _ in each])
    told = [f"{row['in_words']}, {row['motion']}, on the way {way}" for way, row, _ in each]
    first = (names[0], sections[0].name)
    return study_viewer([*values, ways, periods], [*sections, exponents], told, first, "way")
