"""Both readings of the damping in one table: peaks, their distances, and what each change does."""

from collections.abc import Sequence

from exu_press.columns import columns
from paper.readings import MODELS
from paper.report import Report
from paper.side_by_side import Peaks

__all__ = ["side_by_side_lines"]

HEADINGS = {"resolved": "resolved", "mean_1ms": "over 1 ms", "differentiated_1khz": "1 kHz"}

COARSER = "at 1e-2"
"""Over 1 ms, at the tolerance of what is varied."""


def side_by_side_lines(report: Report) -> list[str]:
    """Return the peaks of flexible and of rigid bodies, and their distances by setting."""
    dampings = list(report.findings)
    lines = [
        "Table 2's damping read twice, c_max in N s/m; peak accelerations in m/s²; distance: root",
        "mean square of the logarithms of ours over the paper's; at 1e-2: over 1 ms, with that",
        "tolerance instead of 1e-3: where it differs, the scene does not determine the peak.",
    ]
    for pair in zip(*(found.peaks for found in report.findings.values()), strict=True):
        lines += ["", *_peaks(dampings, pair)]
    return [*lines, "", *_settings(report)]


def _peaks(dampings: Sequence[str], pair: Sequence[Peaks]) -> list[str]:
    """Return the peaks of one kind of bodies."""
    first = pair[0]
    headings = [
        heading
        for damping in dampings
        for heading in (*(f"{damping}, {HEADINGS[model]}" for model in MODELS), COARSER)
    ]
    table = [(f"{first.bodies} bodies", "figure", "paper", *headings)]
    for index, number in enumerate(first.numbers):
        values = [
            _text(value[index], ".4g")
            for peaks in pair
            for value in (*(peaks.values[model] for model in MODELS), peaks.coarser)
        ]
        quantity = number.quantity.removeprefix("peak acceleration, ")
        table.append((quantity, number.figure, f"{number.published:g}", *values))
    last = [peaks.distances(peaks.values) for peaks in pair]
    whole = [peaks.distances(peaks.whole) for peaks in pair]
    for words, distances in (("distance", last), ("distance, from the start on", whole)):
        cells = [
            cell
            for one in distances
            for cell in (*(_text(one[model], ".2f") for model in MODELS), "")
        ]
        table.append((words, "", "", *cells))
    ratios = [(_text(peaks.sampling(), ".3g"), "", "", "") for peaks in pair]
    table.append(("largest ratio of resolved to over 1 ms", "", "", *sum(ratios, ())))
    return columns(table)


def _settings(report: Report) -> list[str]:
    """Return the distance of the rigid peaks, over 1 ms, with each change alone."""
    found = report.findings
    table = [("distance, rigid bodies, over 1 ms, with one change", *found)]
    for words in dict.fromkeys(words for one in found.values() for words in one.settings):
        values = [one.settings.get(words) for one in found.values()]
        table.append((words, *(_text(value, ".2f") for value in values)))
    return columns(table)


def _text(value: float | None, digits: str) -> str:
    return "-" if value is None else f"{value:{digits}}"
