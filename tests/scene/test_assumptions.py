import pytest

from exu_press import Scene
from exu_press.scene.assumptions import assumed_line, used_assumptions


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
