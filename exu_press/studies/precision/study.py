"""The study: every chosen case against its reference, every solver against its time."""

import dataclasses
import math
from collections.abc import Callable, Sequence
from typing import Any

from exu_press.progress import Progress
from exu_press.scene import Scene
from exu_press.studies.precision import own, references
from exu_press.studies.precision.amount import FULL, QUICK, Amount
from exu_press.studies.precision.cases import Case
from exu_press.studies.precision.errors import Errors, errors_of, late_of
from exu_press.studies.precision.machine import machine
from exu_press.studies.precision.measured import LONG_RUN, Attempt, Measured, timed
from exu_press.studies.precision.report import Goal, Report
from exu_press.studies.precision.rows import ERRORS, Row, orders_of, row_of
from exu_press.studies.precision.stated import Stated, stated_errors
from exu_press.studies.precision.truth import Reference

__all__ = ["precision"]

RADII = (0.5, 0.65, 0.95)
"""Beside the default of 0.8."""
FINEST = 1e-6
"""Tolerance of the truth of stated errors where no case says otherwise."""
VARIED_TOLERANCES = (1e-2, 1e-3, 1e-4)
VARIED_STEPS = (1e-4, 2e-5, 1e-5)  # s


def precision(
    chosen: tuple[Case, ...],
    *,
    quick: bool = False,
    quiet: bool = True,
    after_case: Callable[[Report], object] = lambda report: None,
    goals_of: Callable[[Sequence[Row], dict[str, float]], Sequence[Goal]] = lambda rows, times: (),
    left_out: Sequence[str] = (),
) -> Report:
    """Run cases and return what was measured.

    Args:
        chosen: of a user's scene from `case_of`, or a table of your own.
        quick: a reduced form, whose times mean nothing.
        quiet: False shows the progress on standard error.
        after_case: called after every case with what was measured so far: all of them take half
            an hour.
    """
    amount = QUICK if quick else FULL
    rows: list[Row] = []
    described: dict[str, dict[str, Any]] = {}
    stated: list[Stated] = []
    durations: dict[str, float] = {}

    def report() -> Report:
        return Report(
            quick=quick,
            cases=dict(described),
            rows=tuple(rows),
            orders=tuple(orders_of(rows)),
            goals=() if quick else tuple(goals_of(rows, durations)),
            left_out=tuple(left_out),
            machine=machine(),
            stated=tuple(stated),
        )

    for case in chosen:
        scene = _shortened(case.scene, amount)
        durations[case.name] = _duration(case, scene)
        reference = _reference(case, scene, amount)
        horizon = reference.parted.horizon or durations[case.name]
        attempts = _attempts(case, scene, amount)
        some = _run(case, attempts, reference, horizon, case.repeats or amount.repeats, quiet)
        rows += some
        if scene is not None and not case.modes:
            until_horizon = scene.replace(revolutions=scene.revolutions * horizon / scene.duration)
            finest = amount.loosen * (case.reference_tolerance or FINEST)
            stated += stated_errors(case.name, until_horizon, amount.stated, finest)
        described[case.name] = _describe(case, reference, horizon, durations[case.name], some)
        after_case(report())
    return report()


def _shortened(scene: Scene | None, amount: Amount) -> Scene | None:
    """Return a scene no longer than the amount allows."""
    if scene is None:
        return None
    longest = amount.flexible_revolutions if scene.bodies else amount.revolutions
    return scene if scene.revolutions <= longest else scene.replace(revolutions=longest)


def _duration(case: Case, scene: Scene | None) -> float:
    """Return how long a case is simulated, s."""
    if scene is not None:
        return scene.duration
    assert case.extra is not None and case.extra.duration is not None
    return case.extra.duration


def _reference(case: Case, scene: Scene | None, amount: Amount) -> Reference:
    """Make the reference of a case."""
    if case.reference == "extra":
        assert case.extra is not None
        return case.extra.reference(scene, amount)
    assert scene is not None
    if case.reference == "own":
        return references.from_own(case, scene, amount)
    return references.closed_form(scene)


def _attempts(case: Case, scene: Scene | None, amount: Amount) -> list[Attempt]:
    """Return the runs of a case."""
    steps = [h for h in case.steps if h >= amount.finest_step]
    tolerances = [tol for tol in case.tolerances if tol >= amount.finest_tolerance]
    attempts = [] if scene is None else _own(case, scene, amount, steps, tolerances)
    if case.extra is not None:
        attempts += case.extra.attempts(scene, amount, steps, tolerances)
    return attempts


def _own(
    case: Case, scene: Scene, amount: Amount, steps: list[float], tolerances: list[float]
) -> list[Attempt]:
    """Return the package's own runs of a scene."""
    attempts = own.fixed_steps(scene, steps) + own.tolerances(scene, tolerances)
    attempts += own.mode_numbers(scene, case.modes)
    if case.variations:
        varied = [tol for tol in VARIED_TOLERANCES if tol >= amount.finest_tolerance]
        attempts += own.spectral_radii(scene, RADII, varied)
        varied = [h for h in VARIED_STEPS if h >= amount.finest_step]
        attempts += own.newton_modes(scene, varied)
    return attempts


def _run(
    case: Case,
    attempts: list[Attempt],
    reference: Reference,
    horizon: float,
    repeats: int,
    quiet: bool,
) -> list[Row]:
    """Run and compare; before a solver's first run it is warmed up by one that does not count.

    Where distributions are judged, every run has as many starts, however long it takes.
    """
    rows, warm = [], set()
    longest = math.inf if reference.starts else LONG_RUN
    with Progress(case.name, len(attempts), unit="runs", quiet=quiet) as progress:
        for done, attempt in enumerate(attempts):
            if attempt.solver not in warm:
                attempt.again(0) if attempt.again else attempt.run()
                warm.add(attempt.solver)
            run = timed(attempt, repeats, longest)
            errors, late = _errors(case, run, reference, horizon)
            rows.append(row_of(case.name, attempt, run, errors, reference.floor, late))
            progress.update(done + 1)
    return rows


def _errors(case: Case, run: Measured, reference: Reference, horizon: float) -> tuple[Errors, Any]:
    """Compare a run with the reference."""
    nothing = Errors(None, None, None)
    if run.trajectory is None:
        return nothing, None
    special = case.extra.errors(run.trajectory) if case.extra is not None else None
    if special is not None:
        return special, None
    if reference.trajectory is None:
        return nothing, None
    errors = errors_of(run.trajectory, reference.trajectory, horizon)
    late = late_of(run.trajectory, reference.trajectory, run.starts, reference.starts)
    return errors, late


def _describe(
    case: Case, reference: Reference, horizon: float, duration: float, rows: list[Row]
) -> dict[str, Any]:
    """Return what precision.json says of a case."""
    told = {error: any(row.resolved(error) is not None for row in rows) for error in ERRORS}
    return {
        "title": case.title,
        "scene": None if case.scene is None else case.scene.to_dict(),
        "duration": duration,
        "horizon": horizon,
        "amplification": reference.parted.rate,
        "reference": {
            "status": "no reference" if not any(told.values()) else "ok",
            "method": reference.method,
            "difference": dataclasses.asdict(reference.difference),
            "floor": dataclasses.asdict(reference.floor),
        },
    }
