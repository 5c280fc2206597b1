"""What a worker does: one run read off with its errors, or the frequencies of one part."""

from pathlib import Path
from typing import Any

from exu_press.integrate import SolverStatus
from exu_press.scene import Scene
from exu_press.verification.refinement import plan
from exu_press.verification.run import errors_of
from exu_press.verification.simulate import simulate
from paper.readings import declared, readings

__all__ = ["COARSER", "observe", "part_frequencies", "read"]

COARSER = 1.5
"""Mesh beside the one whose frequencies are taken, over it."""

MOST_REPEATED = 4
"""Thirds of the tolerance: 1e-2 becomes 1e-4."""


def observe(arguments: dict[str, Any]) -> dict[str, Any]:
    """Run a scene and its refinements, and read them off.

    Args:
        arguments: scene (as Scene.to_dict), and if wanted save (file for the whole result).

    Returns:
        status and reason as in the summary, residual of the energy balance, and values: of each
        reading what a `Value` has; none of a run that stopped early. Fixed steps too long for its
        impacts do not stop a run; the status says so, and the readings are what such steps show.
    """
    scene = Scene.from_dict(arguments["scene"])
    result = simulate(scene)
    if "save" in arguments:
        path = Path(arguments["save"])
        path.parent.mkdir(parents=True, exist_ok=True)
        result.save(path)
    row = {key: result.info[key] for key in ("status", "reason")}
    row["residual"] = result.quantity("energy.residual").value
    if result.time[-1] < scene.duration * (1.0 - 1e-9):
        return {**row, "values": {}}
    refinements = ((ratio, simulate(other)) for ratio, other in plan(scene).items())
    errors = errors_of(result, refinements, declared(result))["errors"]
    values = {
        name: {"value": value} | {key: errors[name][key] for key in ("low", "high", "determined")}
        for name, value in readings(result).items()
        if name in errors
    }
    return {**row, "values": values}


def read(arguments: dict[str, Any]) -> dict[str, Any]:
    """Run a scene and read it off, without errors: a search compares readings, not digits.

    A run with an impact that its steps did not resolve is repeated at a third of its tolerance, and
    has no values where that does not help.

    Returns:
        status and reason as in the summary, values by reading, none of a run that stopped; and how
        often it was repeated.
    """
    scene = Scene.from_dict(arguments["scene"])
    result, repeated = simulate(scene), 0
    while result.info["status"] == SolverStatus.UNDER_RESOLVED.value and repeated < MOST_REPEATED:
        repeated += 1
        assert scene.solver.tolerance is not None
        scene = scene.replace({"solver.tolerance": scene.solver.tolerance / 3.0})
        result = simulate(scene)
    row = {key: result.info[key] for key in ("status", "reason")}
    done = row["status"] == SolverStatus.COMPLETED.value
    return {**row, "values": readings(result) if done else {}, "repeated": repeated}


def part_frequencies(arguments: dict[str, Any]) -> dict[str, Any]:
    """Return the clamped natural frequencies of a part, Hz, up to a number of modes.

    Those of a finer mesh are lower. At worst the error goes with the size of its elements, so that
    what is left of it is at most 1 / (COARSER - 1) times what the coarser mesh is higher by. Of
    sizes from 0.04 m on this says little: there the shape alone says how large elements are.

    Args:
        arguments: part, mesh_size (m), modes.

    Returns:
        values: of every mode what a `Value` has.
    """
    from fe_models import clamped_frequencies, shipped_part

    size, modes = arguments["mesh_size"], arguments["modes"]
    fine, coarse = (
        clamped_frequencies(shipped_part(arguments["part"], mesh), modes)
        for mesh in (size, COARSER * size)
    )
    values = [
        {"value": float(f), "low": float(f - abs(c - f) / (COARSER - 1.0)), "high": float(f)}
        for f, c in zip(fine, coarse, strict=True)
    ]
    return {"status": "completed", "reason": "", "values": values}
