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
from paper.tasks import run_file

__all__ = ["Report"]


@dataclass(frozen=True)
class Report:
    """Everything.

    Attributes:
        quick: the reduced form, whose numbers say nothing of the paper.
        rows: of the table.
        runs: by name, what `observe` returned of each.
        tornados: of every number with a run, rigid bodies; then those with flexible ones.
        choice: of the clearance.
        directory: holds the runs' results.
    """

    quick: bool
    rows: tuple[Row, ...]
    runs: Mapping[str, Mapping[str, Any]]
    tornados: tuple[Tornado, ...]
    choice: Choice
    directory: Path

    @property
    def bodies(self) -> str:
        """Return what the runs are made with: "flexible", or "rigid" in the reduced form."""
        return "rigid" if self.quick else "flexible"

    def result(self, name: str) -> Result:
        """Return the result of a run.

        Raises:
            InputError: its file cannot be read.
        """
        return Result.load(run_file(self.directory, name))

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

    def to_dict(self) -> dict[str, Any]:
        """Return the content of paper.json."""
        return {
            "quick": self.quick,
            "observation_model": OBSERVED,
            "observation_model_because": WHY_OBSERVED,
            "agrees_within": AGREES_WITHIN,
            "observed_span": "the last revolution of every run",
            "rows": [row.to_dict() for row in self.rows],
            "runs": {name: dict(row) for name, row in self.runs.items()},
        }

    def sensitivity_dict(self) -> dict[str, Any]:
        """Return the content of sensitivity.json."""
        return {
            "quick": self.quick,
            "observation_model": OBSERVED,
            "numbers": [tornado.to_dict() for tornado in self.tornados],
        }
