"""The [guide] table, the load's eccentricity and the counterweight's switch."""

import pickle

import pytest

from exu_press import InputError, Scene
from exu_press.laws.contact import delivered_restitution, hertz
from exu_press.scene import mechanism_of, parse_assignment
from exu_press.scene.assumptions import assumed_values

IDEAL = {"mechanism": "slider_crank", "joints": {}}
LOOSE = {"clearance": 2e-5, "length": 0.3}


def test_absent_means_ideal():
    scene = Scene()
    assert scene.guide is None
    assert "guide" not in scene.to_dict()


def test_an_empty_table_means_defaults():
    scene = Scene(guide={"lateral_stiffness": 1e9})
    assert scene.guide.support.lateral_stiffness == 1e9
    assert Scene.from_dict(scene.to_dict()) == scene


def test_on_and_off_by_replace():
    scene = Scene().replace({"guide.lateral_stiffness": 2e8})
    assert scene.guide.support.lateral_stiffness == 2e8
    assert scene.guide.support.length == 0.5
    assert scene.replace({"guide": None}) == Scene()
    other = scene.replace({"guide": None, "mechanism": "slider_crank"})
    assert other == Scene(mechanism="slider_crank")


def test_on_the_command_line():
    found = Scene().replace(dict([parse_assignment("guide={lateral_stiffness=2e9}")])).guide
    assert found == Scene(guide={"lateral_stiffness": 2e9}).guide


def test_a_table_that_asks_for_nothing_is_refused():
    with pytest.raises(InputError, match=r"\[guide\] has neither lateral_stiffness nor clearance"):
        Scene(guide={})
    with pytest.raises(InputError, match=r"\[guide\] has neither lateral_stiffness nor clearance"):
        Scene(guide={"friction": "none", "length": 0.3})


def test_without_stiffness_guides_stay_ideal_and_rub():
    scene = Scene(guide={"friction": "coulomb"})
    assert not scene.guide.soft
    assert mechanism_of(scene) == mechanism_of(Scene())
    said = "guide.mu_kinetic = 0.1 (hard steel on hard steel with turbine oil"
    assert any(line.startswith(said) for line in assumed_values(scene))
    assert Scene.from_dict(scene.to_dict()) == scene
    with pytest.raises(
        InputError, match=r"guide\.length = 0\.3: not used .*nor guide\.lateral_stiffness is"
    ):
        Scene(guide={"friction": "coulomb", "length": 0.3})


def test_an_assumed_stiffness_is_said():
    assert "guide.lateral_stiffness = 1e+09 N/m (assumed)" in assumed_values(Scene(guide=LOOSE))
    given = Scene(guide={**LOOSE, "lateral_stiffness": 2e9})
    assert not any("lateral_stiffness" in line for line in assumed_values(given))


def test_what_friction_and_damping_of_guides_need_is_in_the_scenes_tables():
    rubbing = {**IDEAL, "guide": {"friction": "lugre"}}
    scene = Scene.from_dict({**rubbing, "friction": {"sigma_0": 2e4}})
    assert scene.friction["sigma_0"] == 2e4
    assert "law" not in scene.friction
    assert Scene.from_dict(scene.to_dict()) == scene
    assert scene.guide.friction_table(scene.friction).friction().sigma_0 == 2e4
    with pytest.raises(
        InputError, match=r"friction\.mu_kinetic = 0\.2: not used .*guides do not us"
    ):
        Scene.from_dict({**rubbing, "friction": {"mu_kinetic": 0.2}})
    with pytest.raises(InputError, match=r"\[friction\]: not used .*no joint is 'dry'"):
        Scene.from_dict({**IDEAL, "guide": {"friction": "coulomb"}, "friction": {"sigma_0": 2e4}})
    damped = Scene.from_dict({**IDEAL, "guide": LOOSE, "contact": {"restitution": 0.5}})
    assert damped.contact["damping"] == "hu_guo"
    assert damped.contact.keys() == {"damping", "restitution", "tension"}
    contact = damped.guide.contact(damped.contact)
    law = contact.normal_contact(hertz(1e8, 1.0), LOOSE["clearance"], damped.angular_speed)
    assert delivered_restitution(law, 10.0, 0.1) == pytest.approx(0.5, abs=0.02)
    with pytest.raises(InputError, match=r"contact\.modulus = 1e\+?11|contact\.modulus = 1000"):
        Scene.from_dict({**IDEAL, "guide": LOOSE, "contact": {"modulus": 1e11}})
    with pytest.raises(InputError, match=r"guide\.clearance needs contact\.damping_max"):
        Scene.from_dict({**IDEAL, "guide": LOOSE, "contact": {"damping": "step"}})


@pytest.mark.parametrize(
    ("scene", "message"),
    [
        ({"guide": {"stiffness": 1.0}}, r"guide\.stiffness = 1\.0: unknown key"),
        ({"guide": {"lateral_stiffness": 0.0}}, r"guide\.lateral_stiffness = 0\.0: allowed .* > 0"),
        (
            {"guide": {"lateral_stiffness": 1e9, "damping_ratio": -0.1}},
            r"guide\.damping_ratio = -0\.1: allowed .* >= 0",
        ),
        ({"guide": 1e9}, r"guide = 1000000000\.0: allowed is a table"),
        (
            {"mechanism": "slider_crank", "guide": {"slide_inertia": 1.0}},
            r"guide\.slide_inertia = 1\.0: is press\.slide_inertia now",
        ),
        (
            {"press": {"counterweight": False, "counterweight_mass": 900.0}},
            r"press\.counterweight_mass = 900\.0: not used .* \(press\.counterweight is false",
        ),
        (
            {"press": {"counterweight": False, "counterweight_inertia": 9.0}},
            r"press\.counterweight_inertia = 9\.0: not used .* \(press\.counterweight is false",
        ),
        ({"press": {"counterweight": 0}}, r"press\.counterweight = 0: allowed is true or false"),
    ],
)
def test_what_is_refused(scene, message):
    with pytest.raises(InputError, match=message) as caught:
        Scene.from_dict(scene)
    assert "\n" not in str(caught.value)


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
