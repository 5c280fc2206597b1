"""What is allowed but hardly meant: said, with what it changes, and not where it is usual."""

import re
from pathlib import Path

import pytest

import exu_press
from exu_press import InputError, Scene, simulate
from exu_press.laws.film import finite, pinkus
from exu_press.mechanism import mechanism_to_dict, shipped_mechanism
from exu_press.scene.warnings import doubtful_sizes, scene_warnings

FINITE = {"law": "finite"}


def test_usual_scenes_have_none():
    assert scene_warnings(Scene()) == []
    assert scene_warnings(Scene(joints={})) == []
    assert scene_warnings(Scene(mechanism="slider_crank", joints={"crank_pin": "dry"})) == []


@pytest.mark.parametrize(
    ("film", "meant", "instead"),
    [
        ({"law": "pinkus"}, "at least 2", "finite"),
        ({"law": "pi_film", "length": 0.0139}, "at least 2", "short"),
        ({"law": "short"}, "0 to 0.5", "finite"),
        ({"law": "short", "length": 0.6}, "0 to 0.5", "pi_film"),
    ],
)
def test_a_film_law_outside_its_width(film, meant, instead):
    (warning,) = scene_warnings(Scene(film=film))
    assert f"film.law = {film['law']!r} is meant for L/D of {meant}. " in warning
    assert f"film.law = {instead!r} says" in warning


@pytest.mark.parametrize(
    "film", [{"law": "pinkus", "length": 0.28}, {"law": "short", "length": 0.07}]
)
def test_a_film_law_within_its_width(film):
    assert scene_warnings(Scene(film=film)) == []


def test_by_how_much_a_film_law_is_off():
    (warning,) = scene_warnings(Scene(film={"law": "pinkus"}))
    wide, narrow = pinkus()(0.0, 1.0, 0.0), finite(0.1 / 0.14)(0.0, 1.0, 0.0)
    assert f"resists {wide[0] / narrow[0]:.2g} times as much" in warning


def test_a_clearance_in_millimetres():
    pin = {"kind": "lubricated", "clearance": 0.05}
    scene = Scene(
        film=FINITE, joints={"crank_pin": pin, "balls": {"kind": "dry", "clearance": 7e-4}}
    )
    (warning,) = scene_warnings(scene)
    assert warning.startswith(
        "joints.crank_pin.clearance = 0.05 m is 0.71 times the radius of 0.07 m."
    )
    assert warning.endswith("Was 5e-05 m (0.05 mm) meant?")


def test_a_clearance_that_is_no_slip_of_units():
    (warning,) = scene_warnings(Scene(joints={"balls": {"kind": "dry", "clearance": 1e-3}}))
    assert "joints.balls.clearance = 0.001 m" in warning and "meant?" not in warning


@pytest.mark.parametrize(
    ("viscosity", "words"),
    [
        (400.0, "above 2 Pa s. .* Was 0.4 Pa s (400 mPa s) meant?"),
        (1e-5, "below water's 0.001 Pa s. "),
    ],
)
def test_a_viscosity_of_honey_or_air(viscosity, words):
    (warning,) = scene_warnings(Scene(film={**FINITE, "viscosity": viscosity}))
    assert all(part in warning for part in words.split(".*"))


@pytest.mark.parametrize("viscosity", [1e-3, 2.0])
def test_oils_at_the_limits_are_usual(viscosity):
    assert doubtful_sizes(Scene(film={**FINITE, "viscosity": viscosity})) == []


def test_advice_after_a_stop_names_the_slip_and_no_thicker_oil():
    joints = {"crank_pin": {"kind": "lubricated", "clearance": 0.05}, "balls": "dry"}
    film = {"law": "pinkus", "viscosity": 1e-5}
    result = simulate(Scene(film=film, joints=joints, solver={"step": 1e-4}))
    assert result.info["status"] == "film broke down"
    slips = "joints.crank_pin.clearance = 0.05 m is .*; film.viscosity = 1e-05 Pa s is below water"
    assert re.search(f"try another value.*: {slips}", result.info["reason"])
    assert "larger film.viscosity" not in result.info["reason"]


def test_a_joint_with_a_film_of_its_own_is_named():
    film = {"law": "short", "viscosity": 1e-4}
    pin = {"kind": "lubricated", "radius": 0.02, "film": film}
    oil, law = scene_warnings(
        Scene(film=FINITE, joints={"crank_pin": pin, "knuckles": "lubricated"})
    )
    assert oil.startswith("joints.crank_pin.film.viscosity = 0.0001 Pa s is below water's")
    assert law.startswith("joints.crank_pin.film.law = 'short' is meant for L/D of 0 to 0.5. ")


@pytest.mark.parametrize(("given", "side"), [(210000.0, "below 1e+09"), (2.1e14, "above 1.2e+12")])
def test_a_youngs_modulus_in_megapascals(given, side):
    body = {"flexible": "linkage", "youngs_modulus": given}
    (warning,) = scene_warnings(Scene(bodies={"linkage": body}))
    assert warning.startswith(f"bodies.linkage.youngs_modulus = {given:g} Pa is {side} Pa. ")


def crank(**sizes):
    return Scene(mechanism="slider_crank", joints={}, slider_crank=sizes)


def test_a_drawing_in_millimetres():
    scene = crank(crank_radius=30.0, rod_length=150.0)
    (warning,) = (w for w in scene_warnings(scene) if "in mm?" in w)
    assert "150 m large" in warning


def test_a_journal_larger_than_its_mechanism():
    pin = {"kind": "dry", "radius": 40.0, "clearance": 1e-4}
    found = scene_warnings(Scene(mechanism="slider_crank", joints={"crank_pin": pin}))
    assert any("joints.crank_pin.radius = 40 m is larger than the mechanism" in w for w in found)
    assert any("40 mm" in w for w in found)


def test_a_centre_of_mass_far_outside():
    drawn = mechanism_to_dict(shipped_mechanism("eccentric_press"))
    name = next(iter(drawn["bodies"]))
    drawn["bodies"][name]["centre_of_mass"] = [18.0, 0.0]
    found = scene_warnings(Scene(mechanism=drawn, joints={}))
    assert any(f"bodies.{name}.centre_of_mass lies" in w for w in found)


def test_a_stroke_of_millimetres():
    """The ram hangs on a pin 2 mm off the shaft, a counterweight on one 0.11 m off."""
    rod = {"mass": 5.0}
    drawn = {
        "name": "short stroke",
        "crank": "crank",
        "output": {"body": "ram", "direction": [0, 1]},
        "bodies": {
            "crank": {"centre_of_mass": [0.0, 0.0], "mass": 20.0, "inertia": 0.1},
            "rod": {**rod, "centre_of_mass": [0.0, -0.15]},
            "ram": {"centre_of_mass": [0.0, -0.3], "mass": 50.0, "inertia": 1.0},
            "upper_rod": {**rod, "centre_of_mass": [0.0, 0.35]},
            "weight": {"centre_of_mass": [0.0, 0.6], "mass": 30.0, "inertia": 0.5},
        },
        "joints": {
            "shaft": {"at": [0.0, 0.0], "journal": "crank", "bearing": "frame"},
            "pin": {"at": [0.0, 0.002], "journal": "crank", "bearing": "rod"},
            "wrist": {"at": [0.0, -0.3], "journal": "ram", "bearing": "rod"},
            "upper_pin": {"at": [0.0, 0.11], "journal": "crank", "bearing": "upper_rod"},
            "upper_wrist": {"at": [0.0, 0.6], "journal": "weight", "bearing": "upper_rod"},
        },
        "guides": {"ram": {"direction": [0, 1]}, "weight": {"direction": [0, 1]}},
    }
    warnings = scene_warnings(Scene(mechanism=drawn, joints={}))
    assert any("moves 4 mm only" in warning for warning in warnings)


def test_a_guide_wider_than_a_ram_and_a_density_in_tonnes():
    loose = Scene(joints={}, guide={"clearance": 0.05, "length": 0.5})
    assert any("guide.clearance = 0.05 m lets a body" in w for w in scene_warnings(loose))
    pin = {"yoke_slot": {"clearance": 5e-3, "width": 0.02}}
    slot = Scene(mechanism="scotch_yoke", joints={}, guide=pin)
    assert any("yoke_slot.clearance = 0.005 m lets the pin move" in w for w in scene_warnings(slot))
    part = {"flexible": "linkage", "density": 7.85e-9}
    heavy = Scene(joints={}, bodies={"linkage": part})
    assert any("density = 7.85e-09 kg/m^3 is below 100" in w for w in scene_warnings(heavy))


def test_a_mechanism_file_is_called_one(tmp_path):
    path = tmp_path / "mine.toml"
    shipped = Path(exu_press.__file__).parent / "mechanism" / "files" / "eccentric_press.toml"
    path.write_text(shipped.read_text())
    with pytest.raises(InputError, match="is a mechanism, not a scene"):
        Scene.load(path)


@pytest.mark.parametrize(("mass", "warns"), [(1.0, True), (2.0, False)])
def test_a_body_that_is_a_thousand_times_lighter_than_another(mass, warns):
    found = [w for w in scene_warnings(crank(rod_mass=mass)) if "too small for steps" in w]
    assert bool(found) == warns
    assert all(
        w.startswith("bodies.rod.mass = 1 kg is 0.00074 times that of slider") for w in found
    )


@pytest.mark.parametrize(("coefficient", "warns"), [(0.04, False), (0.06, True)])
def test_a_coefficient_of_wear_that_no_pair_of_metals_has(coefficient, warns):
    pin = {"kind": "dry", "clearance": 1e-4, "radius": 0.07}
    scene = Scene(
        mechanism="slider_crank",
        joints={"crank_pin": pin},
        contact={"length": 0.1},
        wear={"coefficient": coefficient, "hardness": 2e9, "length": 0.1},
    )
    assert any("wear.coefficient" in text for text in scene_warnings(scene)) == warns
    key = "wear.joints.crank_pin.coefficient"
    there = scene.replace({"wear.coefficient": 1e-4, key: coefficient})
    assert any(key in text for text in scene_warnings(there)) == warns


@pytest.mark.parametrize(("modes", "warns"), [(100, False), (500, True)])
def test_modes_by_the_hundred_are_said_to_take_minutes(modes, warns):
    scene = Scene(bodies={"linkage": {"flexible": "linkage", "modes": modes}})
    assert any("takes minutes" in text for text in scene_warnings(scene)) == warns
