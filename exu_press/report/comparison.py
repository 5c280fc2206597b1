"""The report of a comparison: its variants side by side."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from exu_press.errors import InputError
from exu_press.files.output_directory import RUN_FILE, folder_name
from exu_press.plots import save_comparison
from exu_press.plots.words import ONE_LINE, describe
from exu_press.quantities.table import with_headings
from exu_press.report.html import page, paragraph, picture, stills, table, warnings
from exu_press.report.page_file import ALL, Span
from exu_press.report.run import live_part, provenance_section, scene_parts, warnings_of
from exu_press.report.study import reading
from exu_press.result import Result
from exu_press.schema.stored import from_json, short_text
from exu_press.studies.comparison import Comparison
from exu_press.studies.curve_comparison import MEASURED, MEASURED_PICTURE, comparison_rows
from fe_models.temporary import TemporaryFolder

__all__ = ["comparison_page", "comparison_report", "comparison_tables"]

CAPTIONS = {
    "compare_slider": "Slider motion of the variants against the ideal mechanism.",
    "compare_force": "Joint forces and drive torque of the variants.",
}


def comparison_report(file: Path, span: Span = ALL) -> str:
    """Return the page of a comparison, from comparison.json and the variants' run.nc beside it."""
    results = {label: Result.load(path) for label, path in _runs(file).items()}
    measured = _measured_section(file.parent)
    return comparison_page(results, f"{file.parent.name}/{file.name}", span, measured)


def comparison_page(
    results: Mapping[str, Result], source: str, span: Span = ALL, measured: str = ""
) -> str:
    """Return the page of runs by label.

    Args:
        source: where they are from, to be shown.
        span: begin and end of their curves, s; None: those of the records.
        measured: section on measured curves beside them.
    """
    summaries = {label: result.summary() for label, result in results.items()}
    differences, quantities = comparison_tables(Comparison(results))
    live = live_part(results, span)
    with TemporaryFolder() as folder:
        pictures = [
            picture(path, CAPTIONS.get(path.stem, path.stem))
            for path in save_comparison(results, folder)
        ]
    texts = [
        f"{label}: {warning}"
        for label, summary in summaries.items()
        for warning in warnings_of(summary)
    ]
    richest = max(results.values(), key=lambda result: len(str(result.scene.to_dict())))
    return page(
        f"Comparison: {describe([result.scene for result in results.values()], ONE_LINE)}",
        f"{', '.join(results)}; {source}",
        [
            ("Differences of the scenes", differences),
            ("In motion", live),
            ("Warnings", warnings(texts)),
            ("Results", quantities),
            *([("Measured", measured)] if measured else []),
            ("Pictures", stills("\n".join(pictures), live)),
            ("Provenance", provenance_section({n: s["provenance"] for n, s in summaries.items()})),
            *scene_parts(richest.scene),
        ],
    )


def comparison_tables(comparison: Comparison) -> tuple[str, str]:
    """Return the differences of the scenes, below what they have in common, and the quantities."""
    texts = (comparison.common_facts, comparison.common_window[1])
    common = "".join(paragraph(text) for text in texts if text)
    head = ("", *comparison.results)
    quantities = table(head, with_headings(comparison.cells()))
    rows = comparison.differences
    return common + (table(head, rows) if rows else ""), quantities


def _measured_section(directory: Path) -> str:
    """Return differences from measured curves as tables, and their picture; nothing without any."""
    file, drawn = directory / MEASURED, directory / f"{MEASURED_PICTURE}.png"
    if not file.is_file():
        return ""
    with reading(file, "differences from measured curves"):
        differences = from_json(dict[str, Any], file.read_bytes(), file.name)
        tables = [comparison_rows(name, runs) for name, runs in differences.items()]
    parts = [table(head, rows) for head, *rows in tables]
    if drawn.is_file():
        parts.append(picture(drawn, "Measured curves, and the runs over them."))
    return "\n".join(parts)


def _runs(file: Path) -> dict[str, Path]:
    """Return the variants' results, beside the file, by label."""
    with reading(file, "a comparison of exu_press"):
        labels = from_json(dict[str, Any], file.read_bytes(), "its text")
        if not labels:
            raise InputError("it is empty")
    names = {label: folder_name(label) for label in labels}
    for label, name in names.items():
        if Path(name).name != name or not name.isprintable():
            raise InputError(f"{file}: {short_text(label)}: allowed is the name of a variant")
    return {label: file.parent / name / RUN_FILE for label, name in names.items()}
