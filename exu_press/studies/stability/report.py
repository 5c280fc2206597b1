"""The report of a stability study: how many cases are right, and why others are not."""

from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass
from typing import Any

from exu_press.scene import Scene
from exu_press.studies.base.report import Report, Table
from exu_press.studies.stability.judge import RIGHT, STOPPED, WRONG

__all__ = ["Row", "StabilityReport"]

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
class StabilityReport(Report):
    """Rows of all cases that were run.

    Attributes:
        base: scene of the study.
        quick: whether it is the fixed sample.
    """

    name = "stability"
    files = ("stability.json",)
    heading = "At the extremes"
    drawn = (("stability", "Every axis from end to end."),)

    base: Scene
    quick: bool
    rows: tuple[Row, ...]

    @property
    def subtitle(self) -> str:
        """Number of cases with each verdict."""
        return ", ".join(f"{count} {verdict}" for verdict, count in self.counts().items())

    @property
    def scene(self) -> Scene:
        """The scene of the study."""
        return self.base

    @property
    def exit_status(self) -> int:
        """1 if a case is wrong."""
        return 1 if self.counts()[WRONG] else 0

    def counts(self) -> dict[str, int]:
        """Return how many cases have each verdict."""
        counts = Counter(row.verdict for row in self.rows)
        return {verdict: counts[verdict] for verdict in (RIGHT, STOPPED, WRONG)}

    def too_coarse(self) -> int:
        """Return how many cases stopped because their own setting is plainly too coarse."""
        solvers = (
            row.parameters["solver"]
            for row in self.rows
            if row.verdict == STOPPED and row.status == "under-resolved"
        )
        return sum("step" in s or s["tolerance"] >= TOO_COARSE for s in solvers)

    def to_dict(self) -> dict[str, Any]:
        """Return the dictionary of stability.json."""
        return {
            "quick": self.quick,
            "counts": self.counts(),
            "stopped_too_coarse": self.too_coarse(),
            "cases": [asdict(row) for row in self.rows],
        }

    def tables(self) -> list[Table]:
        """Return a row an axis, then every case that is not right, then the counts."""
        rows = [self._axis(axis) for axis in dict.fromkeys(row.axis for row in self.rows)]
        failed = [
            line
            for verdict in (STOPPED, WRONG)
            for row in self.rows
            if row.verdict == verdict
            for line in ("", f"{verdict}: {row.name}", f"    {row.reason}")
        ][1:]
        counts, total, coarse = self.counts(), len(self.rows), self.too_coarse()
        share = (counts[STOPPED] - coarse) / total
        summary = (
            f"{total} cases: {counts[RIGHT]} right, {counts[STOPPED]} stopped with a reason "
            f"({coarse} of them for a step or tolerance plainly too coarse, {share:.1%} others), "
            f"{counts[WRONG]} wrong"
        )
        not_right = [Table("Cases that are not right", above=failed)] if failed else []
        axes = Table("Axes", HEAD, rows, right=True)
        return [axes, *not_right, Table("All cases", above=[summary])]

    def _axis(self, axis: str) -> tuple[str, ...]:
        rows = [row for row in self.rows if row.axis == axis]
        counts = Counter(row.verdict for row in rows)
        worst = max((row.residual for row in rows if row.residual is not None), default=None)
        longest = max(row.wall_time or 0.0 for row in rows)
        numbers = len(rows), *(counts[verdict] for verdict in (RIGHT, STOPPED, WRONG))
        residual = "-" if worst is None else f"{worst:.1e}"
        return axis, *map(str, numbers), residual, f"{longest:.3g}"
