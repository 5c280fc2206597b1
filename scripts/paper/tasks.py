"""What a worker does: one run read off, or the frequencies of one part."""

from pathlib import Path
from typing import Any

from exu_press.scene import Scene
from exu_press.simulation import simulate
from paper.readings import readings

__all__ = ["observe", "part_frequencies", "run_file"]


def observe(arguments: dict[str, Any]) -> dict[str, Any]:
    """Run a scene and read it off.

    Args:
        arguments: scene (as Scene.to_dict), and if wanted save (file for the whole result).

    Returns:
        status, reason, steps and wall_time (s) as in the summary, residual of the energy balance,
        readings, and whole: the same observed from the start on. A run that stopped early has
        neither of the two. Fixed steps too long for its impacts do not stop a run; the status says
        so, and the readings are what such steps show.
    """
    scene = Scene.from_dict(arguments["scene"])
    result = simulate(scene)
    if "save" in arguments:
        path = Path(arguments["save"])
        path.parent.mkdir(parents=True, exist_ok=True)
        result.save(path)
    kept = {key: result.info[key] for key in ("status", "reason", "steps", "wall_time")}
    reached = result.time[-1] > scene.duration * (1.0 - 1e-9)
    return {
        **kept,
        "residual": result.summary()["energy"]["residual"],
        "readings": readings(result) if reached else None,
        "whole": readings(result, (0.0, scene.duration)) if reached else None,
    }


def part_frequencies(arguments: dict[str, Any]) -> dict[str, Any]:
    """Return the clamped natural frequencies of a part, Hz, up to a number of modes.

    Args:
        arguments: part, mesh_size (m), modes.
    """
    from fe_models import clamped_frequencies, shipped_part

    part = shipped_part(arguments["part"], arguments["mesh_size"])
    hz = clamped_frequencies(part, arguments["modes"])
    return {"status": "completed", "reason": "", "hz": [float(value) for value in hz]}


def run_file(directory: Path, name: str) -> Path:
    """Return where the result of a run is kept.

    >>> run_file(Path("out"), "no load, dry, rigid").name
    'no_load_dry_rigid.nc'
    """
    return directory / "runs" / f"{name.replace(',', '').replace(' ', '_')}.nc"
