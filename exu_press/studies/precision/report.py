"""Everything that was measured, as it is written and read again."""

import os
import platform
from collections.abc import Mapping
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from exu_press.installation.versions import version_of
from exu_press.studies.precision.rows import Row
from exu_press.studies.precision.stated import Stated
from exu_press.studies.precision.table import case_lines, machine_lines, order_lines, stated_lines

__all__ = ["Report", "machine"]

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
class Report:
    """The study's outcome.

    Attributes:
        quick: whether it is the reduced form, whose times mean nothing.
        cases: name -> title, scene, duration, horizon (s) and reference.
        rows: one a run.
        orders: observed orders, one entry a case and solver.
        stated: stated against true errors, one entry a case and tolerance.
        left_out: runs that were left out, and why.
        machine: processor, system, versions.
    """

    quick: bool
    cases: Mapping[str, Mapping[str, Any]]
    rows: tuple[Row, ...]
    orders: tuple[Mapping[str, Any], ...]
    left_out: tuple[str, ...]
    machine: Mapping[str, Any]
    stated: tuple[Stated, ...] = ()

    def to_dict(self) -> dict[str, Any]:
        """Return the dictionary of precision.json."""
        return asdict(self)

    def lines(self) -> list[str]:
        """Return everything for the terminal, the table of a case after the other."""
        parts = [machine_lines(self.machine, self.quick)]
        for name, case in self.cases.items():
            parts.append(case_lines(name, case, [row for row in self.rows if row.case == name]))
        parts += [order_lines(self.orders), stated_lines(self.stated), list(self.left_out)]
        return [line for part in parts if part for line in ("", *part)][1:]
