"""Warnings of a scene: values that are allowed but hardly meant, and figures they change."""

import math
from collections.abc import Iterator

import numpy as np

from exu_press.mechanism.drawing_warnings import drawing_warnings
from exu_press.scene.holding_torque import holding_torque
from exu_press.scene.joint import LubricatedJoint, TouchingJoint
from exu_press.scene.scene import Scene, mechanism_of
from exu_press.schema.table import key_values

__all__ = ["doubtful_sizes", "scene_warnings"]

NARROWEST, WIDEST = 1e-4, 1e-2
"""Radial clearance over radius; plain bearings have 0.0005 to 0.003."""

THINNEST, THICKEST = 1e-3, 2.0
"""Pa s: water, and gear oil of the thickest grade, ISO VG 1500, hardly warm."""

MANY_MODES = 100
"""100 modes of a small part take half a minute, 500 several ones."""

SOFTEST, STIFFEST = 1e9, 1.2e12
"""Pa: plastics, and diamond."""

LIGHTEST, HEAVIEST = 100.0, 25000.0
"""kg/m^3: foams, and osmium."""

LARGEST_SUPPLY = 30.0
"""Pressure of a groove around over that of the rotation, to which its film's errors are 3 %."""

MILLI = 1e-3

MOST_WEAR = 0.05
"""Archard's coefficient: mild steel on itself has 7e-3, dry (Archard 1953)."""

REACHED = 0.01
"""Part of a table's heights that the output reaches at least where they are meant in m."""


def scene_warnings(scene: Scene) -> list[str]:
    """Return warnings about values that are allowed but hardly meant: key, value, effect."""
    return [
        *doubtful_sizes(scene),
        *_film_law(scene),
        *_supply(scene),
        *_forming(scene),
        *_wear(scene),
        *_brake(scene),
        *_readings(scene),
    ]


def doubtful_sizes(scene: Scene) -> list[str]:
    """Return the warnings about sizes that may be slips of a unit."""
    return [
        *_drawing(scene),
        *_clearances(scene),
        *_guides(scene),
        *_viscosity(scene),
        *_stiffness(scene),
        *_modes(scene),
        *_heights(scene),
    ]


def _drawing(scene: Scene) -> Iterator[str]:
    """Yield parts of a drawing of another size than machines, or than the rest of it."""
    mechanism = mechanism_of(scene)
    size = mechanism.size
    yield from drawing_warnings(
        mechanism, math.inf if mechanism.output.rotation else mechanism.stroke
    )
    for name, joint in scene.joints.by_group.items():
        if isinstance(joint, TouchingJoint) and joint.radius > size:
            yield (
                f"joints.{name}.radius = {joint.radius:g} m is larger than the mechanism of "
                f"{size:.3g} m.{_slip(joint.radius, 1e-3 * size, size, 'm')}"
            )


def _guides(scene: Scene) -> Iterator[str]:
    """Yield a clearance of guides that lets their bodies tilt by degrees, or of a slot's pin."""
    wide: dict[str, tuple[float, str]] = {}
    for name, elastic in scene.guides.items():
        ways, is_slot = elastic.guideways, mechanism_of(scene).guide(name).is_slot
        if ways is None or ways.clearance <= WIDEST * ((is_slot and ways.width) or ways.length):
            continue
        tilt = math.degrees(2.0 * ways.clearance / ways.length)
        moves = f"a body in a guide of {ways.length:g} m tilt by {tilt:.2g} deg"
        if is_slot:
            moves = f"the pin move across its slot by {2.0 * ways.clearance:g} m"
        wide.setdefault(scene.guide_key(name, "clearance"), (ways.clearance, moves))
    for key, (clearance, moves) in wide.items():
        slip = _slip(clearance, 1e-6, 1e-3, "m")
        yield f"{key} = {clearance:g} m lets {moves}. Presses have some 1e-5 m.{slip}"


def _clearances(scene: Scene) -> Iterator[str]:
    for name, joint in scene.joints.by_group.items():
        if not isinstance(joint, TouchingJoint):
            continue
        clearance, radius = joint.clearance, joint.radius
        film = isinstance(joint, LubricatedJoint)
        changes = "A film's force falls with its square." if film else "Impacts grow with it."
        if clearance > WIDEST * radius:
            yield (
                f"joints.{name}.clearance = {clearance:g} m is {clearance / radius:.2g} times the "
                f"radius of {radius:g} m. Plain bearings have 0.0005 to 0.003 times. {changes}"
                + _slip(clearance, NARROWEST * radius, WIDEST * radius, "m")
            )


def _films(scene: Scene) -> Iterator[tuple[str, LubricatedJoint]]:
    """Yield every lubricated joint, after the beginning of its film's keys."""
    for name, joint in scene.joints.by_group.items():
        if isinstance(joint, LubricatedJoint):
            shared = scene.film or {}
            keys = key_values(joint.film)
            own = any(value not in (None, shared.get(name)) for name, value, _ in keys)
            yield f"joints.{name}.film" if own else "film", joint


def _viscosity(scene: Scene) -> Iterator[str]:
    films = {
        f"{table}.{'viscosity' if joint.film.oil is None else 'oil has as supplied'}": (
            joint.film.cold_viscosity
        )
        for table, joint in _films(scene)
    }
    for name, guide in scene.guides.items():
        if guide.oil is not None:
            films[scene.guide_key(name, "viscosity")] = guide.oil.viscosity
    for key, viscosity in films.items():
        if text := _outside(key, viscosity, (THINNEST, THICKEST), "Pa s", "water's "):
            yield (
                f"{text}. Bearing oils in use have 0.005 to 1, honey has 10 and air 2e-5. Force "
                "and drag of the film are in proportion to it."
                + _slip(viscosity, THINNEST, THICKEST, "Pa s")
            )


def _stiffness(scene: Scene) -> Iterator[str]:
    for name, body in scene.bodies.items():
        path = f"bodies.{name}"
        if text := _outside(f"{path}.density", body.density, (LIGHTEST, HEAVIEST), "kg/m^3"):
            yield f"{text}; steel has 7850. In t/mm^3 it would be 7.85e-9."
        modulus = body.youngs_modulus
        if text := _outside(f"{path}.youngs_modulus", modulus, (SOFTEST, STIFFEST), "Pa"):
            yield (
                f"{text}. Plastics have 1e9, steel has 2.1e11 and diamond 1.05e12. Deflections are "
                "in proportion to its inverse."
            )


def _modes(scene: Scene) -> Iterator[str]:
    """Yield numbers of modes that take minutes to compute."""
    for name, body in scene.bodies.items():
        if body.modes is not None and body.modes > MANY_MODES:
            yield (
                f"bodies.{name}.modes = {body.modes} takes minutes to compute, and shorter steps. "
                f"bodies.{name}.flexibility_error = 0.01 takes as many modes as its loads need."
            )


def _heights(scene: Scene) -> Iterator[str]:
    """Yield tables over heights that the output never has, but for a small part."""
    mechanism = mechanism_of(scene)
    for name, load in scene.applied_loads.items():
        if load.over != "height":
            continue
        low, high, stroke = load.curve.places[0], load.curve.places[-1], mechanism.stroke
        if min(high, stroke) - max(low, 0.0) < REACHED * (high - low):
            yield (
                f"load.{name}.height from {low:g} to {high:g} m: the output is between 0 and "
                f"{stroke:.4g} m above bottom dead centre. Beyond the table its first or last "
                f"force goes on.{_slip(high, 1e-3 * stroke, stroke, 'm')}"
            )


def _wear(scene: Scene) -> Iterator[str]:
    """Yield coefficients of wear that no pair of metals has."""
    if scene.wear is None:
        return
    coefficients: dict[str, float | None] = {"wear": scene.wear.coefficient}
    for kind, tables in (("joints", scene.wear.joints), ("guides", scene.wear.guides)):
        coefficients |= {
            f"wear.{kind}.{n}": t.get("coefficient") for n, t in (tables or {}).items()
        }
    for table_name, coefficient in coefficients.items():
        if coefficient is not None and coefficient > MOST_WEAR:
            yield (
                f"{table_name}.coefficient = {coefficient:g} is above {MOST_WEAR:g}. Steel on "
                "steel has 7e-3 dry and 1e-6 to 1e-4 greased: is it a coefficient over the "
                "hardness, 1/Pa?"
            )


def _brake(scene: Scene) -> Iterator[str]:
    """Yield a brake that weights, and forces over the height, turn at some crank angle."""
    motor = scene.drive
    brake = None if motor is None or motor.clutch is None else motor.clutch.brake
    if brake is None:
        return
    mechanism, angle = mechanism_of(scene), np.linspace(0.0, 2.0 * math.pi, 361)
    height = mechanism.ideal_slider(angle, 1.0)[0] - mechanism.bottom
    forces = {
        name: np.array([load.curve(height_there) for height_there in height.tolist()])
        for name, load in scene.applied_loads.items()
        if load.over == "height" and load.fade is None
    }
    torque = holding_torque(mechanism, scene, forces, angle)
    worst = int(np.argmax(np.abs(torque)))
    if abs(torque[worst]) > brake.brake_torque:
        yield (
            f"drive.brake_torque = {brake.brake_torque:g} N m does not hold the press at every "
            f"angle: weights and springs turn it with {abs(float(torque[worst])):.4g} N m at "
            f"{math.degrees(angle[worst]):.0f} deg"
        )


def _forming(scene: Scene) -> Iterator[str]:
    """Yield forces that act while the output closes, and help it."""
    output = mechanism_of(scene).output
    for name, load in scene.applied_loads.items():
        if load.fade is None or load.body != output.body:
            continue
        along = sum(a * b for a, b in zip(load.direction, output.direction, strict=True))
        if max(force * along for force in load.curve.forces) <= 0.0:
            yield (
                f"load.{name} acts while the output closes, and pushes the way it goes: it puts "
                "energy in. A forming force is positive in the output's direction."
            )


def _readings(scene: Scene) -> Iterator[str]:
    """Yield readings that are longer than the record, whose length a schedule decides else."""
    readings = None if scene.output is None else scene.output.readings
    if readings is not None and not (scene.drive is not None and scene.drive.has_schedule):
        yield from readings.too_long(scene.revolutions - scene.settle_revolutions, scene.speed_rpm)


def _outside(
    key: str, value: float | None, usual: tuple[float, float], unit: str, lowest: str = ""
) -> str:
    """Return that a key's value is outside a usual range, or nothing."""
    low, high = usual
    if value is None or low <= value <= high:
        return ""
    side = f"below {lowest}{low:g}" if value < low else f"above {high:g}"
    return f"{key} = {value:g} {unit} is {side} {unit}"


def _slip(value: float, low: float, high: float, unit: str) -> str:
    """Return the question whether thousandths of the unit were meant, where that makes sense."""
    meant = MILLI * value
    return f" Was {meant:g} {unit} ({value:g} m{unit}) meant?" if low <= meant <= high else ""


def _film_law(scene: Scene) -> Iterator[str]:
    """Yield film laws that are not meant for their bearing's width, and how far they are off."""
    films = [*_films(scene)]
    if not films:
        return
    from exu_press.scene.film import FILMS, JournalFilm  # loaded by these joints

    for table, joint in films:
        if not isinstance(joint.film, JournalFilm):
            continue
        ratio, law = joint.film.length / (2.0 * joint.radius), joint.film.law
        if law.suits(ratio):
            continue
        low, high = law.length_to_diameter
        meant = f"at least {low:g}" if high == math.inf else f"{low:g} to {high:g}"
        better = next(
            film for name in ("finite", "short", "pi_film") if (film := FILMS[name]()).suits(ratio)
        )
        centred = (0.0, 1.0, 0.0)
        off = law.film(ratio)(*centred)[0] / better.film(ratio)(*centred)[0]
        yield (
            f"{table}.law = {law.kind!r} is meant for L/D of {meant}. This bearing has "
            f"{ratio:.2g}: near its centre the film resists {off:.2g} times as much as "
            f"{table}.law = {better.kind!r} says. The eccentricity ratio comes out too small by a "
            "factor of that order, and the film too thick."
        )


def _supply(scene: Scene) -> Iterator[str]:
    """Yield pressures in grooves all around beside which the film's force is not exact."""
    for table, joint in _films(scene):
        pressure = joint.film.law.ring_pressure
        slenderness = joint.radius / joint.clearance
        of_rotation = 12.0 * joint.film.cold_viscosity * slenderness**2 * scene.angular_speed
        if pressure > LARGEST_SUPPLY * of_rotation:
            yield (
                f"{table}.grooves.pressure = {pressure:g} Pa is {pressure / of_rotation:.2g} times "
                f"12 mu (R/c)^2 omega = {of_rotation:.2g} Pa, the pressure that rotation makes. A "
                "groove all around bears next to nothing by its pressure: from "
                f"{LARGEST_SUPPLY:g} times on, the film's force is off by more than 3 %"
            )
