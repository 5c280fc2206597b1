"""A scene file: what is read, what is refused, and that the message names the file."""

from dataclasses import replace
from functools import partial
from pathlib import Path

import numpy as np
import pytest
from refused import refused

import exu_press
from exu_press import InputError, Result, Scene, simulate
from exu_press.mechanism import mechanism_lines, shipped_mechanism
from exu_press.scene import mechanism_of, parse_assignment

SHIPPED = sorted((Path(exu_press.__file__).parent / "scenes").glob("*.toml"))


def write(directory, text):
    path = directory / "scene.toml"
    path.write_text(text, encoding="utf-8")
    return path


refusal = partial(refused, Scene.load)


@pytest.mark.parametrize(
    ("content", "shown"),
    [
        (b"speed = 3", "speed = 3: unknown key"),
        (b"speed_rpm = 2020-01-01", "speed_rpm = "),
        (b"[[film]]\nviscosity = 1", "film = "),
        *((text, "not a TOML file") for text in (b"speed_rpm =", b"[film", b"a = 1\na = 2")),
        (b"\xff\xfe\x00", "is not a text in UTF-8"),
    ],
)
def test_what_is_wrong_is_said_with_the_file(tmp_path, content, shown):
    path = tmp_path / "scene.toml"
    assert refusal(path) == f"{path}: cannot be read (No such file or directory)"
    path.write_bytes(content)
    assert refusal(path).startswith(f"{path}: {shown}")
    assert refusal(tmp_path).startswith(f"{tmp_path}: is a directory")


@pytest.mark.parametrize("path", SHIPPED, ids=lambda path: path.stem)
def test_shipped_scenes_load(path):
    assert path.stem.startswith(Scene.load(path).mechanism)


def test_assignments_change_the_file(tmp_path):
    path = write(tmp_path, "speed_rpm = 300\n[film]\nviscosity = 0.1")
    scene = Scene.load(path, ["speed_rpm=200", "film.viscosity = 0.2", "film.law=pi_film"])
    assert (scene.speed_rpm, scene.film["viscosity"], scene.film["law"]) == (200.0, 0.2, "pi_film")


def test_a_wrong_assignment_is_not_the_files(tmp_path):
    path = write(tmp_path, "[film]\nviscosity = 0.1")
    for change in ("film.viscocity=1", "joints.crank_pin=wet", "joints.crank_pin=no_such:Kind"):
        with pytest.raises(InputError, match=rf"^{path.name} with --set: {change[:8]}"):
            Scene.load(path, [change], allow_code=True)


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("a=1", 1),
        ("a=1e-5", 1e-5),
        ("a = true", True),
        ("a=dry", "dry"),
        ('a="dry"', "dry"),
        ("a.b=[1, 2]", [1, 2]),
        ("a=nan", pytest.approx(float("nan"), nan_ok=True)),
        ("a=b=c", "b=c"),
        ("a={b=2e9}", {"b": 2e9}),
    ],
)
def test_assignment_values(text, value):
    name, given = parse_assignment(text)
    assert name == ("a.b" if "." in text.partition("=")[0] else "a")
    assert given == value


@pytest.mark.parametrize("text", ["", "=", "speed_rpm", "speed_rpm=", "=3", "  = 3", "a ="])
def test_assignment_without_key_or_value(text):
    with pytest.raises(InputError, match=r"--set .*allowed is key=value"):
        parse_assignment(text)


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


def test_a_crank_that_locks_is_refused_with_the_scene():
    joints = {joint.name: joint for joint in FOUR_BAR.joints}
    joints["crank_pin"] = replace(joints["crank_pin"], at=(0.0, 0.3))  # as long as the rocker
    locking = replace(FOUR_BAR, joints=tuple(joints.values()))
    shown = refused(Scene, mechanism=locking)
    assert "rocker" in shown and "lock" in shown and "at crank angle" in shown
