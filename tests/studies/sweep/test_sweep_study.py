"""A study file: what it says, and what is refused before anything runs."""

import pytest

from exu_press import InputError, Scene
from exu_press.studies.sweep import Study, load_study

SCENE = '[scene]\njoints.crank_pin = "lubricated"\n'


def load(tmp_path, text):
    path = tmp_path / "study.toml"
    path.write_text(text, encoding="utf-8")
    return load_study(path)


def test_a_grid_with_the_scene_inside(tmp_path):
    study = load(
        tmp_path,
        "save_runs = true\ntime_limit = 600\n"
        + SCENE
        + '[grid]\n"joints.crank_pin.clearance" = [5e-5, 1e-4]\nspeed_rpm = [200.0, 300.0]\n',
    )
    assert study.keys == ("joints.crank_pin.clearance", "speed_rpm")
    assert study.save_runs is True and study.time_limit == 600.0
    first = Scene(joints={"crank_pin": "lubricated", "balls": "ideal"}).replace(
        {"joints.crank_pin.clearance": 5e-5, "speed_rpm": 200.0}
    )
    assert study.scenes[0] == first
    assert [s.speed_rpm for s in study.scenes] == [200.0, 300.0] * 2


def test_a_scene_beside_the_study(tmp_path, monkeypatch):
    (tmp_path / "scene.toml").write_text(SCENE.replace("[scene]\n", ""))
    monkeypatch.chdir("/")
    study = load(tmp_path, 'scene = "scene.toml"\n[list]\nfilm.viscosity = [0.1, 0.2]\n')
    assert study.scene == Scene(joints={"crank_pin": "lubricated", "balls": "ideal"})
    assert [scene.film.viscosity for scene in study.scenes] == [0.1, 0.2]


def test_a_latin_hypercube(tmp_path):
    study = load(tmp_path, SCENE + "[sample]\nn = 5\nseed = 2\nspeed_rpm = [200, 500]\n")
    assert len(study.scenes) == 5
    assert all(200.0 < scene.speed_rpm < 500.0 for scene in study.scenes)


def test_a_time_limit_does_not_make_another_study():
    some = [Study(scene=Scene(), time_limit=t, grid={"speed_rpm": [1.0]}) for t in (1.0, None)]
    assert some[0].to_dict() == some[1].to_dict()
    other = Study(scene=Scene(), grid={"speed_rpm": [2.0]})
    assert other.to_dict() != some[0].to_dict()


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("[grid]\nspeed_rpm = [1]\n", "no scene; allowed is scene = "),
        ("scene = 3\n[grid]\nspeed_rpm = [1]\n", "scene = 3: allowed is a table"),
        (SCENE, r"none given; allowed is one of \[grid\], \[list\], \[sample\]"),
        (SCENE + "[grid]\nspeed_rpm = [1]\n[list]\nspeed_rpm = [1]\n", r"\[grid\] and \[list\]"),
        ("grid = 3\n" + SCENE, "grid = 3: allowed is a table"),
        (SCENE + "[grid]\n", r"\[grid\]: empty"),
        (
            SCENE + "[gird]\nspeed_rpm = [1]\n",
            "gird = .*: unknown key .did you mean .grid...; allowed are scene, ",
        ),
        ("points = []\n" + SCENE + "[grid]\nspeed_rpm = [1]\n", "points = .*: unknown key"),
        ("time_limit = 0\n" + SCENE + "[grid]\nspeed_rpm = [1]\n", "time_limit = 0.*: allowed"),
        ("save_runs = 1\n" + SCENE + "[grid]\nspeed_rpm = [1]\n", "save_runs = 1: allowed is"),
        (SCENE + "[grid]\nspeed = [1.0]\n", "run with speed = 1.0: speed = 1.0: unknown key"),
        (
            SCENE + '[grid]\nspeed_rpm = [200.0, -1.0]\n"film.viscosity" = [0.1]\n',
            r"run with speed_rpm = -1\.0, film\.viscosity = 0\.1: speed_rpm = -1\.0: allowed",
        ),
        (
            SCENE + '[grid]\njoints.crank_pin = ["ideal"]\nfilm.viscosity = [0.1]\n',
            "not used by this",
        ),
        ("[scene]\nspeed = 1\n[grid]\nspeed_rpm = [1]\n", "speed = 1: unknown key"),
        ("scene = [", "not a TOML file"),
        ('scene = "nowhere.toml"\n[grid]\nspeed_rpm = [1]\n', "nowhere.toml: cannot be read"),
    ],
)
def test_what_is_refused(tmp_path, text, message):
    with pytest.raises(InputError, match=message) as refused:
        load(tmp_path, text)
    assert "\n" not in str(refused.value)
    assert ".toml" in str(refused.value)
