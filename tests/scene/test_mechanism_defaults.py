"""The paper's numbers rule its press alone; others have engineering values: what is assumed."""

import dataclasses
import math

import pytest

from exu_press import InputError, Scene
from exu_press.laws.contact import hertz_stiffness
from exu_press.mechanism import mechanism_from_dict, mechanism_lines, shipped_mechanism
from exu_press.mechanism.press import TABLE_2
from exu_press.scene.assumptions import assumed_line, assumed_values, used_assumptions
from exu_press.studies.compare import variants

FOUR_BAR = shipped_mechanism("four_bar")
PIN = {"kind": "dry", "radius": 0.02, "clearance": 2e-5}
OIL = {"viscosity": 0.1, "length": 0.02}


def scene(**given):
    keys = {"joints": {"knuckle": PIN}, "contact": {"length": 0.02}, **given}
    return Scene(**{"mechanism": "four_bar", **keys})


def test_the_paper_rules_its_press():
    press = Scene(joints={"crank_pin": "dry"})
    for law in ("contact", "friction"):
        used = {key: v for key, v in getattr(press, law).items() if key in TABLE_2[law]}
        assert used and used.items() <= TABLE_2[law].items()
    assert Scene().film["viscosity"] == 0.4
    assert Scene(contact={"damping": "flores"}).contact["restitution"] == 0.5
    asked = Scene(friction={"mu_static": 0.1, "mu_kinetic": 0.1}).friction
    assert asked["mu_kinetic"] == 0.1, "what is given counts although it is a general default"
    assert Scene(contact={"damping": "flores", "restitution": 0.9}).contact["restitution"] == 0.9


def test_a_ball_has_the_stiffness_of_its_sizes():
    """1/R = 1/0.03 - 1/0.0301 m, steel on steel."""
    press = Scene(
        mechanism="eccentric_press",
        joints={"balls": {"kind": "dry", "radius": 0.03, "clearance": 1e-4}},
    )
    law = press.joints["ball_left"].normal_contact(1.0)
    expected = hertz_stiffness(1.0 / (1.0 / 0.03 - 1.0 / 0.0301), 210e9 / (2 * (1 - 0.3**2)))
    assert law.stiffness.force(1e-6)[0] == pytest.approx(expected * 1e-9, rel=1e-4)
    with pytest.raises(InputError, match=r"contact.exponent = 2.0: .* allowed is 1.5"):
        scene(contact={"exponent": 2.0, "shape": "point"})


def test_a_mechanism_file_gives_sizes_and_laws_for_all_its_scenes(tmp_path):
    defaults = {"radius": 0.02, "clearance": 2e-5, "contact": {"length": 0.02}}
    own = dataclasses.replace(FOUR_BAR, defaults=defaults)
    (tmp_path / "bar.toml").write_text("\n".join(mechanism_lines(own)))
    (tmp_path / "scene.toml").write_text('mechanism = "bar.toml"\njoints.knuckle = "dry"\n')
    loaded = Scene.load(tmp_path / "scene.toml")
    assert loaded.mechanism == own
    assert loaded.joints["knuckle"] == scene().joints["knuckle"]
    assert Scene.from_dict(loaded.to_dict()) == loaded
    given = Scene(mechanism=own, joints={"knuckle": {"kind": "dry", "clearance": 5e-5}})
    assert given.joints["knuckle"].clearance == 5e-5


def test_a_law_that_there_is_not_is_refused_where_no_joint_has_it():
    own = dataclasses.replace(FOUR_BAR, defaults={"film": {"law": "nope"}})
    with pytest.raises(InputError, match=r"^defaults\.film\.law = 'nope': allowed is one of"):
        Scene(mechanism=own)


@pytest.mark.parametrize(
    ("defaults", "message"),
    [
        ({"clearanc": 1e-5}, r"defaults.clearanc = 1e-05: unknown key \(did you mean 'clearance'"),
        ({"film": 3}, "defaults.film = 3: allowed is a table"),
        ({"settle": -1.0}, "defaults.settle = -1.0: allowed is a number >= 0"),
        ({"film": {"length": math.nan}}, "defaults.film.length = nan: allowed is a number"),
        (3, "defaults = 3: allowed is a table"),
    ],
)
def test_defaults_that_no_scene_has_are_refused(defaults, message):
    with pytest.raises(InputError, match=message):
        dataclasses.replace(FOUR_BAR, defaults=defaults)
    data = {**Scene(mechanism=FOUR_BAR).to_dict()["mechanism"], "defaults": defaults}
    with pytest.raises(InputError, match=message):
        mechanism_from_dict(data)


def test_everything_assumed_is_named_with_its_source():
    named = assumed_values(scene())
    keys = {entry.partition(" = ")[0] for entry in named}
    assert keys == {
        "start",
        "contact.modulus",
        "contact.damping",
        "contact.restitution",
        "contact.slowest_impact",
        "friction.mu_kinetic",
    }
    assert "contact.restitution = 0.9 (steel pins, Flores et al. 2008)" in named
    given = scene(contact={"length": 0.02, "restitution": 0.8}, friction={"law": "none"})
    assert {entry.partition(" = ")[0] for entry in assumed_values(given)} == {
        "start",
        "contact.modulus",
        "contact.damping",
        "contact.slowest_impact",
    }


def test_the_slowest_impact_follows_from_crank_speed_and_clearance():
    """Beside the drawn constant of 1 mm/s peaks changed with it by factors, and nothing said so."""
    slow = scene(speed_rpm=60.0)
    speed = 2.0 * math.pi * PIN["clearance"]
    said = f"contact.slowest_impact = {speed:g} m/s (speed of the crank times the clearance)"
    assert said in assumed_values(slow)
    joint = slow.joints["knuckle"]
    law = joint.normal_contact(slow.angular_speed)
    assert law.force(1e-6, 1e-5, 0.5 * speed) == law.force(1e-6, 1e-5, speed)
    assert law.force(1e-6, 1e-5, 1.5 * speed) != law.force(1e-6, 1e-5, speed)
    given = slow.replace({"contact.slowest_impact": 2e-3})
    law = given.joints["knuckle"].normal_contact(given.angular_speed)
    assert law.force(1e-6, 1e-5, speed) == law.force(1e-6, 1e-5, 2e-3)


def test_variants_of_a_film_are_dry_in_bearings_of_its_length():
    joints = {"knuckle": {**PIN, "kind": "lubricated"}, "pivot": {**PIN, "kind": "lubricated"}}
    made, _ = variants(scene(joints=joints, contact=None, film=OIL))
    assert made.keys() == {"ideal", "dry", "lubricated"}
    assert made["dry"].joints["pivot"].contact.shape.length == OIL["length"]
    made, left_out = variants(scene())
    assert made.keys() == {"ideal", "dry"} and "no film" in left_out[-1]


def numbers(scene):
    return {assumption.number for assumption in used_assumptions(scene)}


@pytest.mark.parametrize(
    "given",
    [
        {"film": {"viscosity": 0.4}},
        {"joints": {"crank_pin": {"kind": "lubricated", "film": {"viscosity": 0.4}}}},
    ],
)
def test_a_default_that_is_given_is_not_assumed(given, tmp_path):
    scene = Scene(**given, revolutions=0.002)
    assert "A-11" not in assumed_line(scene)
    assert "A-11" in assumed_line(Scene.from_dict(scene.to_dict())), "complete, not asked"
    assert "A-11" not in assumed_line(scene.replace({"speed_rpm": 100.0}))
    (tmp_path / "scene.toml").write_text("film.viscosity = 0.4\n")
    loaded = Scene.load(tmp_path / "scene.toml", ["film.length=0.1"])
    assert not numbers(loaded) & {11, 12}
    assert numbers(loaded.replace({"film": None})) & {11, 12} == {11, 12}


@pytest.mark.parametrize(
    ("scene", "unused"),
    [
        ({"mechanism": "slider_crank"}, {1, 2, 3, 4, 5, 6, 7, 8, 10, 11, 12}),
        ({"joints": {"crank_pin": "dry"}}, {11, 12, 13}),
        ({"joints": {}}, {10, 11, 12, 13}),
        ({"guide": {"lateral_stiffness": 1e9}}, {9}),
        ({"press": {"counterweight": False}}, {3}),
        ({"film": {"at_contact": "mixed"}}, {13}),
        ({"film": {"viscosity": 0.1}}, {11}),
    ],
)
def test_a_scene_rests_on_what_it_uses_alone(scene, unused):
    everything = set(range(1, 14))
    assert everything - numbers(Scene(**scene)) == unused
    assert 14 in numbers(Scene(**scene, load={"blanking": {"kind": "blanking", "force": 1e4}}))
