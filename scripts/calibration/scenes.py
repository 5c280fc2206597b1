"""Random scenes: what users can write, short enough to be run again much finer."""

import math
from collections.abc import Sequence
from typing import Any

import numpy as np

from calibration.mechanisms import eccentric, four_bar, knuckle
from exu_press import InputError, Scene
from exu_press.mechanism import SHIPPED, Mechanism
from exu_press.quantities.dead_centre import ideal_angles
from exu_press.scene import flexible_press, mechanism_of

__all__ = ["chaotic_scene", "groups_of", "random_scene"]

LAWS = ("none", "coulomb", "stribeck", "lugre_steady", "lugre")

OWN = {"own eccentric": eccentric, "own knuckle": knuckle, "own crank_rocker": four_bar}

MECHANISMS = ("press", "slider_crank", *SHIPPED, *OWN, "own crank_rocker", "own crank_rocker")

WATCH = 0.02
"""Largest factor on the lengths of machines as small as those in watches."""

SLOW = 30.0
"""rpm"""

BY_DEFAULT = ("press", "slider_crank", "eccentric_press")
"""Mechanisms with sizes of their own for joints, contact and film."""

PARTING = (*3 * ("slider_crank",), "press", "eccentric_press", "four_bar")
"""Mechanisms of chaotic scenes: most are slider-cranks, whose runs are short and part often."""

FORCES = {"press": 6e4, "eccentric_press": 6e4, "six_bar": 3e4, "own knuckle": 1e4}
"""Largest forces of loads, N; of others 1 kN."""


def random_scene(random: np.random.Generator, longest: float) -> Scene:
    """Return a random scene of 0.1 to `longest` revolutions."""
    while True:
        try:
            return Scene.from_dict(_drawn(random, longest))
        except InputError:  # a drawn clearance is none of this mechanism, or the like
            continue


def chaotic_scene(random: np.random.Generator, longest: float) -> Scene:
    """Return a random scene whose impacts may part its motions, of 1 to `longest` revolutions.

    It has a dry joint with a large clearance, little damping, high speed, and a tolerance of 1e-3,
    3e-3 or 1e-2.
    """
    name = _one_of(random, PARTING)
    mechanism = mechanism_of(Scene.from_dict({"mechanism": name}))
    joints = [joint.name for joint in mechanism.joints if not joint.spherical]
    if name == "press":
        joints = ["crank_pin"]
    own_sizes = name not in BY_DEFAULT
    given: dict[str, Any] = {
        "mechanism": name,
        "speed_rpm": float(random.uniform(150.0, 400.0)),
        "revolutions": float(random.uniform(1.0, longest)),
        "start_angle_deg": float(random.uniform(0.0, 360.0)),
        "joints": {
            _one_of(random, joints): {
                "kind": "dry",
                "clearance": float(10.0 ** random.uniform(-4.0, -3.7)),
                **({"radius": 0.02} if own_sizes else {}),
            }
        },
        "friction": {"law": _one_of(random, LAWS[:2])},
        "solver": {"tolerance": (1e-3, 3e-3, 1e-2)[int(random.integers(3))]},
    }
    contact = {"length": 0.03} if own_sizes else {}
    if name != "press":  # its contact is damped by steps
        contact["restitution"] = float(random.uniform(0.8, 0.95))
    if contact:
        given["contact"] = contact
    return Scene.from_dict(given)


def groups_of(scene: Scene) -> list[str]:
    """Return the groups of the table that a scene counts in."""
    solver, friction, guide = scene.solver, scene.friction, scene.guide
    given = scene.mechanism
    found = [f"mechanism: {given if isinstance(given, str) else 'own ' + given.name}"]
    if not isinstance(given, str) and _reach(given) < WATCH:
        found.append("size: of a watch")
    if scene.speed_rpm < SLOW:
        found.append(f"speed: below {SLOW:g} rpm")
    kinds = {joint.kind for joint in scene.joints.values()}
    mixed = scene.film is not None and scene.film["at_contact"] == "mixed"
    names = {"dry": "dry", "lubricated": "mixed" if mixed else "lubricated"}
    joints = [names[kind] for kind in sorted(kinds) if kind in names]
    found += [f"joints: {name}" for name in joints or ["ideal"]]
    if friction is not None and {"dry", "mixed"} & {*joints}:
        found.append(f"friction: {friction['law']}")
    if guide is not None:
        kind = "clearance" if guide.clearance else "elastic" if guide.soft else "rubbing"
        found += [f"guides: {kind}", f"friction of guides: {guide.friction.kind}"]
    if scene.drive is not None:
        found.append("motor")
    loads = [f"load: {load.kind}" for load in scene.load.values()]
    found += loads
    found += ["motor, load: blanking"] if scene.drive and "load: blanking" in loads else []
    if scene.bodies:
        found.append("flexible")
    if joints == ["dry"] and not (scene.guide or scene.drive or loads or scene.bodies):
        found.append("joints: dry alone")
    if solver.step is not None:
        found.append("steps: fixed")
    elif solver.tolerance is not None:
        fine = solver.tolerance < 1e-3
        found.append(f"tolerance: {'below' if fine else 'from'} 1e-3{'' if fine else ' on'}")
    return sorted({*found})


def _reach(mechanism: Mechanism) -> float:
    """Return the largest distance of a joint from the first one, m."""
    at = np.array([joint.at for joint in mechanism.joints])
    return float(np.linalg.norm(at - at[0], axis=1).max())


def _drawn(random: np.random.Generator, longest: float) -> dict[str, Any]:
    """Return what may be a scene."""
    name = _one_of(random, MECHANISMS)
    small = name in OWN and random.random() < 0.3
    size = float(10.0 ** random.uniform(-3.0, -1.7)) if small else 1.0
    given: dict[str, Any] = {
        "mechanism": OWN[name](random, size) if name in OWN else name,
        "speed_rpm": float(10.0 ** random.uniform(1.0, 2.6)),
        "revolutions": float(random.uniform(0.1, longest)),
        "start_angle_deg": float(random.uniform(0.0, 360.0)),
    }
    if name in OWN and random.random() < 0.3:
        given["gravity"] = 0.0
    mechanism = mechanism_of(Scene.from_dict({"mechanism": given["mechanism"]}))
    given |= _joints(random, mechanism, size, own_sizes=name not in BY_DEFAULT)
    if mechanism.guides and random.random() < 0.4:
        given["guide"] = _guide(random, size)
    if random.random() < 0.2:
        given["drive"] = {
            "inertia": size**5 * float(10.0 ** random.uniform(0.0, 2.5)),
            "rated_torque": size**3 * float(10.0 ** random.uniform(1.5, 3.0)),
        }
    if random.random() < (0.7 if "drive" in given else 0.4):
        given |= _load(random, given, mechanism, size**2 * FORCES.get(name, 1e3))
    if random.random() < 0.15:
        given["solver"] = {"step": float(10.0 ** random.uniform(-5.5, -4.0))}
    else:
        given["solver"] = {"tolerance": float(10.0 ** random.uniform(-4.5, -2.0))}
    if name == "press" and random.random() < 0.25:
        given["bodies"] = flexible_press()
    return given


def _joints(
    random: np.random.Generator, mechanism: Mechanism, size: float, *, own_sizes: bool
) -> dict[str, Any]:
    """Return the tables of joints: most scenes have clearance in one, some in two."""
    kind = str(random.choice(["dry", "lubricated", "mixed", "ideal"], p=[0.45, 0.2, 0.2, 0.15]))
    if kind == "ideal":
        return {}
    names = [joint.name for joint in mechanism.joints if not joint.spherical]
    several = min(len(names), 1 + int(random.random() < 0.2))
    sizes = {"radius": 0.02 * size} if own_sizes else {}
    length = {"length": 0.03 * size} if own_sizes else {}
    drawn: dict[str, Any] = {"joints": {}}
    for name in random.choice(names, several, replace=False):
        drawn["joints"][str(name)] = {
            "kind": "dry" if kind == "dry" else "lubricated",
            "clearance": size * float(10.0 ** random.uniform(-4.7, -3.7)),
            **sizes,
        }
    if kind != "dry":
        drawn["film"] = {
            "at_contact": "mixed" if kind == "mixed" else "stop",
            "viscosity": float(10.0 ** random.uniform(-2.0, -1.0)),
            **length,
        }
    if kind != "lubricated":
        law = _one_of(random, LAWS)
        drawn["friction"] = {"law": law, **_coefficients(random, law)}
        if law == "lugre":
            drawn["friction"]["sigma_0"] = float(10.0 ** random.uniform(4.0, 5.5))
        drawn["contact"] = {"restitution": float(random.uniform(0.5, 0.95)), **length}
        if mechanism.name == "press":  # its contact is damped by steps
            del drawn["contact"]["restitution"]
        elif not length and random.random() < 0.3:
            drawn["contact"] = {
                "shape": "point",
                "stiffness": float(10.0 ** random.uniform(8.0, 9.5)),
                "exponent": float(random.choice([1.0, 1.5])),
                "damping": "step",
                "damping_max": float(10.0 ** random.uniform(4.0, 6.0)),
                "damping_depth": float(10.0 ** random.uniform(-6.0, -5.0)),
            }
    return drawn


def _guide(random: np.random.Generator, size: float) -> dict[str, Any]:
    """Return [guide]: with clearance, elastic, or ideal with friction."""
    kind = str(random.choice(["clearance", "elastic", "ideal"], p=[0.6, 0.2, 0.2]))
    law = _one_of(random, LAWS[1:] if kind == "ideal" else LAWS)
    drawn: dict[str, Any] = {"friction": law, **_coefficients(random, law)}
    if kind == "clearance":
        drawn["clearance"] = size * float(10.0 ** random.uniform(-5.0, -4.0))
    elif kind == "elastic":
        drawn["lateral_stiffness"] = size * float(10.0 ** random.uniform(7.0, 9.0))
    return drawn


def _coefficients(random: np.random.Generator, law: str) -> dict[str, float]:
    """Return the coefficients of a law of friction that has them."""
    if law == "none":
        return {}
    kinetic = {"mu_kinetic": float(random.uniform(0.05, 0.2))}
    return kinetic if law == "coulomb" else {"mu_static": 0.25, **kinetic}


def _load(
    random: np.random.Generator, given: dict[str, Any], mechanism: Mechanism, most: float
) -> dict[str, Any]:
    """Return a load that acts about the bottom dead centre, and the start before it."""
    force, bottom = (
        most * float(random.uniform(0.1, 1.0)),
        math.degrees(ideal_angles(mechanism)[0]),
    )
    part = 360.0 * given["revolutions"]
    start = bottom - part * float(random.uniform(0.2, 0.9))
    stroke = float(np.ptp(mechanism.ideal_slider(np.linspace(0.0, 2.0 * np.pi, 361), 1.0)[0]))
    height = stroke * float(random.uniform(0.02, 0.2))
    loads: dict[str, dict[str, Any]] = {
        "blanking": {
            "force": force,
            "end_angle_deg": (start + part * float(random.uniform(0.2, 1.0))) % 360.0 or 360.0,
        },
        "table": {"height": [0.0, 0.3 * height, height], "force": [force, 0.8 * force, 0.0]},
        "sheet": {
            "height": height,
            "thickness": 0.8 * height,
            "shear_strength": 3e8,
            "cut_length": force / (3e8 * 0.8 * height),
            "penetration": float(random.uniform(0.2, 0.6)),
            "crack_time": 2e-4,
            "stripping": 0.05,
        },
        "spring": {
            "height": height,
            "travel": [0.0, 0.02 * height, 1.5 * height],
            "force": [0.0, 0.3 * force, 0.5 * force],
            "damping": float(random.uniform(0.0, 0.3)),
        },
    }
    kind = _one_of(random, [*loads])
    return {"start_angle_deg": start % 360.0, "load": {kind: {"kind": kind, **loads[kind]}}}


def _one_of(random: np.random.Generator, choices: Sequence[str]) -> str:
    """Return one of some choices."""
    return choices[int(random.integers(len(choices)))]
