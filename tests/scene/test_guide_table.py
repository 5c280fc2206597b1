"""The [guide] table, the load's eccentricity and the counterweight's switch."""

import pickle

import pytest

from exu_press import InputError, Scene
from exu_press.laws.contact import delivered_restitution, hertz
from exu_press.quantities.units import unit_of
from exu_press.scene import mechanism_of
from exu_press.scene.assumptions import assumed_values
from exu_press.schema.table import key_values

IDEAL = {"mechanism": "slider_crank", "joints": {}}
LOOSE = {"clearance": 2e-5, "length": 0.3}


def test_on_and_off_by_replace():
    scene = Scene().replace({"guide.lateral_stiffness": 2e8})
    assert scene.guide.support.lateral_stiffness == 2e8
    assert scene.guide.support.length == 0.5
    assert scene.replace({"guide": None}) == Scene()
    other = scene.replace({"guide": None, "mechanism": "slider_crank"})
    assert other == Scene(mechanism="slider_crank")


def test_without_stiffness_guides_stay_ideal_and_rub():
    scene = Scene(guide={"friction": "coulomb"})
    assert not scene.guide.soft
    assert mechanism_of(scene) == mechanism_of(Scene())
    said = "guide.mu_kinetic = 0.1 (hard steel on hard steel with turbine oil"
    assert any(line.startswith(said) for line in assumed_values(scene))
    assert Scene.from_dict(scene.to_dict()) == scene


def test_an_assumed_stiffness_is_said():
    assert "guide.lateral_stiffness = 1e+09 N/m (estimated: 1 um per kN)" in assumed_values(
        Scene(guide=LOOSE)
    )
    given = Scene(guide={**LOOSE, "lateral_stiffness": 2e9})
    assert not any("lateral_stiffness" in line for line in assumed_values(given))


def test_what_friction_and_damping_of_guides_need_is_in_the_scenes_tables():
    rubbing = {**IDEAL, "guide": {"friction": "lugre"}}
    scene = Scene.from_dict({**rubbing, "friction": {"sigma_0": 2e4}})
    assert scene.friction["sigma_0"] == 2e4
    assert "law" not in scene.friction
    assert Scene.from_dict(scene.to_dict()) == scene
    assert scene.guide.friction_table(scene.friction).friction().sigma_0 == 2e4
    damped = Scene.from_dict({**IDEAL, "guide": LOOSE, "contact": {"restitution": 0.5}})
    assert damped.contact["damping"] == "hu_guo"
    assert damped.contact.keys() == {"damping", "restitution", "tension"}
    contact = damped.guide.contact(damped.contact)
    law = contact.normal_contact(hertz(1e8, 1.0), LOOSE["clearance"], damped.angular_speed)
    assert delivered_restitution(law, 10.0, 0.1) == pytest.approx(0.5, abs=0.02)


def test_a_press_that_loses_its_counterweight_loses_its_keys():
    scene = Scene(press={"counterweight_mass": 900.0, "counterweight_inertia": 9.0})
    bare = scene.replace({"press.counterweight": False})
    assert bare == Scene(press={"counterweight": False})
    with pytest.raises(InputError, match="counterweight_mass"):
        bare.replace({"press.counterweight_mass": 900.0})


def test_a_scene_with_rubbing_guides_gets_to_another_process():
    """The keys of its law are of a class that is made when the law is."""
    scene = Scene(joints={}, guide={"friction": "stribeck", "mu_kinetic": 0.08, "mu_static": 0.1})
    assert pickle.loads(pickle.dumps(scene)) == scene


MIXED = {
    "lateral_stiffness": 5e8,
    "slide": {"kind": "ideal"},
    "plunger_left": {"clearance": 3e-5, "friction": "coulomb"},
    "counterweight": {"length": 0.8},
}
"""[guide], and tables of three of the press' guides."""


def test_a_guides_own_table_has_its_keys_over_those_of_all(tmp_path):
    scene = Scene(guide=MIXED, contact={"damping": "hu_guo", "restitution": 0.5})
    assert {name: guide.kind for name, guide in scene.guides.items()} == {
        "plunger_left": "dry",
        "plunger_right": "elastic",
        "slider": "elastic",
        "counterweight": "elastic",
    }
    assert scene.guides["counterweight"].support.lateral_stiffness == 5e8
    assert scene.guides["counterweight"].support.length == 0.8
    assert scene.guides["plunger_left"].rubs
    assert not scene.guides["plunger_right"].rubs
    said = assumed_values(scene)
    assert any(line.startswith("guide.plunger_left.mu_kinetic = 0.1 (hard steel") for line in said)
    assert Scene.from_dict(scene.to_dict()) == scene
    scene.save(tmp_path / "scene.toml", comments=True)
    assert Scene.load(tmp_path / "scene.toml") == scene
    assert pickle.loads(pickle.dumps(scene)).guides == scene.guides
    assert unit_of("guide.plunger_left.clearance") == "m"


def test_a_key_that_the_only_guide_has_itself_is_used_no_more():
    """A file that gave it would be refused: what the change itself does not name is dropped."""
    shared = {"clearance": 2e-5, "length": 0.3, "width": 0.1}
    scene = Scene(mechanism="slider_crank", joints={}, guide=shared)
    changed = scene.replace({"guide.slider.length": 0.2})
    assert changed.guides["slider"].support.length == 0.2
    assert changed.to_dict()["guide"]["slider"] == {"length": 0.2}
    assert Scene.from_dict(changed.to_dict()) == changed


def test_own_tables_are_changed_as_other_keys(tmp_path):
    scene = Scene(guide=MIXED)
    changed = scene.replace({"guide.lateral_stiffness": 7e8, "guide.plunger_left.clearance": 5e-5})
    assert changed.guides["counterweight"].support.lateral_stiffness == 7e8
    assert changed.guides["plunger_left"].clearance == 5e-5
    elastic = scene.replace({"guide.plunger_left.lateral_stiffness": 1e8})
    assert elastic.guides["plunger_left"].kind == "elastic"
    assert elastic.guides["plunger_left"].rubs
    without = scene.replace({"guide.plunger_left": None})
    assert without == Scene(guide={k: v for k, v in MIXED.items() if k != "plunger_left"})
    frictionless = scene.replace({"guide.plunger_left.friction": None})
    assert not frictionless.guides["plunger_left"].rubs
    own = {"lateral_stiffness": 1e9, "yoke_slot": {"kind": "ideal"}}
    assert Scene(mechanism="scotch_yoke", guide=own).guides.keys() == {"yoke"}
    alone = Scene(guide={"plunger_left": {"clearance": 3e-5}})
    assert alone.guides.keys() == {"plunger_left"}
    assert alone.replace({"mechanism": "slider_crank"}).guide is None
    scene.save(tmp_path / "scene.toml")
    loaded = Scene.load(tmp_path / "scene.toml", ["guide.counterweight.length=0.9"])
    assert loaded.guides["counterweight"].support.length == 0.9


OILED = {"clearance": 1e-4, "viscosity": 0.1, "face_width": 0.1, "contact_gap": 2e-6}


@pytest.mark.parametrize(
    ("shared", "own", "kept"),
    [
        (OILED, {"clearance": 5e-5}, "viscosity"),
        ({"clearance": 1e-4, "length": 0.3}, {"lateral_stiffness": 2e9}, "length"),
        (
            {"friction": "coulomb", "mu_kinetic": 0.2},
            {"friction": "stribeck", "mu_static": 0.3},
            "mu_kinetic",
        ),
    ],
)
def test_a_key_that_others_of_all_guides_need_is_used_where_each_has_its_own(shared, own, kept):
    scene = Scene.from_dict({**IDEAL, "guide": shared})
    changed = scene.replace({f"guide.slider.{name}": value for name, value in own.items()})
    assert changed == Scene.from_dict({**IDEAL, "guide": {**shared, "slider": own}})
    of_slider = {name: value for name, value, _ in key_values(changed.guides["slider"])}
    assert of_slider[kept] == shared[kept]
