"""The dictionary of summary.json, with its warnings."""

import math
from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np

from exu_press.mechanism.independent_constraints import independent_constraints
from exu_press.quantities.catalogue import quantities_of
from exu_press.quantities.energy import energy_residual
from exu_press.quantities.kind import COST
from exu_press.quantities.oil import oil_warnings
from exu_press.quantities.reading import Reading
from exu_press.quantities.slopes import slope_warnings
from exu_press.quantities.start_stop import commands_to_come, still_turns
from exu_press.quantities.value import values_of
from exu_press.result import JointRecord, Result
from exu_press.result.windows import whole_revolutions
from exu_press.scene import DryJoint, LubricatedJoint, Scene, mechanism_of
from exu_press.scene.assumptions import assumed_values
from exu_press.scene.joint import Joint
from exu_press.scene.warnings import scene_warnings

__all__ = ["run_warnings", "summary"]

DEEP = 0.01
"""Penetration over radius: strains are about as large, and metals yield below that."""

WIDE = 0.5
"""Contact radius over the ball's, at which Hertz's paraboloid is 7 % flatter than the ball."""

RESIDUAL = 0.01
"""Residual over the energy exchanged, beyond which the balance casts doubt on the integration."""

ALIKE = 0.01
"""Difference of a solid, over mass, inertia and the mechanism's size, without a warning."""

CENTRED = 1e-6
"""Eccentricity ratio below which a journal starts centred; flexible bodies leave 1e-8."""

NEARLY_TOUCHING = 0.95
"""Eccentricity ratio from which a film is thinner than its law is good for."""


def summary(result: Result) -> dict[str, Any]:
    """Return a run's end, assumptions, quantities with their errors, cost and scene.

    Plain numbers, texts, lists and dictionaries.
    """
    run = Reading(result)
    figures = result.info.get("figures")
    info, values = result.info, values_of(result, run)
    declared = quantities_of(result.scene)
    costs = {name for name, placed in declared.items() if placed.quantity.kind is COST}
    return {
        "status": info["status"],
        "reason": info["reason"],
        "end_time": info["end_time"],
        "warnings": figures["warnings"] if figures else run_warnings(run),
        "assumed": assumed_values(result.scene),
        "read_from": dict(zip(("from", "to"), run.span, strict=True)),
        "quantities": {n: value.to_dict() for n, value in values.items() if n not in costs},
        "horizon": info.get("horizon"),
        "lyapunov_exponent": info.get("lyapunov_exponent"),
        "strokes": figures["strokes"] if figures else _strokes(result, run),
        "stress": info.get("stress", {}),
        "solids": info.get("solids", {}),
        "cost": {
            name.removeprefix("cost."): values[name].value for name in declared if name in costs
        },
        "own_items": info["own_items"],
        "versions": info["versions"],
        "provenance": info.get("provenance"),
        "scene": result.scene.to_dict(),
    }


def _strokes(result: Result, run: Reading) -> list[dict[str, float]]:
    instants = [centre.time for centre in run.dead_centres]
    tilts = np.interp(instants, result.time, result["slider_tilt"]).tolist()
    return [
        {
            "position": centre.position,
            "crank_angle_deg": float(np.degrees(centre.crank_angle)),
            "tilt": tilt,
        }
        for centre, tilt in zip(run.dead_centres, tilts, strict=True)
    ]


def run_warnings(run: Reading) -> list[str]:
    """Return the warnings of summary.json: about the run's quantities, then about its scene."""
    result = run.run
    texts, scene = [], result.scene
    residual = energy_residual(result)
    if result.info["own_items"]:
        texts.append("no energy balance: the energy of your own items is not known")
    if residual is not None and residual > RESIDUAL:
        texts.append(
            f"the energy balance misses {residual:.2g} of the energy: try a smaller "
            "solver.tolerance or solver.step"
        )
    for name, joint in run.result.joints.items():
        if joint.kind == "lubricated":
            film = scene.joints[name].film
            inclined = film is not None and film.law.inclination > 0.0
            nearest = joint.clearance - joint.gap if inclined else joint.distance
            ratio = float(nearest.max() / joint.clearance)
            if ratio > NEARLY_TOUCHING:
                at_end = " at an end of the bearing" if inclined else ""
                texts.append(
                    f"{name.replace('_', ' ')}: eccentricity ratio up to {ratio:.3f}{at_end}; film "
                    "laws for smooth surfaces are hardly valid there"
                )
        texts += _penetration_warnings(name, joint, scene.joints[name])
    if centred := _centred_joints(run):
        texts.append(
            f"{', '.join(centred)}: started centred, not loaded: without an equilibrium position, "
            "as the load is changing sides, the film hardly turns, or ideal joints and guides bear "
            "a part of the load. First peaks may be those of a fall; settle = 1 leaves them out"
        )
    if scene.drive is not None and scene.drive.stops and still_turns(run):
        speed = float(result["crank_speed"][-1]) * 30.0 / math.pi
        texts.append(
            f"the press does not stand behind its last stop: the crank turns at {speed:.3g} rpm at "
            "the end; try a larger drive.brake_torque, or more revolutions"
        )
    if scene.drive is not None and scene.drive.clutch is not None and result.completed:
        texts += [
            f"{command}: the run ends at {result.time[-1]:.4g} s and "
            f"{math.degrees(result['crank_angle'][-1]):.4g} deg, before the command comes; try "
            "more revolutions"
            for command in commands_to_come(run)
        ]
    return [
        *texts,
        *_lag_warnings(run),
        *oil_warnings(run),
        *slope_warnings(run),
        *_redundancy_warnings(scene),
        *_solid_warnings(result),
        *scene_warnings(scene),
    ]


def _lag_warnings(run: Reading) -> Iterator[str]:
    """Yield that a motor's crank has not turned all whole revolutions that were asked for."""
    scene = run.run.scene
    if scene.drive is None or run.starts_or_stops or not run.run.completed:
        return
    angle = run.run["crank_angle"]
    turned = float(angle[-1] - angle[0]) / (2.0 * math.pi)
    missing = whole_revolutions(scene.revolutions - scene.settle_revolutions) - run.revolutions
    if missing > 0 and turned > 0.0:
        needed = math.ceil(100.0 * scene.revolutions**2 / turned) / 100.0
        yield (
            "the motor turns the crank more slowly than speed_rpm: whole revolutions asked for "
            f"{run.revolutions + missing}, read {run.revolutions}; try revolutions = {needed:g}"
        )


def _centred_joints(run: Reading) -> list[str]:
    """Return the joints without an equilibrium position at a loaded start that figures include."""
    if run.run.scene.start != "loaded" or run.result.time[0] > run.run.time[0]:
        return []
    return [
        name.replace("_", " ")
        for name, joint in run.run.joints.items()
        if joint.kind != "ideal" and joint.distance[0] < CENTRED * joint.clearance
    ]


def _penetration_warnings(name: str, joint: JointRecord, described: Joint) -> Iterator[str]:
    """Yield a contact that is pressed in too deep for its law."""
    if not isinstance(described, DryJoint | LubricatedJoint) or described.contact is None:
        return
    depth = max(0.0, -float(joint.gap.min()))
    label, radius, clearance = name.replace("_", " "), described.radius, described.clearance
    if depth > DEEP * radius:
        yield (
            f"{label}: pressed in by up to {1e3 * depth:.3g} mm, "
            f"{100.0 * depth / radius:.3g} % of its radius; contact laws are those of small "
            "deformations: are the modulus or the stiffness of [contact], and the loads, meant so?"
        )
    wide = math.sqrt(depth * radius * (radius + clearance) / clearance)
    if described.contact.is_hertzian and wide > WIDE * radius:
        yield (
            f"{label}: pressed in by up to {1e6 * depth:.3g} um, so that the contact's radius is "
            f"{wide / radius:.2g} times the ball's; Hertz's contact is small against it, and its "
            "stiffness, of a closely fitting ball, is too small there; the cure is a "
            "contact.stiffness of your own"
        )


def _redundancy_warnings(scene: Scene) -> Iterator[str]:
    """Yield the ideal joints between which forces cannot be told apart."""
    constraints = independent_constraints(mechanism_of(scene), scene.joints.ideal)
    if constraints.keeps_redundant:
        names = ", ".join(constraints.redundant)
        yield (
            f"{names}: other ideal joints hold the same at most crank angles; the motion is right, "
            "but how joints divide the forces among them is not determined; give one of them "
            "clearance"
        )
    if constraints.undetermined:
        names = ", ".join(sorted(name.partition(".")[2] for name in constraints.undetermined))
        yield (
            f"{names}: gears and ideal joints hold the same as ideal guides, so that their forces "
            "are not determined and have no figures. The motion and the torque of the drive have. "
            "Give the guide clearance or stiffness ([guide]), or one of the joints clearance."
        )


def _solid_warnings(result: Result) -> Iterator[str]:
    """Yield differences of a flexible body's solid from the mechanism's body."""
    scene = result.scene
    mechanism = mechanism_of(scene)
    solids: Mapping[str, Mapping[str, Any]] = result.info.get("solids", {})
    for name, solid in solids.items():
        body, away = mechanism.body(name), math.hypot(*solid["centre_of_mass"])
        flywheel = 0.0 if scene.drive is None or name != mechanism.crank else scene.drive.on_crank
        differences = [
            f"{what} {solid[what]:.4g} {unit} instead of {meant:.4g}"
            for what, unit, meant in (
                ("mass", "kg", body.mass),
                ("inertia", "kg m^2", body.inertia - flywheel),
            )
            if abs(solid[what] - meant) > ALIKE * meant
        ]
        if away > ALIKE * mechanism.size:
            differences.append(f"a centre of mass {1e3 * away:.3g} mm from the mechanism's")
        if differences:
            yield (
                f"bodies.{name}: its solid has {', '.join(differences)}; the run takes the solid's"
            )
