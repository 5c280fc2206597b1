"""Measure error against run time of a scene, with tolerances and with fixed steps; draw both."""

import dataclasses
import math
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

from exu_press.result.run import check_channels
from exu_press.schema.checks import key
from exu_press.studies.base.command import SceneCommand, SceneStudy
from exu_press.studies.precision.cases import FULL, QUICK, Case, Extent, case_of
from exu_press.studies.precision.references import Reference
from exu_press.studies.precision.report import PrecisionReport, machine
from exu_press.studies.precision.rows import ERRORS, Row, orders_of, row_of
from exu_press.studies.precision.stated import StatedErrors
from exu_press.studies.precision.timing import LONG_RUN, time_runs
from exu_press.terminal.progress import Progress

__all__ = ["PrecisionCommand", "PrecisionStudy", "precision"]


def precision(
    cases: Sequence[Case],
    *,
    quick: bool = False,
    quiet: bool = True,
    after_case: Callable[[PrecisionReport], object] = lambda report: None,
    left_out: Sequence[str] = (),
) -> PrecisionReport:
    """Run cases and return the measurements.

    Args:
        cases: of a user's scene from `case_of`, or a table of your own.
        quick: a reduced form, whose times mean nothing.
        after_case: called after every case with the report so far: all of them take half
            an hour.
    """
    amount = QUICK if quick else FULL
    rows: list[Row] = []
    described: dict[str, dict[str, Any]] = {}
    stated: list[StatedErrors] = []

    def report() -> PrecisionReport:
        return PrecisionReport(
            quick=quick,
            cases=dict(described),
            rows=tuple(rows),
            orders=tuple(orders_of(rows)),
            left_out=tuple(left_out),
            machine=machine(),
            stated=tuple(stated),
        )

    for case in (whole.limit_to(amount) for whole in cases):
        reference = case.reference(amount)
        horizon = reference.diverged.horizon or case.duration
        some = _run(case, amount, reference, horizon, quiet)
        rows += some
        stated += case.compare_stated_errors(amount, horizon)
        described[case.name] = _describe(case, reference, horizon, some)
        after_case(report())
    return report()


def _run(
    case: Case, amount: Extent, reference: Reference, horizon: float, quiet: bool
) -> list[Row]:
    """Run and compare; before a solver's first run it is warmed up by one that does not count.

    Where distributions are judged, every run has as many starts, however long it takes.
    """
    rows, warm, attempts = [], set(), case.attempts(amount)
    longest = math.inf if reference.starts else LONG_RUN
    with Progress(case.name, len(attempts), unit="runs", quiet=quiet) as progress:
        for done, attempt in enumerate(attempts):
            if attempt.solver not in warm:
                attempt.again(0) if attempt.again else attempt.run()
                warm.add(attempt.solver)
            run = time_runs(attempt, case.repeats or amount.repeats, longest)
            errors, peaks = case.errors(run, reference, horizon)
            rows.append(row_of(case.name, attempt, run, errors, reference.floor, peaks))
            progress.update(done + 1)
    return rows


def _describe(
    case: Case, reference: Reference, horizon: float, rows: Sequence[Row]
) -> dict[str, Any]:
    is_resolved = any(row.resolved_error(error) is not None for row in rows for error in ERRORS)
    return {
        "title": case.title,
        "scene": None if case.scene is None else case.scene.to_dict(),
        "duration": case.duration,
        "horizon": horizon,
        "lyapunov_exponent": reference.diverged.rate,
        "reference": {
            "status": "ok" if is_resolved else "no reference",
            "method": reference.method,
            "difference": dataclasses.asdict(reference.difference),
            "floor": dataclasses.asdict(reference.floor),
        },
    }


@dataclasses.dataclass(frozen=True)
class PrecisionStudy(SceneStudy):
    """Error against run time of one scene."""

    quick: bool = key(False, "a reduced form, less than two minutes; times mean nothing")


class PrecisionCommand(SceneCommand):
    """`exu-press precision`; its runs are done one after the other, as their times count."""

    example = "exu-press precision slider_crank --quick --out out/precision"
    study = PrecisionStudy
    uses_workers = False

    @staticmethod
    def run(study: PrecisionStudy, directory: Path, **how: Any) -> PrecisionReport:
        """Measure, and return the report."""
        check_channels(study.scene)
        case = case_of(study.label, study.scene)
        return precision((case,), quick=study.quick, **how)
