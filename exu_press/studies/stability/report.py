"""What came out of the study, as it is written and as a user reads it."""

from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from exu_press.studies.stability.judge import RIGHT, STOPPED, WRONG

__all__ = ["Report"]

TOO_COARSE = 0.1
"""Tolerance that is plainly too coarse for impacts, as is any fixed step that leaps over them."""


@dataclass(frozen=True)
class Report:
    """Rows of all cases that were run.

    Attributes:
        quick: whether it is the fixed sample.
        rows: one a case: name, axis, value, parameters (the scene), verdict, reason, checks,
            residual, status, steps, wall_time (s).
    """

    quick: bool
    rows: tuple[Mapping[str, Any], ...]

    def counts(self) -> dict[str, int]:
        """Return how many cases have each verdict."""
        found = Counter(row["verdict"] for row in self.rows)
        return {verdict: found[verdict] for verdict in (RIGHT, STOPPED, WRONG)}

    def too_coarse(self) -> int:
        """Return how many cases stopped because their own setting is plainly too coarse."""
        solvers = (
            row["parameters"]["solver"]
            for row in self.rows
            if row["verdict"] == STOPPED and row["status"] == "under-resolved"
        )
        return sum("step" in each or each["tolerance"] >= TOO_COARSE for each in solvers)

    def to_dict(self) -> dict[str, Any]:
        """Return the dictionary of stability.json."""
        return {
            "quick": self.quick,
            "counts": self.counts(),
            "stopped_too_coarse": self.too_coarse(),
            "cases": [dict(row) for row in self.rows],
        }

    def lines(self) -> list[str]:
        """Return a table, a line an axis, then every case that is not right, then the counts."""
        counts = self.counts()
        axes = dict.fromkeys(row["axis"] for row in self.rows)
        width = max(map(len, axes))
        lines = [f"{'axis':{width}}  cases  right  stopped  wrong  worst residual  longest, s"]
        for axis in axes:
            rows = [row for row in self.rows if row["axis"] == axis]
            found = Counter(row["verdict"] for row in rows)
            residuals = [row["residual"] for row in rows if row["residual"] is not None]
            worst = f"{max(residuals):.1e}" if residuals else "-"
            longest = max((row["wall_time"] or 0.0 for row in rows), default=0.0)
            lines.append(
                f"{axis:{width}}  {len(rows):5}  {found[RIGHT]:5}  {found[STOPPED]:7}  "
                f"{found[WRONG]:5}  {worst:>14}  {longest:10.3g}"
            )
        for verdict in (STOPPED, WRONG):
            for row in self.rows:
                if row["verdict"] == verdict:
                    lines += ["", f"{verdict}: {row['name']}", f"    {row['reason']}"]
        total, coarse = len(self.rows), self.too_coarse()
        share = (counts[STOPPED] - coarse) / total
        lines += [
            "",
            f"{total} cases: {counts[RIGHT]} right, {counts[STOPPED]} stopped with a reason "
            f"({coarse} of them for a step or tolerance plainly too coarse, {share:.1%} others), "
            f"{counts[WRONG]} wrong",
        ]
        return lines
