"""No size of its own: a machine scaled in length, mass and time has scaled figures.

Every dimensional key is given, so that only a hidden absolute size would tell two machines apart.
Powers of two are exact, but sums of turned vectors round otherwise.
"""

import re

import pytest

from exu_press import Scene, simulate
from exu_press.scene import mechanism_of

DIMENSIONS = {  # exponents of length, mass and time
    "m": (1, 0, 0),
    "kg": (0, 1, 0),
    "s": (0, 0, 1),
    "N": (1, 1, -2),
    "Pa": (-1, 1, -2),
    "J": (2, 1, -2),
    "W": (2, 1, -3),
    "rpm": (0, 0, -1),
    "deg": (0, 0, 0),
    "rad": (0, 0, 0),
    "1": (0, 0, 0),
    "": (0, 0, 0),
}
WATCH = (2.0**-6, 2.0**-20, 2.0**-1)
SHIP = (2.0**4, 2.0**12, 2.0**3)

KEYS = {
    "speed_rpm": "rpm",
    "gravity": "m/s^2",
    "solver.min_step": "s",
    "contact.length": "m",
    "contact.modulus": "Pa",
    "contact.slowest_impact": "m/s",
    "friction.regularisation_velocity": "m/s",
    "film.length": "m",
    "film.viscosity": "Pa s",
    "guide.regularisation_velocity": "m/s",
}
SIZES = {"clearance": "m", "radius": "m"}

DRY = {
    "mechanism": "four_bar",
    "speed_rpm": 60.0,
    "revolutions": 0.12,
    "joints": {"knuckle": {"kind": "dry", "clearance": 3e-5, "radius": 0.01}},
    "contact": {"length": 0.02, "modulus": 1.1e11, "slowest_impact": 2e-4},
    "friction": {"regularisation_velocity": 1e-4},
    "solver": {"min_step": 1e-8},
}
OILED = {
    "mechanism": "slider_crank",
    "speed_rpm": 120.0,
    "revolutions": 0.12,
    "joints": {"crank_pin": {"kind": "lubricated", "clearance": 1e-4, "radius": 0.07}},
    "film": {"length": 0.1, "viscosity": 0.1},
    "guide": {"friction": "coulomb", "regularisation_velocity": 1e-3},
    "solver": {"min_step": 1e-8},
}


def factor(unit, scales):
    """Return by what a value of a unit is multiplied, as of "N s/m^2"."""
    found = 1.0
    for sign, part in zip((1, -1), [*unit.split("/"), ""][:2], strict=True):
        for name, power in re.findall(r"([A-Za-z1]+)(?:\^(\d+))?", part):
            exponents = DIMENSIONS[name]
            for scale, exponent in zip(scales, exponents, strict=True):
                found *= scale ** (sign * exponent * int(power or 1))
    return found


def scaled(keys, scales):
    """Return a scene whose lengths, masses and times are so many times as large."""
    scene = Scene(**keys)
    data = scene.to_dict()
    data["mechanism"] = Scene(mechanism=mechanism_of(scene)).to_dict()["mechanism"]
    for name in ("slider_crank", "press"):
        data.pop(name, None)
    for name, unit in KEYS.items():
        *tables, last = name.split(".")
        table = data
        for one in tables:
            table = table.get(one, {})
        if last in table:
            table[last] *= factor(unit, scales)
    for joint in data["joints"].values():
        for name in SIZES.keys() & joint.keys():
            joint[name] *= scales[0]
    drawing = data["mechanism"]
    for body in drawing["bodies"].values():
        body["mass"] *= scales[1]
        if "inertia" in body:
            body["inertia"] *= scales[1] * scales[0] ** 2
        body["centre_of_mass"] = [scales[0] * x for x in body["centre_of_mass"]]
    for joint in drawing["joints"].values():
        joint["at"] = [scales[0] * x for x in joint["at"]]
    drawing.pop("defaults", None)
    return Scene.from_dict(data)


def figures(keys, scales):
    """Return a run's errors and values by name, in the units of the machine that is not scaled."""
    run = simulate(scaled(keys, scales), errors=True, beside=False)
    assert run.completed
    found = {}
    for name, error in run.info["errors"].items():
        quantity = run.quantity(name)
        per_unit = factor(quantity.unit, scales)
        found[name] = quantity.value / per_unit, error["error"] / per_unit
    return found


@pytest.mark.parametrize(
    ("keys", "scales"),
    [
        pytest.param(DRY, WATCH, id="dry watch"),
        pytest.param(OILED, WATCH, id="oiled watch"),
        *(pytest.param(keys, SHIP, marks=pytest.mark.long) for keys in (DRY, OILED)),
    ],
)
def test_a_scaled_machine_has_scaled_figures(keys, scales):
    one, other = figures(keys, (1.0, 1.0, 1.0)), figures(keys, scales)
    assert one.keys() == other.keys()
    skipped = re.compile("mean_1ms|1khz|cost")  # windows of seconds
    for name, (value, error) in one.items():
        if not skipped.search(name):
            scaled_value, scaled_error = other[name]
            allowed = error + scaled_error + 1e-9 * abs(value)
            assert abs(scaled_value - value) <= allowed, (name, value, scaled_value, error)
