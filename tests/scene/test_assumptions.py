import re

import pytest

from exu_press import Result, Scene, simulate
from exu_press.scene import BlankingLoad
from exu_press.scene.assumptions import ASSUMPTIONS, assumed_line, keys_of, used_assumptions
from exu_press.scene.usage import TABLES, table_keys
from exu_press.schema.table import declared_keys

SCENES_OWN = {"contact": {}, "friction": {}}


def numbers(scene):
    return {assumption.number for assumption in used_assumptions(scene)}


def test_every_key_that_names_an_assumption_is_listed_under_it():
    listed = {a.number: a.keys for a in ASSUMPTIONS}
    for name in TABLES:
        for key, field in table_keys(name).items():
            for number in re.findall(r"\(A-(\d+)\)", field.metadata.get("meaning", "")):
                assert f"{name}.{key}" in listed[int(number)]


def test_every_listed_key_exists():
    assert [a.number for a in ASSUMPTIONS] == list(range(1, 15))
    for assumption in ASSUMPTIONS:
        for key in assumption.keys:
            table, _, name = key.partition(".")
            keys = declared_keys(BlankingLoad) if table == "load" else table_keys(table)
            assert not name or name.removeprefix("*.") in keys


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
    simulate(scene).save(tmp_path / "run.nc")
    assert "A-11" not in assumed_line(Result.load(tmp_path / "run.nc").scene)


def test_a_default_that_a_file_or_the_command_line_gives_is_not_assumed(tmp_path):
    (tmp_path / "scene.toml").write_text("film.viscosity = 0.4\n")
    scene = Scene.load(tmp_path / "scene.toml", ["film.length=0.1"])
    assert not numbers(scene) & {11, 12}
    assert numbers(scene.replace({"film": None})) & {11, 12} == {11, 12}


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


def test_laws_that_all_joints_replace_are_not_assumed():
    own = {"contact": {"restitution": 0.5}, "friction": {"mu_kinetic": 0.05}}
    pin = {"kind": "dry", "clearance": 1e-4, "radius": 0.03} | own
    scene = Scene(mechanism="four_bar", joints={"knuckle": pin}, contact={"length": 0.05})
    for key, words in (("contact.restitution", "0.9"), ("friction.mu_kinetic", "0.1")):
        assert f"{key} = " not in assumed_line(scene)
        assert f"{key} = {words}" in assumed_line(scene.replace({"joints.pivot": pin | SCENES_OWN}))
    assert "contact.damping = hu_guo" in assumed_line(scene)
    slides = Scene(
        mechanism="slider_crank",
        joints={"crank_pin": pin},
        guide={"clearance": 1e-4, "width": 0.1},
    )
    assert "contact.restitution = 0.9" in assumed_line(slides)
    mixed = Scene(joints={"crank_pin": {"kind": "lubricated", "film": {"at_contact": "mixed"}}})
    assert "A-13" not in assumed_line(mixed)


def test_keys_with_defaults_units_and_meanings():
    keys = keys_of(Scene())
    assert all(key.is_assumed for key in keys.values())
    assert str(keys["film.viscosity"]) == "film.viscosity = 0.4 Pa s"
    assert keys["solver.tolerance"].value == 1e-3
    assert "solver.step" not in keys


@pytest.mark.parametrize(
    ("scene", "changed"),
    [
        ({"joints": {"crank_pin": "dry", "balls": "dry"}}, {"joints.crank_pin.kind"}),
        (
            {"joints": {"crank_pin": "lubricated", "balls": {"kind": "dry", "clearance": 5e-5}}},
            {"joints.balls.clearance"},
        ),
        (
            {"joints": {"balls": "dry", "crank_pin": "lubricated", "pivots": "dry"}},
            {"joints.pivots.kind"},
        ),
        (
            {
                "joints": {
                    "balls": "dry",
                    "crank_pin": {"kind": "lubricated", "film": {"length": 0.2}},
                }
            },
            {"joints.crank_pin.film.length"},
        ),
        ({"solver": {"step": 1e-5}}, {"solver.step"}),
        (
            {"mechanism": "slider_crank", "joints": {}},
            {"mechanism", "joints.crank_pin.kind"},
        ),
        ({"load": {"blanking": {"kind": "blanking", "force": 1e4}}}, {"load.blanking.force"}),
        ({"film": {"at_contact": "mixed"}}, {"film.at_contact"}),
    ],
)
def test_only_what_differs_counts_as_given(scene, changed):
    keys = keys_of(Scene(**scene))
    assert {name for name, key in keys.items() if key.is_changed} == changed
    sampled = keys_of(Scene(output={"samples": [90.0]}))
    assert sampled["output.every"].is_assumed and not sampled["output.samples"].is_assumed
