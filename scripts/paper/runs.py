"""The runs of section 5, by name; each lubricated one has dry balls, as in the paper."""

from typing import Any

from exu_press.scene import Film, Scene, flexible_press

__all__ = ["ELASTIC", "LOADS", "REVOLUTIONS", "clearance", "paper_runs", "rigid_twin", "run_name"]

REVOLUTIONS = 2.0
"""The second one is observed: in the first one journals and balls fall from where they start."""

BASELINE = 1e-5  # m
STATED = 1e-4  # m, the clearance of sections 5.2 and 5.3
CLEARANCES = (5e-5, 1e-4, 1.5e-4, 2e-4)  # m
SPEEDS = (200.0, 300.0, 400.0, 500.0)  # rpm
FORCES = (1e4, 2e4, 3e4, 4e4)  # N
JOINTS: dict[str, dict[str, Any]] = {
    "ideal": {"joints.crank_pin": "ideal", "joints.balls": "ideal"},
    "dry": {"joints.crank_pin": "dry"},
    "lubricated": {},
}


def blanking(force: float) -> dict[str, Any]:
    """Return a blanking pulse of a force, N, at bottom dead centre (A-14)."""
    return {"kind": "blanking", "force": force}


ELASTIC = ", elastic guides"
LOADS: dict[str, dict[str, Any]] = {"no load": {}, "10 kN": {"load.blanking": blanking(1e4)}}


def paper_runs(*, rigid_only: bool = False, revolutions: float = REVOLUTIONS) -> dict[str, Scene]:
    """Return the scenes of section 5 by name.

    "LOAD, JOINTS, BODIES" are the first runs (Figs. 14-18), those with ELASTIC behind it have
    elastic guides, with which balls move sideways too (A-9); the sweeps are "clearance 0.05 mm"
    (Figs. 19-21), "200 rpm" (Figs. 22-24), "blanking 10 kN" (Figs. 25-27), all flexible.

    Args:
        rigid_only: leave flexible bodies out; sweeps are rigid then, under their own names.
        revolutions: length of every run.
    """
    rigid = Scene(film=Film(law="pinkus"), revolutions=revolutions)
    bodies = {"rigid": rigid}
    if not rigid_only:
        bodies["flexible"] = rigid.replace(bodies=flexible_press())
    runs = {
        run_name(load, joints, kind): clearance(scene, BASELINE).replace(LOADS[load] | change)
        for load in LOADS
        for joints, change in JOINTS.items()
        for kind, scene in bodies.items()
    }
    for load in LOADS:
        for joints in ("lubricated", "dry"):
            name = run_name(load, joints, "rigid" if rigid_only else "flexible")
            runs[name + ELASTIC] = runs[name].replace("guide", {})
    sweep = bodies["rigid" if rigid_only else "flexible"]
    runs |= {f"clearance {c * 1e3:g} mm": clearance(sweep, c) for c in CLEARANCES}
    stated = clearance(sweep, STATED)
    runs |= {f"{rpm:g} rpm": stated.replace(speed_rpm=rpm) for rpm in SPEEDS}
    runs |= {
        f"blanking {n / 1e3:g} kN": stated.replace("load.blanking", blanking(n)) for n in FORCES
    }
    return runs


def run_name(load: str, joints: str, bodies: str) -> str:
    """Return the name of one of the first runs.

    >>> run_name("no load", "dry", "flexible")
    'no load, dry, flexible'
    """
    return f"{load}, {joints}, {bodies}"


def clearance(scene: Scene, radial: float) -> Scene:
    """Return the scene with the same radial clearance (m) in crank pin and balls."""
    return scene.replace({"joints.crank_pin.clearance": radial, "joints.balls.clearance": radial})


def rigid_twin(scene: Scene) -> Scene:
    """Return the scene with rigid bodies."""
    return scene.replace(bodies={})
