"""A bifurcation diagram on the terminal."""

from exu_press.studies.bifurcation.report import Report
from exu_press.terminal.columns import columns

__all__ = ["report_lines"]

WORDS = 60
"""Most letters of a reason."""


def report_lines(report: Report) -> list[str]:
    """Return the table of the terminal."""
    names = [report.study.name, *([] if report.study.second is None else [report.study.second])]
    rows = [(*names, "way", "period", "exponent per revolution", "motion")]
    for branch in report.branches:
        other = [] if branch.second is None else [f"{branch.second:g}"]
        for value, row in branch:
            at = (f"{value:g}", *other, branch.name)
            if row["status"] != "completed":
                rows.append((*at, row["status"], row["reason"][:WORDS], ""))
                continue
            _, low, high = row["exponent"]
            told = f"below {high:.3g}" if low is None else f"{low:.3g} to {high:.3g}"
            rows.append((*at, row["in_words"], told, row["motion"]))
    return columns(rows)
