"""The table as a person reads it in a terminal."""

import textwrap
from collections.abc import Iterable, Sequence

from exu_press.columns import columns
from paper.comparison import DATUM
from paper.readings import MODELS, OBSERVED
from paper.report import Findings, Report
from paper.rows import AGREES_WITHIN, Row
from paper.side_by_side_table import side_by_side_lines

__all__ = ["report_lines"]

WIDTH = 100
NUMBERS = ("figure", "paper", "resolved", "over 1 ms", "1 kHz", "ratio", "verdict")
TRENDS = ("figure", "paper", "ours", "", "verdict")
SECTIONS = {
    "numbers": (("number", "reference", "choice"), NUMBERS),
    "trends": (("trend",), TRENDS),
}
UNITS = {
    "bottom_dead_centre": ("mm", 1e3, ".3f"),
    "peak_acceleration": ("m/s²", 1.0, ".4g"),
    "peak_velocity": ("m/s", 1.0, ".3f"),
    "clearance": ("mm", 1e3, ".2g"),
}
TREND_UNITS = {
    "bottom_dead_centre": ("µm", 1e6, ".1f"),
    "peak_velocity": ("m/s", 1.0, ".4f"),
    "oscillation_frequency": ("Hz", 1.0, ".3g"),
    "permanent_contact_ball": ("%", 1e2, ".0f"),
    "permanent_contact_pin": ("%", 1e2, ".0f"),
}


def report_lines(report: Report) -> list[str]:
    """Return both readings side by side, then the table of each, its counts and its differences."""
    lines = [
        "Judged for all rows alike: mean over 1 ms, last revolution; "
        f"agrees: within {100 * AGREES_WITHIN:.0f} %.",
        "Ratios of bottom dead centres: of how far they lie below the ideal one.",
    ]
    if report.quick:
        lines.append(
            "REDUCED FORM, rigid bodies and a tenth of a revolution: says nothing of the paper."
        )
    lines += ["", *side_by_side_lines(report)]
    lines += ["", *_section("natural frequencies, Hz", report.frequencies, NUMBERS)]
    for damping, found in report.findings.items():
        lines += ["", f"TABLE 2'S DAMPING READ AS {damping} N s/m"]
        for title, (kinds, headings) in SECTIONS.items():
            some = [row for row in found.rows if row.kind in kinds]
            lines += ["", *_section(title, some, headings)]
        lines += ["", _counts(found.rows), _ended(found)]
    for damping, found in report.findings.items():
        lines += ["", f"Why, with {damping} N s/m:", *_differences(found.rows)]
    return lines


def _section(title: str, rows: Sequence[Row], headings: Sequence[str]) -> list[str]:
    if not rows:
        return []
    cells = [_trend(row) if headings is TRENDS else _number(row) for row in rows]
    return columns([(title, *headings), *cells])


def _number(row: Row) -> tuple[str, ...]:
    unit, scale, digits = UNITS.get(row.measure, ("", 1.0, ".5g"))
    values = [_text(getattr(row, model), scale, digits) for model in MODELS]
    ratio = "-" if row.ratio is None else f"{row.ratio:.3g}"
    quantity = f"{row.quantity}, {unit}" if unit else row.quantity
    published = _text(row.published, scale, digits)
    return (quantity, row.figure, published, *values, ratio, row.verdict)


def _trend(row: Row) -> tuple[str, ...]:
    unit, scale, digits = TREND_UNITS.get(row.measure, UNITS.get(row.measure, ("", 1.0, ".4g")))
    series = getattr(row, OBSERVED)
    assert isinstance(series, tuple)
    if row.measure == "bottom_dead_centre":
        series = tuple(None if value is None else DATUM - value for value in series)
    values = ", ".join(_text(value, scale, digits) for value in series)
    return (row.quantity, row.figure, str(row.published), values, unit, row.verdict)


def _text(value: object, scale: float, digits: str) -> str:
    return f"{scale * value:{digits}}" if isinstance(value, float) else "-"


def _ended(found: Findings) -> str:
    """Return how the runs ended, and how far their energy balances."""
    completed = len(found.runs) - len(found.stopped)
    return (
        f"{completed} of {len(found.runs)} runs completed; largest energy residual "
        f"{found.residual:.1e}"
    )


def _counts(rows: Iterable[Row]) -> str:
    counts: dict[str, int] = {}
    for row in rows:
        counts[row.verdict] = counts.get(row.verdict, 0) + 1
    return ", ".join(f"{count} {verdict}" for verdict, count in counts.items())


def _differences(rows: Iterable[Row]) -> list[str]:
    """Return what is known of every row that differs or has no run."""
    lines = []
    for row in rows:
        if row.verdict in ("differs", "no run"):
            lines.append(f"{row.quantity} ({row.figure}) {row.verdict}:")
            lines += textwrap.wrap(row.reason, WIDTH, initial_indent="  ", subsequent_indent="  ")
    return lines
