"""The report of a bifurcation diagram: every point of the sections over the key, to zoom."""

from pathlib import Path
from typing import Any

from exu_press.errors import InputError
from exu_press.page import Live, has_library
from exu_press.report.html import page, paragraph, picture, stills, table
from exu_press.schema.stored import from_json
from exu_press.studies.sweep.units import unit_of

__all__ = ["bifurcation_report"]


def bifurcation_report(file: Path) -> str:
    """Return the page of a bifurcation diagram, from bifurcation.json."""
    try:
        told = from_json(dict[str, Any], file.read_bytes(), file.name)
        names = [str(told["key"]), *([told["second_key"]] if "second_key" in told else [])]
        rows = [(way, row) for way, branch in told["branches"].items() for row in branch]
        done = [(way, row) for way, row in rows if row["status"] == "completed"]
        live = _live(names, done) if has_library() and done else None
        cells = [_cells(way, row) for way, row in rows]
    except OSError as error:
        raise InputError(f"{error.filename}: cannot be read ({error.strerror})") from None
    except (ValueError, KeyError, IndexError, TypeError, AttributeError) as error:
        raise InputError(f"{file}: not a bifurcation of exu_press ({error!s:.200})") from None
    pictures = [picture(path, "The diagram.") for path in sorted(file.parent.glob("*.png"))]
    head = (*map(_head, names), "way", "period", "exponent per revolution", "motion")
    return page(
        f"Bifurcation over {' and '.join(names)}",
        f"{len(rows)} runs, {len(rows) - len(done)} without a result; "
        f"{file.parent.name}/{file.name}",
        [
            *([] if live is None else [("Points", live.body)]),
            ("Runs", table(head, cells)),
            ("Pictures", stills("\n".join(pictures) or paragraph("None was drawn."), live)),
        ],
        live,
    )


def _head(key: str) -> str:
    return f"{key}, {unit_of(key)}" if unit_of(key) else key


def _cells(way: str, row: dict[str, Any]) -> list[str]:
    """Return a run as a line of the table."""
    at = [f"{row[place]:g}" for place in ("value", "second") if place in row]
    if row["status"] != "completed":
        return [*at, way, str(row["status"]), str(row["reason"]), ""]
    _, low, high = row["exponent"]
    exponent = f"below {high:.3g}" if low is None else f"{low:.3g} to {high:.3g}"
    return [*at, way, str(row["in_words"]), exponent, str(row["motion"])]


def _live(names: list[str], done: list[tuple[str, dict[str, Any]]]) -> Live:
    """Return every point of every section over the key."""
    from exu_press.page.study import Column, study_viewer

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
