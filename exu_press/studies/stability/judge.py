"""One case, run and judged: right, stopped or wrong."""

from typing import Any

from exu_press.integrate import SolverStatus
from exu_press.scene import Scene
from exu_press.studies.base import scene_from
from exu_press.studies.stability.checks import agreement, checks_of
from exu_press.verification.refinement import FINEST
from exu_press.verification.run import with_errors
from exu_press.verification.simulate import simulate

__all__ = ["RIGHT", "STOPPED", "WRONG", "finer", "judge"]

RIGHT, STOPPED, WRONG = "right", "stopped", "wrong"

TOO_FINE = (SolverStatus.STEP_TOO_SMALL, SolverStatus.NOT_CONVERGED)

LESS_FINE = 0.5
"""Fraction of the tolerance for the finer run, where one with a tenth of it stops early."""

FINER_THAN_A_STEP = 1e-5
"""Tolerance of the run that one with a fixed step is compared with."""


def judge(case: dict[str, Any]) -> dict[str, Any]:
    """Run a case and return its row.

    Args:
        case: name and scene.
    """
    scene = scene_from(case)
    result = simulate(scene)
    info = result.info
    row: dict[str, Any] = {
        "name": case["name"],
        "status": info["status"],
        "reason": info["reason"],
        "steps": info["steps"],
        "wall_time": info["wall_time"],
    }
    if info["reason"]:
        row |= {"verdict": STOPPED, "checks": [], "residual": None}
        return row
    checks = checks_of(result)
    residual = next((c.value for c in checks if c.name == "energy residual"), None)
    if all(check.is_within_limit for check in checks):
        reference = simulate(finer(scene))
        if reference.info["status"] in (s.value for s in TOO_FINE):
            reference = simulate(finer(scene, LESS_FINE))
        if reference.info["reason"]:
            row["reason"] = f"the finer run: {reference.info['reason']}"
        else:
            stated = with_errors(result, beside=False)
            check = agreement(stated, reference)
            if not check.is_within_limit:  # as where rounding decides about the errors of both
                check = agreement(stated, with_errors(reference, beside=False))
            checks.append(check)
    failed = [check for check in checks if not check.is_within_limit]
    right = not failed and not row["reason"]
    if failed:
        row["reason"] = "; ".join(
            f"{check.name} = {check.value if check.value is None else format(check.value, '.2g')}, "
            f"allowed {check.limit:g}" + f" ({check.note})" * bool(check.note)
            for check in failed
        )
    return row | {
        "verdict": RIGHT if right else WRONG,
        "checks": [check.to_dict() for check in checks],
        "residual": residual,
    }


def finer(scene: Scene, share: float = 0.1) -> Scene:
    """Return a scene with a share of its tolerance; a fixed step is replaced by a tolerance."""
    solver, tolerance = scene.solver, FINER_THAN_A_STEP
    if solver.tolerance is not None:
        tolerance = max(share * solver.tolerance, FINEST)
    return scene.replace({"solver.tolerance": tolerance, "solver.max_steps": 5 * solver.max_steps})
