"""The runs of section 5, by name; each lubricated one has dry balls, as in the paper."""

from collections.abc import Mapping
from typing import Any

from exu_press.scene import Scene, flexible_press

__all__ = [
    "DAMPINGS",
    "DEFAULT",
    "JOINTS",
    "LOADS",
    "SWEEPS",
    "clearance",
    "paper_runs",
    "rigid_twin",
]

DEFAULT = "2.5545e8"
"""The reading of Table 2's damping that scenes have by default."""

DAMPINGS: Mapping[str, float] = {DEFAULT: 2.5545e8, "0.01": 0.01}
"""What c_max (N s/m) is taken for: Table 2's value in SI units, or its 0.01, which has no unit.

Section 3.4 explains 0.01 as the part of the stiffness that the damping is; taken literally it is
almost no damping, in SI units as in the mm, kg, s of ADAMS (10 N s/m).
"""

BASELINE = 1e-5  # m
STATED = 1e-4  # m, the clearance of sections 5.2 and 5.3
CLEARANCES = (5e-5, 1e-4, 1.5e-4, 2e-4)  # m
SPEEDS = (200.0, 300.0, 400.0, 500.0)  # rpm
FORCES = (1e4, 2e4, 3e4, 4e4)  # N
SWEEPS = {
    "clearance, mm": [f"clearance {1e3 * radial:g} mm" for radial in CLEARANCES],
    "speed, rpm": [f"{rpm:g} rpm" for rpm in SPEEDS],
    "blanking force, kN": [f"blanking {1e-3 * force:g} kN" for force in FORCES],
}
"""Names of the runs of sections 5.1 to 5.3, by what is swept."""

JOINTS: dict[str, dict[str, Any]] = {
    "ideal": {"joints.crank_pin": "ideal", "joints.balls": "ideal", "bodies": {}},
    "dry": {"joints.crank_pin": "dry"},
    "lubricated": {},
}


def blanking(force: float) -> dict[str, Any]:
    """Return a blanking pulse of a force, N, at bottom dead centre (A-14)."""
    return {"load.blanking": {"kind": "blanking", "force": force}}


LOADS: dict[str, dict[str, Any]] = {"no load": {}, "10 kN": blanking(1e4)}


def paper_runs(
    damping: str, *, flexible: bool = True, revolutions: float = 2.0
) -> dict[str, Scene]:
    """Return the scenes of section 5 by name, and those with rigid bodies: "NAME, rigid".

    "LOAD, JOINTS" are the first runs (Figs. 14-18); the sweeps are "clearance 0.05 mm"
    (Figs. 19-21), "200 rpm" (Figs. 22-24), "blanking 10 kN" (Figs. 25-27).

    Args:
        damping: a key of DAMPINGS.
        flexible: False: rigid bodies everywhere, under the same names.
        revolutions: of every run. The second one is observed: in the first one journals and balls
            fall from where they start.
    """
    scene = Scene(film={"law": "pinkus"}, revolutions=revolutions)
    scene = scene.replace({"contact.damping_max": DAMPINGS[damping]})
    if flexible:
        scene = scene.replace({"bodies": flexible_press()})
    stated = clearance(scene, STATED)
    runs = {
        f"{load}, {joints}": clearance(scene, BASELINE).replace(LOADS[load] | change)
        for load in LOADS
        for joints, change in JOINTS.items()
    }
    sweeps = [
        *(clearance(scene, radial) for radial in CLEARANCES),
        *(stated.replace({"speed_rpm": rpm}) for rpm in SPEEDS),
        *(stated.replace(blanking(force)) for force in FORCES),
    ]
    runs |= zip((name for names in SWEEPS.values() for name in names), sweeps, strict=True)
    return runs | {f"{name}, rigid": rigid_twin(scene) for name, scene in runs.items()}


def clearance(scene: Scene, radial: float) -> Scene:
    """Return the scene with the same radial clearance (m) in crank pin and balls."""
    return scene.replace({"joints.crank_pin.clearance": radial, "joints.balls.clearance": radial})


def rigid_twin(scene: Scene) -> Scene:
    """Return the scene with rigid bodies."""
    return scene.replace({"bodies": {}})
