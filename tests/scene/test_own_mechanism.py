"""A scene of one's own mechanism: by path, by data, as an object; saved, changed and read back."""

from dataclasses import replace
from functools import partial

import numpy as np
import pytest
from refused import refused

from exu_press import Result, Scene, simulate
from exu_press.mechanism import mechanism_lines, shipped_mechanism
from exu_press.scene import mechanism_of

FOUR_BAR = shipped_mechanism("four_bar")


@pytest.fixture
def folder(tmp_path):
    """A scene file beside a mechanism file."""
    (tmp_path / "my_press.toml").write_text("\n".join(mechanism_lines(FOUR_BAR)))
    lines = ['mechanism = "my_press.toml"', "revolutions = 0.01", "[solver]", "step = 1e-5"]
    lines += ["[joints.knuckle]", 'kind = "dry"', "radius = 0.02", "clearance = 2e-5"]
    lines += ["contact = {length = 0.02}"]
    (tmp_path / "scene.toml").write_text("\n".join(lines))
    return tmp_path


def test_a_saved_scene_and_a_result_are_complete_without_the_mechanism_file(folder):
    scene = Scene.load(folder / "scene.toml")  # beside which the mechanism's file lies
    assert scene.mechanism == FOUR_BAR and scene.joints["knuckle"].kind == "dry"
    assert scene.replace({"speed_rpm": 300.0}).mechanism == FOUR_BAR
    scene.save(folder / "saved.toml", comments=True)
    result = simulate(scene)
    result.save(folder / "run.nc")
    (folder / "my_press.toml").unlink()
    assert Scene.load(folder / "saved.toml") == scene
    again = Result.load(folder / "run.nc")
    assert mechanism_of(again.scene) == FOUR_BAR
    assert np.array_equal(again["slider_position"], result["slider_position"])


refusal = partial(refused, Scene)


def test_a_crank_that_locks_is_refused_with_the_scene():
    joints = {joint.name: joint for joint in FOUR_BAR.joints}
    joints["crank_pin"] = replace(joints["crank_pin"], at=(0.0, 0.3))  # as long as the rocker
    locking = replace(FOUR_BAR, joints=tuple(joints.values()))
    shown = refusal(mechanism=locking)
    assert "rocker" in shown and "lock" in shown and "at crank angle" in shown
