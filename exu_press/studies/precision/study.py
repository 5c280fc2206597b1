"""The study: every chosen case against its reference, every solver against its time."""

import math
from collections.abc import Callable, Sequence
from dataclasses import asdict
from typing import Any

from exu_press.studies.precision.cases import FULL, QUICK, Amount, Case
from exu_press.studies.precision.measured import LONG_RUN, timed
from exu_press.studies.precision.references import Reference
from exu_press.studies.precision.report import Report, machine
from exu_press.studies.precision.rows import ERRORS, Row, orders_of, row_of
from exu_press.studies.precision.stated import Stated
from exu_press.terminal.progress import Progress

__all__ = ["precision"]


def precision(
    chosen: Sequence[Case],
    *,
    quick: bool = False,
    quiet: bool = True,
    after_case: Callable[[Report], object] = lambda report: None,
    left_out: Sequence[str] = (),
) -> Report:
    """Run cases and return the measurements.

    Args:
        chosen: of a user's scene from `case_of`, or a table of your own.
        quick: a reduced form, whose times mean nothing.
        quiet: False shows the progress on standard error.
        after_case: called after every case with the report so far: all of them take half
            an hour.
        left_out: runs that were left out, and why.
    """
    amount = QUICK if quick else FULL
    rows: list[Row] = []
    described: dict[str, dict[str, Any]] = {}
    stated: list[Stated] = []

    def report() -> Report:
        return Report(
            quick=quick,
            cases=dict(described),
            rows=tuple(rows),
            orders=tuple(orders_of(rows)),
            left_out=tuple(left_out),
            machine=machine(),
            stated=tuple(stated),
        )

    for case in (whole.within(amount) for whole in chosen):
        reference = case.reference(amount)
        horizon = reference.diverged.horizon or case.duration
        some = _run(case, amount, reference, horizon, quiet)
        rows += some
        stated += case.stated(amount, horizon)
        described[case.name] = _describe(case, reference, horizon, some)
        after_case(report())
    return report()


def _run(
    case: Case, amount: Amount, reference: Reference, horizon: float, quiet: bool
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
            run = timed(attempt, case.repeats or amount.repeats, longest)
            errors, late = case.errors(run, reference, horizon)
            rows.append(row_of(case.name, attempt, run, errors, reference.floor, late))
            progress.update(done + 1)
    return rows


def _describe(
    case: Case, reference: Reference, horizon: float, rows: Sequence[Row]
) -> dict[str, Any]:
    """Return the entry of a case in precision.json."""
    told = any(row.resolved(error) is not None for row in rows for error in ERRORS)
    return {
        "title": case.title,
        "scene": None if case.scene is None else case.scene.to_dict(),
        "duration": case.duration,
        "horizon": horizon,
        "lyapunov_exponent": reference.diverged.rate,
        "reference": {
            "status": "ok" if told else "no reference",
            "method": reference.method,
            "difference": asdict(reference.difference),
            "floor": asdict(reference.floor),
        },
    }
