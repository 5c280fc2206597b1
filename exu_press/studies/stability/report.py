"""The result of the study, as it is written and as a user reads it."""

from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass
from typing import Any

from exu_press.studies.stability.judge import RIGHT, STOPPED, WRONG
from exu_press.terminal.columns import columns

__all__ = ["Report", "Row"]

HEAD = ("axis", "cases", "right", "stopped", "wrong", "worst residual", "longest, s")

TOO_COARSE = 0.1
"""Tolerance that is plainly too coarse for impacts, as is any fixed step that leaps over them."""


@dataclass(frozen=True)
class Row:
    """The result of one case.

    Attributes:
        name: unique.
        axis: key or choice that is varied.
        value: of it, in words.
        parameters: the scene.
        verdict: RIGHT, STOPPED or WRONG.
        status: of its run, or of the worker that failed.
        reason: why it stopped or is wrong.
        checks: of the run.
        residual: of the energy balance, relative.
        steps: accepted ones.
        wall_time: s.
    """

    name: str
    axis: str
    value: str
    parameters: Mapping[str, Any]
    verdict: str
    status: str
    reason: str = ""
    checks: Sequence[Mapping[str, Any]] = ()
    residual: float | None = None
    steps: int | None = None
    wall_time: float | None = None


@dataclass(frozen=True)
class Report:
    """Rows of all cases that were run.

    Attributes:
        quick: whether it is the fixed sample.
        rows: one a case.
    """

    quick: bool
    rows: tuple[Row, ...]

    def counts(self) -> dict[str, int]:
        """Return how many cases have each verdict."""
        found = Counter(row.verdict for row in self.rows)
        return {verdict: found[verdict] for verdict in (RIGHT, STOPPED, WRONG)}

    def too_coarse(self) -> int:
        """Return how many cases stopped because their own setting is plainly too coarse."""
        solvers = (
            row.parameters["solver"]
            for row in self.rows
            if row.verdict == STOPPED and row.status == "under-resolved"
        )
        return sum("step" in each or each["tolerance"] >= TOO_COARSE for each in solvers)

    def to_dict(self) -> dict[str, Any]:
        """Return the dictionary of stability.json."""
        return {
            "quick": self.quick,
            "counts": self.counts(),
            "stopped_too_coarse": self.too_coarse(),
            "cases": [asdict(row) for row in self.rows],
        }

    def lines(self) -> list[str]:
        """Return a table, a line an axis, then every case that is not right, then the counts."""
        table: list[tuple[str, ...]] = [HEAD]
        for axis in dict.fromkeys(row.axis for row in self.rows):
            rows = [row for row in self.rows if row.axis == axis]
            found = Counter(row.verdict for row in rows)
            worst = max((row.residual for row in rows if row.residual is not None), default=None)
            longest = max(row.wall_time or 0.0 for row in rows)
            numbers = len(rows), *(found[verdict] for verdict in (RIGHT, STOPPED, WRONG))
            residual = "-" if worst is None else f"{worst:.1e}"
            table.append((axis, *map(str, numbers), residual, f"{longest:.3g}"))
        lines, counts = columns(table, right=True), self.counts()
        for verdict in (STOPPED, WRONG):
            for row in self.rows:
                if row.verdict == verdict:
                    lines += ["", f"{verdict}: {row.name}", f"    {row.reason}"]
        total, coarse = len(self.rows), self.too_coarse()
        share = (counts[STOPPED] - coarse) / total
        lines += [
            "",
            f"{total} cases: {counts[RIGHT]} right, {counts[STOPPED]} stopped with a reason "
            f"({coarse} of them for a step or tolerance plainly too coarse, {share:.1%} others), "
            f"{counts[WRONG]} wrong",
        ]
        return lines
