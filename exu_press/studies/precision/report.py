"""Everything that was measured, as it is written and read again."""

from collections.abc import Mapping
from dataclasses import asdict, dataclass
from typing import Any

from exu_press.studies.precision.rows import Row
from exu_press.studies.precision.stated import Stated
from exu_press.studies.precision.table import case_lines, machine_lines, order_lines, stated_lines

__all__ = ["Goal", "Report"]


@dataclass(frozen=True)
class Goal:
    """One ratio of run times.

    Attributes:
        what: in words.
        ratio: our time over the other's; None where one of them did not get there.
        at_most: what is aimed at.
        ours: our run, in words.
        other: what it is compared with, in words.
    """

    what: str
    ratio: float | None
    at_most: float
    ours: str
    other: str

    @property
    def met(self) -> bool | None:
        """Whether the goal is met; None where there is nothing to compare."""
        return None if self.ratio is None else self.ratio <= self.at_most

    def lines(self) -> list[str]:
        """Return the goal for the terminal."""
        verdict = {True: "met", False: "NOT MET", None: "not to be told"}[self.met]
        ratio = "-" if self.ratio is None else f"{self.ratio:.3g}"
        return [
            f"goal {verdict}: {self.what}: {ratio}, wanted <= {self.at_most:.3g}",
            f"  {self.ours} against {self.other}",
        ]


@dataclass(frozen=True)
class Report:
    """The study's outcome.

    Attributes:
        quick: whether it is the reduced form, whose times mean nothing.
        cases: name -> title, scene, duration, horizon (s) and reference.
        rows: one a run.
        orders: observed orders, one entry a case and solver.
        goals: ratios of run times.
        stated: stated against true errors, one entry a case and tolerance.
        left_out: what was not run, and why.
        machine: processor, system, versions.
    """

    quick: bool
    cases: Mapping[str, Mapping[str, Any]]
    rows: tuple[Row, ...]
    orders: tuple[Mapping[str, Any], ...]
    goals: tuple[Goal, ...]
    left_out: tuple[str, ...]
    machine: Mapping[str, Any]
    stated: tuple[Stated, ...] = ()

    def to_dict(self) -> dict[str, Any]:
        """Return the dictionary of precision.json."""
        data = asdict(self)
        data["goals"] = [{**asdict(goal), "met": goal.met} for goal in self.goals]
        return data

    def lines(self) -> list[str]:
        """Return everything for the terminal, the table of a case after the other."""
        parts = [machine_lines(self.machine, self.quick)]
        for name, case in self.cases.items():
            parts.append(case_lines(name, case, [row for row in self.rows if row.case == name]))
        parts += [order_lines(self.orders), stated_lines(self.stated)]
        parts += [[line for goal in self.goals for line in goal.lines()], list(self.left_out)]
        return [line for part in parts if part for line in ("", *part)][1:]
