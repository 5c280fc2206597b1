"""The page of a study, made of the report that it wrote; no code of the study is needed."""

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from exu_press.errors import InputError
from exu_press.files.file_format import NewerFormatError, refuse_newer_format
from exu_press.page import Live
from exu_press.page.lines import lines_viewer
from exu_press.page.study import study_viewer
from exu_press.report.html import page, paragraph, picture, stills, table, warnings
from exu_press.report.run import provenance_section, scene_parts
from exu_press.scene import Scene
from exu_press.schema.stored import from_json
from exu_press.studies.base.report import FORMAT, Column, Line, Panel, Points, Table

__all__ = ["reading", "study_page"]

WRONG = (ValueError, KeyError, IndexError, TypeError, AttributeError)


@contextmanager
def reading(file: Path, kind: str) -> Iterator[Any]:
    """Yield the JSON of a file; its faults, and those of what is made of it, are InputErrors."""
    try:
        stored = from_json(dict[str, Any], file.read_bytes(), file.name)
        refuse_newer_format(str(stored.pop("format", "")), FORMAT)
        yield stored
    except NewerFormatError as error:
        raise InputError(f"{file}: {error}") from None
    except OSError as error:
        raise InputError(f"{error.filename}: cannot be read ({error.strerror})") from None
    except WRONG as error:
        why = f"{file}: not {kind} ({error!s:.200})"
        raise InputError(f"{why}; the command that wrote it writes it anew") from None


def study_page(file: Path) -> str:
    """Return the page of a study, from its report and the pictures beside it."""
    with reading(file, "a report of exu_press") as report:
        return _page(file, report)


def _page(file: Path, report: dict[str, Any]) -> str:
    live = _live(report)
    title = "Curves" if report["points"] is None else str(report["points"]["title"])
    tables = [(entry["title"], _table(Table(**entry))) for entry in report["tables"]]
    pictures = [
        picture(path, caption)
        for name, caption in report["pictures"].items()
        if (path := _picture_file(file, name)).is_file()
    ]
    drawn = "\n".join(pictures) or paragraph("None was drawn.")
    scene = report["scene"]
    about = [] if scene is None else scene_parts(Scene.from_result(scene, ()))
    return page(
        report["title"],
        "; ".join(filter(None, [report["subtitle"], f"{file.parent.name}/{file.name}"])),
        [
            *([(title, live)] if live else []),
            *tables,
            ("Warnings", warnings(report["warnings"])),
            ("Pictures", stills(drawn, live)),
            ("Provenance", provenance_section({"": report.get("provenance")})),
            *about,
        ],
    )


def _picture_file(file: Path, name: str) -> Path:
    """Return the file of a picture, which lies beside the report."""
    if Path(name).name != name or not name.isprintable():
        raise ValueError(f"{name!r} is no name of a picture")
    return file.with_name(f"{name}.png")


def _table(entry: Table) -> str:
    """Return a table with the lines above and below it; runs have their numbers."""
    head, rows = list(entry.head), [list(row) for row in entry.rows]
    if entry.of_points:
        head, rows = ["run", *head], [[str(k), *row] for k, row in enumerate(rows)]
    inner = table(head, rows, name="runs" if entry.of_points else "") if head else ""
    parts = [*map(paragraph, entry.above), inner, *map(paragraph, entry.below)]
    return "\n".join(filter(None, parts))


def _live(report: dict[str, Any]) -> Live | None:
    """Return the points or the curves of a report; nothing without the extra `page`."""
    if report["points"] is not None:
        entries = dict(report["points"])
        for name in ("keys", "quantities"):
            entries[name] = [Column(**column) for column in entries[name]]
        return study_viewer(Points(**entries))
    panels = [
        Panel(**{**panel, "lines": [Line(**line) for line in panel["lines"]]})
        for panel in report["panels"]
    ]
    return lines_viewer(panels)
