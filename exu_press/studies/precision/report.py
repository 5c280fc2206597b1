"""The report of a work-precision study: runs of each case, orders, stated errors."""

import os
import platform
from collections.abc import Mapping
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from exu_press.installation.versions import version_of
from exu_press.scene import Scene
from exu_press.studies.base.report import Picture, Report, Table
from exu_press.studies.precision.rows import Row
from exu_press.studies.precision.stated import StatedErrors
from exu_press.studies.precision.table import (
    case_table,
    machine_lines,
    order_table,
    stated_tables,
)

__all__ = ["PrecisionReport", "machine"]

PACKAGES = ("exu-press", "exudyn", "numpy", "scipy", "numba", "scikit-sundae", "numbalsoda")


def machine() -> dict[str, Any]:
    """Return processor, system, its load, and versions; null for missing packages."""
    return {
        "processor": _processor(),
        "cores": os.cpu_count(),
        "load": list(os.getloadavg()) if hasattr(os, "getloadavg") else None,
        "system": platform.platform(),
        "versions": {
            "python": platform.python_version(),
            **{name: version_of(name) for name in PACKAGES},
        },
    }


def _processor() -> str:
    try:
        lines = Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines()
    except OSError:
        lines = []
    names = [line.partition(":")[2].strip() for line in lines if line.startswith("model name")]
    return names[0] if names else platform.processor() or platform.machine()


@dataclass(frozen=True)
class PrecisionReport(Report):
    """The measurements.

    Attributes:
        quick: whether it is the reduced form, whose times mean nothing.
        cases: name -> title, scene, duration, horizon (s) and reference.
        orders: observed orders, one entry a case and solver.
        stated: stated against true errors, one entry a case and tolerance.
        left_out: runs that were left out, and why.
    """

    name = "precision"
    files = ("precision.json",)

    quick: bool
    cases: Mapping[str, Mapping[str, Any]]
    rows: tuple[Row, ...]
    orders: tuple[Mapping[str, Any], ...]
    left_out: tuple[str, ...]
    machine: Mapping[str, Any]
    stated: tuple[StatedErrors, ...] = ()

    def to_dict(self) -> dict[str, Any]:
        """Return the dictionary of precision.json."""
        return asdict(self)

    @property
    def title(self) -> str:
        """Heading of the page."""
        return f"Error against run time: {', '.join(self.cases)}"

    @property
    def scene(self) -> Scene | None:
        """The first scene among the cases."""
        scenes = [case["scene"] for case in self.cases.values() if case["scene"] is not None]
        return Scene.from_dict(scenes[0]) if scenes else None

    @property
    def failures(self) -> list[str]:
        """The reason of the first run where none reached its end."""
        if not self.rows or any(row.status == "completed" for row in self.rows):
            return []
        return [f"no run reached its end: {self.rows[0].reason}"]

    def tables(self) -> list[Table]:
        """Return where times were taken, the runs of each case, orders, and stated errors."""
        tables = [Table("Machine", above=machine_lines(self.machine, self.quick))]
        for name, case in self.cases.items():
            tables.append(case_table(name, case, [row for row in self.rows if row.case == name]))
        tables += [order_table(self.orders), *stated_tables(self.stated)]
        return [*tables, Table("Left out", above=self.left_out)] if self.left_out else tables

    def pictures(self) -> list[Picture]:
        """Return error over run time of each case."""
        function = "exu_press.studies.precision.figure:precision_figure"
        return [
            Picture(f"precision_{name}", f"{case['title']}: error over time.", function, (name,))
            for name, case in self.cases.items()
        ]
