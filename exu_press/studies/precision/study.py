"""The study: every chosen case against its reference, every solver against its time."""

import dataclasses
from collections.abc import Callable
from typing import Any

import numpy as np

from exu_press.progress import Progress
from exu_press.scene import Scene
from exu_press.studies.precision import own, references
from exu_press.studies.precision.cases import FULL, QUICK, Amount, Case
from exu_press.studies.precision.compiled import CompiledModel, compile_model, has_numba
from exu_press.studies.precision.errors import Errors, errors_of, late_of
from exu_press.studies.precision.goals import goals_of
from exu_press.studies.precision.machine import machine
from exu_press.studies.precision.measured import Attempt, Measured, timed
from exu_press.studies.precision.peers import PEERS, installed, peer_attempts
from exu_press.studies.precision.references import Reference
from exu_press.studies.precision.report import Report
from exu_press.studies.precision.rows import ERRORS, Row, orders_of, row_of
from exu_press.studies.precision.squeezer import DURATION, squeezer_attempts, squeezer_errors

__all__ = ["precision"]

PEER_TOLERANCES = (1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10)
RADII = (0.5, 0.65, 0.95)
"""Beside the default of 0.8."""
VARIED_TOLERANCES = (1e-2, 1e-3, 1e-4)
VARIED_STEPS = (1e-4, 2e-5, 1e-5)  # s


def precision(
    chosen: tuple[Case, ...],
    *,
    quick: bool = False,
    quiet: bool = True,
    after_case: Callable[[Report], object] = lambda report: None,
) -> Report:
    """Run cases and return what was measured.

    Args:
        chosen: from `exu_press.studies.precision.cases`.
        quick: a reduced form, whose times mean nothing.
        quiet: False shows the progress on standard error.
        after_case: called after every case with what was measured so far: all of them take half
            an hour.
    """
    amount = QUICK if quick else FULL
    left_out = [why for peer in PEERS if (why := installed(peer))]
    if not has_numba():
        left_out.append("numba is not installed: the peers' right-hand side is not compiled")
    rows: list[Row] = []
    described: dict[str, dict[str, Any]] = {}
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
        )

    for case in chosen:
        scene = _shortened(case.scene, amount)
        durations[case.name] = scene.duration if scene is not None else DURATION
        horizon = min(case.horizon or np.inf, durations[case.name])
        model = compile_model(scene) if case.reference == "reduced" and scene else None
        reference = _reference(case, scene, model, horizon, amount)
        attempts = _attempts(case, scene, model, amount)
        some = _run(case, attempts, reference, horizon, case.repeats or amount.repeats, quiet)
        rows += some
        described[case.name] = _describe(case, reference, horizon, durations[case.name], some)
        after_case(report())
    return report()


def _shortened(scene: Scene | None, amount: Amount) -> Scene | None:
    """Return a scene no longer than the amount allows."""
    if scene is None:
        return None
    longest = amount.revolutions if scene.flexible is None else amount.flexible_revolutions
    return scene if scene.revolutions <= longest else scene.replace(revolutions=longest)


def _reference(
    case: Case,
    scene: Scene | None,
    model: CompiledModel | None,
    horizon: float,
    amount: Amount,
) -> Reference:
    """Make the reference of a case."""
    if scene is None:
        return references.published()
    if model is not None:
        return references.from_reduced(model, horizon, amount)
    if case.reference == "own":
        return references.from_own(case, scene, horizon, amount)
    return references.closed_form(scene)


def _attempts(
    case: Case, scene: Scene | None, model: CompiledModel | None, amount: Amount
) -> list[Attempt]:
    """Return the runs of a case."""
    steps = [h for h in case.steps if h >= amount.finest_step]
    tolerances = [tol for tol in case.tolerances if tol >= amount.finest_tolerance]
    if scene is None:
        return squeezer_attempts(steps, tolerances)
    attempts = own.fixed_steps(scene, steps) + own.tolerances(scene, tolerances)
    attempts += own.mode_numbers(scene, case.modes)
    if case.variations:
        varied = [tol for tol in VARIED_TOLERANCES if tol >= amount.finest_tolerance]
        attempts += own.spectral_radii(scene, RADII, varied)
        varied = [h for h in VARIED_STEPS if h >= amount.finest_step]
        attempts += own.newton_modes(scene, varied)
    if model is not None:
        tight = [tol for tol in PEER_TOLERANCES if tol >= amount.finest_peer]
        attempts += peer_attempts(model, tight)
    return attempts


def _run(
    case: Case,
    attempts: list[Attempt],
    reference: Reference,
    horizon: float,
    repeats: int,
    quiet: bool,
) -> list[Row]:
    """Run and compare; before a solver's first run it is warmed up by one that does not count."""
    rows, warm = [], set()
    with Progress(case.name, len(attempts), unit="runs", quiet=quiet) as progress:
        for done, attempt in enumerate(attempts):
            if attempt.solver not in warm:
                (attempt.again or attempt.run)()
                warm.add(attempt.solver)
            run = timed(attempt, repeats)
            errors, late = _errors(case, run, reference, horizon)
            rows.append(row_of(case.name, attempt, run, errors, reference.floor, late))
            progress.update(done + 1)
    return rows


def _errors(case: Case, run: Measured, reference: Reference, horizon: float) -> tuple[Errors, Any]:
    """Compare a run with the reference."""
    nothing = Errors(None, None, None)
    if run.trajectory is None:
        return nothing, None
    if case.scene is None:
        return squeezer_errors(run.trajectory), None
    if reference.trajectory is None:
        return nothing, None
    errors = errors_of(run.trajectory, reference.trajectory, horizon)
    return errors, late_of(run.trajectory, reference.trajectory)


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
        "reference": {
            "status": "no reference" if not any(told.values()) else "ok",
            "method": reference.method,
            "difference": dataclasses.asdict(reference.difference),
            "floor": dataclasses.asdict(reference.floor),
        },
    }
