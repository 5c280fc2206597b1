"""What is allowed but hardly meant: said, with what it changes, and not where it is usual."""

from pathlib import Path

import pytest

import exu_press
from exu_press import InputError, Scene
from exu_press.laws.film import finite, pinkus
from exu_press.mechanism import mechanism_to_dict, shipped_mechanism
from exu_press.scene.warnings import scene_warnings

FINITE = {"law": "finite"}
DRY = {"kind": "dry", "clearance": 1e-4, "radius": 0.07}


def crank(**sizes):
    return {"mechanism": "slider_crank", "joints": {}, "slider_crank": sizes}


def worn(coefficient, **more):
    wear = {"coefficient": coefficient, "hardness": 2e9, "length": 0.1, **more}
    joints = {"crank_pin": DRY}
    return {
        "mechanism": "slider_crank", "joints": joints, "contact": {"length": 0.1}, "wear": wear
    }  # fmt: skip


def readings(**given):
    return {"speed_rpm": 240.0, "revolutions": 2.0, "settle": 1.0, "output": {"readings": given}}


def pins(film=FINITE, **joints):
    return {"joints": joints, "film": film}


SLIPS = [
    ({"film": {"law": "pinkus"}}, ["'pinkus' is meant for L/D of at least 2. ", "'finite' says"]),
    ({"film": {"law": "short"}}, ["'short' is meant for L/D of 0 to 0.5. ", "'finite' says"]),
    ({"film": {"law": "short", "length": 0.6}}, ["L/D of 0 to 0.5. ", "'pi_film' says"]),
    (
        pins(crank_pin={"kind": "lubricated", "clearance": 0.05}),
        ["joints.crank_pin.clearance = 0.05 m is 0.71 times the radius of 0.07 m.",
         "Was 5e-05 m (0.05 mm) meant?"],
    ),
    ({"film": {**FINITE, "viscosity": 400.0}}, ["above 2 Pa s. ", "Was 0.4 Pa s (400 mPa s)"]),
    (
        pins(
            crank_pin={"kind": "lubricated", "radius": 0.02, "film": {"viscosity": 1e-4}},
            knuckles="lubricated",
        ),
        ["joints.crank_pin.film.viscosity = 0.0001 Pa s is below water's"],
    ),
    *(
        ({"bodies": {"linkage": {"flexible": "linkage", "youngs_modulus": modulus}}}, [words])
        for modulus, words in (
            (210000.0, "linkage.youngs_modulus = 210000 Pa is below 1e+09 Pa. "),
            (2.1e14, "linkage.youngs_modulus = 2.1e+14 Pa is above 1.2e+12 Pa. "),
        )
    ),
    (crank(crank_radius=30.0, rod_length=150.0), ["150 m large", "in mm?"]),
    (
        {"mechanism": "slider_crank", "joints": {"crank_pin": {**DRY, "radius": 40.0}}},
        ["joints.crank_pin.radius = 40 m is larger than the mechanism", "40 mm"],
    ),
    (
        {"joints": {}, "guide": {"clearance": 0.05, "length": 0.5}},
        ["guide.clearance = 0.05 m lets a body"],
    ),
    (
        {"mechanism": "scotch_yoke", "joints": {},
         "guide": {"yoke_slot": {"clearance": 5e-3, "width": 0.02}}},
        ["yoke_slot.clearance = 0.005 m lets the pin move"],
    ),
    (
        {"joints": {}, "bodies": {"linkage": {"flexible": "linkage", "density": 7.85e-9}}},
        ["density = 7.85e-09 kg/m^3 is below 100"],
    ),
    (crank(rod_mass=1.0), ["bodies.rod.mass = 1 kg is 0.00074 times that of slider", "too small"]),
    (worn(0.06), ["wear.coefficient"]),
    (worn(1e-4, joints={"crank_pin": {"coefficient": 0.06}}), ["joints.crank_pin.coefficient"]),
    ({"bodies": {"linkage": {"flexible": "linkage", "modes": 500}}}, ["takes minutes"]),
    (readings(average=[10.0]), ["average has 10 s", "has 0.25 s, so that it has no value"]),
    (readings(average_deg=[361.0]), ["average_deg has 361 deg, which reads 0.251 s at least"]),
    (readings(sampled=[7.0]), ["sampled has 7 Hz, which reads 0.286 s at least"]),
]  # fmt: skip
"""Scenes that are hardly meant, and what is said of each."""


@pytest.mark.parametrize(("scene", "words"), SLIPS)
def test_what_is_hardly_meant_is_said(scene, words):
    assert any(all(word in told for word in words) for told in scene_warnings(Scene(**scene)))


USUAL = [
    {},
    {"joints": {}},
    {"mechanism": "slider_crank", "joints": {"crank_pin": "dry"}},
    {"film": {"law": "pinkus", "length": 0.28}},
    {"film": {"law": "short", "length": 0.07}},
    *({"film": {**FINITE, "viscosity": viscosity}} for viscosity in (1e-3, 2.0)),
    {"joints": {"balls": {"kind": "dry", "clearance": 7e-4}}},
    crank(rod_mass=2.0),
    worn(0.04),
    {"bodies": {"linkage": {"flexible": "linkage", "modes": 100}}},
    readings(average=[0.25], average_deg=[360.0], sampled=[8.0]),
]


@pytest.mark.parametrize("scene", USUAL)
def test_usual_scenes_have_no_warning(scene):
    assert scene_warnings(Scene(**scene)) == []


def test_by_how_much_a_film_law_is_off():
    (warning,) = scene_warnings(Scene(film={"law": "pinkus"}))
    wide, narrow = pinkus()(0.0, 1.0, 0.0), finite(0.1 / 0.14)(0.0, 1.0, 0.0)
    assert f"resists {wide[0] / narrow[0]:.2g} times as much" in warning


def test_a_centre_of_mass_far_outside():
    drawn = mechanism_to_dict(shipped_mechanism("eccentric_press"))
    name = next(iter(drawn["bodies"]))
    drawn["bodies"][name]["centre_of_mass"] = [18.0, 0.0]
    found = scene_warnings(Scene(mechanism=drawn, joints={}))
    assert any(f"bodies.{name}.centre_of_mass lies" in w for w in found)


def test_a_mechanism_file_is_called_one(tmp_path):
    path = tmp_path / "mine.toml"
    shipped = Path(exu_press.__file__).parent / "mechanism" / "files" / "eccentric_press.toml"
    path.write_text(shipped.read_text())
    with pytest.raises(InputError, match="is a mechanism, not a scene"):
        Scene.load(path)
