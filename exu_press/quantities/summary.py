"""The dictionary of summary.json."""

from typing import Any

import numpy as np

from exu_press.quantities.catalogue import quantities_of
from exu_press.quantities.kind import COST
from exu_press.quantities.reading import Reading
from exu_press.quantities.value import values_of
from exu_press.quantities.warnings import run_warnings
from exu_press.result import Result
from exu_press.scene.assumptions import assumed

__all__ = ["summary"]


def summary(result: Result) -> dict[str, Any]:
    """Return a run's end, assumptions, quantities with their errors, cost and scene.

    Plain numbers, texts, lists and dictionaries.
    """
    run = Reading(result)
    before = result.info.get("figures")
    info, values = result.info, values_of(result, run)
    declared = quantities_of(result.scene)
    costs = {name for name, placed in declared.items() if placed.quantity.kind is COST}
    return {
        "status": info["status"],
        "reason": info["reason"],
        "end_time": info["end_time"],
        "warnings": before["warnings"] if before else run_warnings(result),
        "assumed": assumed(result.scene),
        "read_from": before["read_from"]
        if before
        else dict(zip(("from", "to"), run.span, strict=True)),
        "quantities": {n: value.to_dict() for n, value in values.items() if n not in costs},
        "horizon": info.get("horizon"),
        "lyapunov_exponent": info.get("lyapunov_exponent"),
        "strokes": before["strokes"] if before else _strokes(result, run),
        "stress": info.get("stress", {}),
        "solids": info.get("solids", {}),
        "cost": {
            name.removeprefix("cost."): values[name].value for name in declared if name in costs
        },
        "own_items": info["own_items"],
        "versions": info["versions"],
        "scene": result.scene.to_dict(),
    }


def _strokes(result: Result, run: Reading) -> list[dict[str, float]]:
    return [
        {
            "position": centre.position,
            "crank_angle_deg": float(np.degrees(centre.crank_angle)),
            "tilt": float(np.interp(centre.time, result.time, result["slider_tilt"])),
        }
        for centre in run.dead_centres
    ]
