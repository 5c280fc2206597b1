"""The report of a wear study: clearances and quantities over the strokes."""

import dataclasses
from collections.abc import Mapping, Sequence
from typing import Any

from exu_press.parallel.task import COMPLETED
from exu_press.quantities import quantity_of
from exu_press.quantities.uncertain import significant
from exu_press.quantities.units import with_unit
from exu_press.scene import Scene
from exu_press.studies.base import Row
from exu_press.studies.base.report import (
    Column,
    Points,
    Report,
    Table,
    quantity_column,
    scale_numbers,
)
from exu_press.studies.wear.shape import Depths, worn_scene
from exu_press.studies.wear.study import WearStudy

__all__ = ["Point", "WearReport"]

MOST_LINES = 12
"""Points that a terminal shows, the first and the last of them always."""


@dataclasses.dataclass(frozen=True)
class Point:
    """The press after some strokes.

    Attributes:
        strokes: since the start.
        jump: length of the last jump, strokes.
        error: sum of the errors of jumps, m; the largest of all joints.
        depths: joint -> its worn depths.
        ways: guided body -> worn depth of its guideways, m.
        row: of the run with these depths.
    """

    strokes: float
    jump: float
    error: float
    depths: Mapping[str, Depths]
    ways: Mapping[str, float]
    row: Row


@dataclasses.dataclass(frozen=True)
class WearReport(Report):
    """The course of wear, and how it ended.

    Attributes:
        reason: why it ended before all strokes were done; empty where they are.
    """

    name = "wear"
    files = ("wear.json", "worn.toml")
    scene_file = "worn.toml"
    drawn = (("wear", "The course."),)

    study: WearStudy
    course: Sequence[Point]
    reason: str = ""

    @property
    def jumps(self) -> str:
        """Return the number of jumps in words."""
        number = len(self.course) - 1
        return f"{number} jump{'s' * (number != 1)}"

    @property
    def failures(self) -> list[str]:
        """The reason why it ended before all strokes were done."""
        strokes = significant(self.study.wear.strokes, 4)
        return [f"ended before {strokes} strokes: {self.reason}"] if self.reason else []

    @property
    def title(self) -> str:
        """Heading of the page."""
        return f"Wear over {significant(self.course[-1].strokes, 4)} strokes"

    @property
    def subtitle(self) -> str:
        """Number of jumps, and why it ended early."""
        return f"jumps: {len(self.course) - 1}" + (f"; {self.reason}" if self.reason else "")

    @property
    def scene(self) -> Scene:
        """The scene with the joints as worn as at the last point."""
        return worn_scene(self.study.scene, self.course[-1].depths)

    @property
    def scenes(self) -> Sequence[Scene]:
        """The scene without wear."""
        return [self.study.scene]

    def clearances(self, joint: str) -> list[float]:
        """Return a joint's clearance where it is largest, point by point, m."""
        new = float(self.study.scene.joints[joint].clearance)
        return [new + point.depths[joint].deepest for point in self.course]

    def values(self, quantity: str) -> list[float | None]:
        """Return a quantity point by point."""
        return [point.row.get(quantity) for point in self.course]

    def tables(self) -> list[Table]:
        """Return strokes, clearances and quantities point by point, and how it ended."""
        heads = ["strokes"]
        cells = [[significant(point.strokes, 4) for point in self.course]]
        for joint in self.study.joints:
            heads.append(f"{joint.replace('_', ' ')} clearance, um")
            cells.append([f"{1e6 * value:.5g}" for value in self.clearances(joint)])
        for name in self.study.names:
            values = self.values(name)
            quantity = quantity_of(self.study.scene, name).quantity
            quantity = quantity.in_scaled_unit(filter(None, values))
            heads.append(with_unit(name, quantity.display_unit))
            digits = 7 if quantity.unit == "m" else 4
            cells.append(
                [
                    "-" if value is None else significant(value * quantity.scale, digits)
                    for value in values
                ]
            )
        rows = list(zip(*cells, strict=True))
        excerpt = None
        if len(rows) > MOST_LINES:
            count = MOST_LINES - 1
            excerpt = sorted({round(i * (len(rows) - 1) / count) for i in range(MOST_LINES)})
        last = self.course[-1]
        below = [
            f"{significant(last.strokes, 4)} strokes in {self.jumps}; a jump and its "
            f"halves differ by {1e6 * last.error:.2g} um in all",
            *(
                f"worn off the guideways of {body}: {1e6 * depth:.3g} um"
                for body, depth in last.ways.items()
            ),
            *["guides and slots keep their clearance and shape in these runs"] * bool(last.ways),
        ]
        return [Table("Jumps", heads, rows, below=below, right=True, excerpt=excerpt)]

    def points(self) -> Points | None:
        """Return the course over the strokes; None of a single point."""
        if len(self.course) < 2:
            return None
        strokes = [point.strokes for point in self.course]
        columns = [
            Column(f"{name}, largest clearance", "um", scale_numbers(self.clearances(name), 1e6))
            for name in self.study.joints
        ]
        columns += [
            Column(f"guideways of {body}, depth", "um", [1e6 * p.ways[body] for p in self.course])
            for body in self.course[0].ways
        ]
        columns += [quantity_column(name, self.values(name)) for name in self.study.names]
        kind = Column("study", "", ["wear"] * len(strokes))
        return Points(
            [Column("strokes", "", strokes), kind],
            columns,
            [f"after {n:.6g} strokes" for n in strokes],
            colour="study",
            title="Course",
        )

    def to_dict(self) -> dict[str, Any]:
        """Return the entries of wear.json."""
        return {
            "status": "stopped" if self.reason else COMPLETED,
            "reason": self.reason,
            "strokes": [point.strokes for point in self.course],
            "jump": [point.jump for point in self.course],
            "error": [point.error for point in self.course],
            "joints": {
                name: {
                    "clearance": self.clearances(name),
                    "bearing_depth": [p.depths[name].bearing.tolist() for p in self.course],
                    "journal_depth": [p.depths[name].journal.tolist() for p in self.course],
                }
                for name in self.study.joints
            },
            "guides": {
                body: [point.ways[body] for point in self.course] for body in self.course[0].ways
            },
            "quantities": {name: self.values(name) for name in self.study.names},
        }
