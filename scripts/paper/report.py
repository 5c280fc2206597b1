"""What the study found."""

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from exu_press.result import Result
from paper.clearance import Choice
from paper.readings import OBSERVED, WHY_OBSERVED
from paper.rows import AGREES_WITHIN, Row
from paper.sensitivity import Tornado
from paper.side_by_side import Peaks

__all__ = ["Findings", "Report"]


@dataclass(frozen=True)
class Findings:
    """What one reading of Table 2's damping gives.

    Attributes:
        damping: a key of `damping.DAMPINGS`.
        bodies: what the runs are made with: "flexible", or "rigid" in the reduced form.
        rows: of the table.
        runs: by name, what `observe` returned of each.
        tornados: of every number with a run, rigid bodies; then those with flexible ones.
        choice: of the clearance.
        peaks: the computed peak accelerations beside the paper's, by bodies.
        settings: distance of the rigid peaks from the paper's with each setting, by its words.
        files: of the runs' results, by name.
    """

    damping: str
    bodies: str
    rows: tuple[Row, ...]
    runs: Mapping[str, Mapping[str, Any]]
    tornados: tuple[Tornado, ...]
    choice: Choice
    peaks: tuple[Peaks, ...]
    settings: Mapping[str, float | None]
    files: Mapping[str, Path]

    def result(self, name: str) -> Result:
        """Return the result of a run.

        Raises:
            InputError: its file cannot be read.
        """
        return Result.load(self.files[name])

    def has(self, *names: str) -> bool:
        """Return whether all these runs got to their end."""
        return all(self.runs.get(name, {}).get("readings") for name in names)

    @property
    def stopped(self) -> dict[str, str]:
        """Return the reasons of runs that did not get to their end, by name."""
        return {
            name: f"{row['status']}: {row['reason']}" if row["reason"] else str(row["status"])
            for name, row in self.runs.items()
            if row["status"] != "completed"
        }

    @property
    def residual(self) -> float:
        """Return the largest residual of a run's energy balance, as a part of what went through."""
        return max((abs(row.get("residual") or 0.0) for row in self.runs.values()), default=0.0)

    def to_dict(self) -> dict[str, Any]:
        """Return the entries of paper.json."""
        return {
            "rows": [row.to_dict() for row in self.rows],
            "runs": {name: dict(row) for name, row in self.runs.items()},
            "peaks": [peaks.to_dict() for peaks in self.peaks],
        }


@dataclass(frozen=True)
class Report:
    """Everything.

    Attributes:
        quick: the reduced form, whose numbers say nothing of the paper.
        findings: by reading of the damping, a key of `damping.DAMPINGS`.
        frequencies: rows of the natural frequencies, which no damping changes.
    """

    quick: bool
    findings: Mapping[str, Findings]
    frequencies: tuple[Row, ...]

    @property
    def stopped(self) -> dict[str, str]:
        """Return the reasons of runs that did not get to their end, by reading and name."""
        return {
            f"c_max {damping}, {name}": reason
            for damping, found in self.findings.items()
            for name, reason in found.stopped.items()
        }

    def to_dict(self) -> dict[str, Any]:
        """Return the content of paper.json."""
        return {
            "quick": self.quick,
            "observation_model": OBSERVED,
            "observation_model_because": WHY_OBSERVED,
            "agrees_within": AGREES_WITHIN,
            "observed_span": "the last revolution of every run",
            "frequencies": [row.to_dict() for row in self.frequencies],
            "dampings": {name: found.to_dict() for name, found in self.findings.items()},
        }

    def sensitivity_dict(self) -> dict[str, Any]:
        """Return the content of sensitivity.json."""
        return {
            "quick": self.quick,
            "observation_model": OBSERVED,
            "dampings": {
                name: {
                    "numbers": [tornado.to_dict() for tornado in found.tornados],
                    "distances_of_peaks": dict(found.settings),
                }
                for name, found in self.findings.items()
            },
        }

    def clearance_dict(self) -> dict[str, Any]:
        """Return the content of clearance.json."""
        return {name: found.choice.to_dict() for name, found in self.findings.items()}
