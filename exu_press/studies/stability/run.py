"""Push a scene to its extremes: each run is right, stopped with a reason, or wrong."""

import dataclasses
from collections.abc import Mapping
from pathlib import Path
from typing import Any, ClassVar

from exu_press.errors import InputError
from exu_press.result.run import check_channels
from exu_press.studies.base import Runs, arguments_of
from exu_press.studies.base.command import SceneCommand, SceneStudy, list_of_texts
from exu_press.studies.stability.cases import Case, extremes
from exu_press.studies.stability.judge import WRONG, judge
from exu_press.studies.stability.report import Row, StabilityReport

__all__ = ["TIME_LIMIT", "StabilityCommand", "StabilityStudy", "stability"]

TIME_LIMIT = 300.0
"""s for one case; its budget of steps ends it long before, so that a case that gets here hangs."""


@dataclasses.dataclass(frozen=True)
class StabilityStudy(SceneStudy):
    """A scene and its extremes.

    Raises:
        InputError: there is no such axis.
    """

    quick: ClassVar[bool] = False
    """Whether the cases are a sample of a larger table."""

    time_limit: float | None = TIME_LIMIT
    key: tuple[str, ...] = list_of_texts(
        "change this key alone (default: every number of the scene)"
    )

    def __post_init__(self) -> None:
        super().__post_init__()
        self.cases  # noqa: B018  checks the axes

    @property
    def cases(self) -> tuple[Case, ...]:
        """The cases along the axes."""
        return self.along_axes(extremes(self.scene, self.label), "--key")

    def along_axes(self, table: tuple[Case, ...], option: str) -> tuple[Case, ...]:
        """Return the cases of a table that are asked for; `option` asks for an axis."""
        axes = dict.fromkeys(case.axis for case in table)
        for axis in self.key:
            if axis not in axes:
                raise InputError(f"{option} {axis}: allowed are {', '.join(axes)}")
        allowed = self.key or axes
        return tuple(case for case in table if case.axis in allowed)

    def to_dict(self) -> dict[str, Any]:
        """Return the scene: cases along further axes are of the same study."""
        return {"scene": self.scene.to_dict()}


def stability(study: StabilityStudy, directory: str | Path, **how: Any) -> StabilityReport:
    """Judge the cases, write stability.json, and return the report.

    Arguments and errors are those of `exu_press.studies.base.Runs`.
    """
    check_channels(study.scene)
    cases = study.cases
    with Runs(study, directory, report=StabilityReport, function=judge, **how) as runs:
        rows = runs.rows([{"name": case.name, **arguments_of(case.scene)} for case in cases])
    results = tuple(_row(case, row) for case, row in zip(cases, rows, strict=True))
    report = StabilityReport(study.scene, study.quick, results)
    report.save(Path(directory))
    return report


def _row(case: Case, row: Mapping[str, Any]) -> Row:
    """Return the result of a case; a run that failed is wrong."""
    about = case.name, case.axis, case.value, case.scene.to_dict()
    if "verdict" not in row:
        return Row(*about, WRONG, row["status"], f"{row['status']}: {row['reason']}")
    return Row(*about, **{name: entry for name, entry in row.items() if name != "name"})


class StabilityCommand(SceneCommand):
    """`exu-press stability`."""

    example = "exu-press stability slider_crank --key contact.modulus --out out/stability"
    study = StabilityStudy
    run = staticmethod(stability)
