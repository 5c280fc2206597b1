"""A scene of one's own mechanism: by path, by data, as an object; saved, changed and read back."""

from dataclasses import replace
from functools import partial

import numpy as np
import pytest
from refused import refused

from exu_press import InputError, Result, Scene, simulate
from exu_press.mechanism import Guide, mechanism_lines, shipped_mechanism
from exu_press.scene import mechanism_of

FOUR_BAR = shipped_mechanism("four_bar")
LENGTH = {"length": 0.02}
JOINTS = {"knuckle": {"kind": "dry", "radius": 0.02, "clearance": 2e-5, "contact": LENGTH}}


@pytest.fixture
def folder(tmp_path):
    """A scene file beside a mechanism file."""
    (tmp_path / "my_press.toml").write_text("\n".join(mechanism_lines(FOUR_BAR)))
    lines = ['mechanism = "my_press.toml"', "revolutions = 0.01", "[solver]", "step = 1e-5"]
    lines += ["[joints.knuckle]", 'kind = "dry"', "radius = 0.02", "clearance = 2e-5"]
    lines += ["contact = {length = 0.02}"]
    (tmp_path / "scene.toml").write_text("\n".join(lines))
    return tmp_path


def test_a_path_is_relative_to_the_scene_file(folder, monkeypatch):
    monkeypatch.chdir("/")
    scene = Scene.load(folder / "scene.toml")
    assert scene.mechanism == FOUR_BAR
    assert scene.joints["knuckle"].kind == "dry"
    assert scene.joints["pivot"].kind == "ideal"


def test_a_changed_scene_keeps_its_mechanism():
    scene = Scene(mechanism=FOUR_BAR, joints=JOINTS)
    pivot = {"kind": "lubricated", "radius": 0.02, "clearance": 2e-5}
    film = {"length": 0.02, "viscosity": 0.1}
    faster = scene.replace({"speed_rpm": 300.0, "joints.pivot": pivot, "film": film})
    assert faster.mechanism == FOUR_BAR
    assert faster.joints["pivot"].kind == "lubricated"
    assert faster.joints["knuckle"] == scene.joints["knuckle"]


def test_a_saved_scene_and_a_result_are_complete_without_the_mechanism_file(folder):
    scene = Scene.load(folder / "scene.toml")
    scene.save(folder / "saved.toml", comments=True)
    result = simulate(scene)
    result.save(folder / "run.nc")
    (folder / "my_press.toml").unlink()
    assert Scene.load(folder / "saved.toml") == scene
    again = Result.load(folder / "run.nc")
    assert mechanism_of(again.scene) == FOUR_BAR
    assert np.array_equal(again["slider_position"], result["slider_position"])


def test_a_mechanism_of_its_own_may_have_a_shipped_ones_name():
    """It has none of that one's joints with clearance."""
    own = replace(FOUR_BAR, name="press")
    assert not Scene(mechanism=own).joints.with_clearance


refusal = partial(refused, Scene)


def test_a_file_that_is_not_there(tmp_path):
    (tmp_path / "scene.toml").write_text('mechanism = "none.toml"')
    with pytest.raises(InputError, match=r"scene\.toml: .*none\.toml: cannot be read"):
        Scene.load(tmp_path / "scene.toml")


def test_a_crank_that_locks_is_refused_with_the_scene():
    joints = {joint.name: joint for joint in FOUR_BAR.joints}
    joints["crank_pin"] = replace(joints["crank_pin"], at=(0.0, 0.3))  # as long as the rocker
    locking = replace(FOUR_BAR, joints=tuple(joints.values()))
    shown = refusal(mechanism=locking)
    assert "rocker" in shown and "lock" in shown and "at crank angle" in shown


def test_guides_in_any_direction_may_be_elastic():
    """A slider whose guide leans: the spring pushes across it alone."""
    leaning = replace(shipped_mechanism("six_bar"), guides=(Guide("ram", (0.1, 1.0)),))
    steps = {"revolutions": 0.1, "solver": {"step": 1e-4}}
    result = simulate(Scene(mechanism=leaning, guide={"lateral_stiffness": 1e9}, **steps))
    assert result.completed
    ideal = simulate(Scene(mechanism=leaning, **steps))
    assert result["slider_position"] == pytest.approx(ideal["slider_position"], abs=2e-5)
    later = result.time > 0.01  # the spring starts relaxed and rings
    means = [np.mean(one["guide_force"][later]) for one in (result, ideal)]
    assert means[0] == pytest.approx(means[1], rel=0.05)
    assert abs(result.quantity("energy.residual").value) < 1e-3
    assert abs(ideal.quantity("energy.residual").value) < 1e-3
