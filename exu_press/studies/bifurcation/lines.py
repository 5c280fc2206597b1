"""A bifurcation diagram on the terminal."""

from exu_press.studies.base import Row
from exu_press.studies.bifurcation.report import Report
from exu_press.terminal.columns import columns

__all__ = ["report_lines", "row_in_words"]

WORDS = 60
"""Most letters of a reason."""


def report_lines(report: Report) -> list[str]:
    """Return the table of the terminal."""
    names = [report.study.name, *([] if report.study.second is None else [report.study.second])]
    rows = [(*names, "way", "period", "exponent per revolution", "motion")]
    for branch in report.branches:
        other = [] if branch.second is None else [f"{branch.second:g}"]
        for value, row in branch:
            told = (text[:WORDS] for text in row_in_words(row))
            rows.append((f"{value:g}", *other, branch.name, *told))
    return columns(rows)


def row_in_words(row: Row) -> tuple[str, str, str]:
    """Return period, exponent and motion of a point, or why it has none."""
    if row["status"] != "completed":
        return str(row["status"]), str(row["reason"]), ""
    _, low, high = row["exponent"]
    exponent = f"below {high:.3g}" if low is None else f"{low:.3g} to {high:.3g}"
    return str(row["in_words"]), exponent, str(row["motion"])
