"""Provenance of a result: every file that went in, by its content."""

import hashlib
import json
from pathlib import Path

import pytest

from exu_press import Result, Scene
from exu_press.cli import main
from exu_press.files.digests import recorded_files
from exu_press.scene.provenance import changed_inputs, provenance_of

MECHANISM = Path(__file__).parents[2] / "exu_press" / "mechanism" / "files" / "six_bar.toml"

SCENE = """
mechanism = "mine.toml"
revolutions = 0.01
[load.cut]
kind = "table"
file = "cut.csv"
body = "ram"
"""


@pytest.fixture
def folder(tmp_path, monkeypatch):
    """A scene with a mechanism and a table of its own, in the folder where one works."""
    (tmp_path / "mine.toml").write_bytes(MECHANISM.read_bytes())
    (tmp_path / "cut.csv").write_text("time,force\n0.0, 0.0\n0.1, 100.0\n")
    (tmp_path / "scene.toml").write_text(SCENE)
    monkeypatch.chdir(tmp_path)
    return tmp_path


def digest(path):
    return hashlib.sha256(path.read_bytes()).hexdigest()


def test_a_scene_knows_its_files_and_keeps_them_when_it_is_changed(folder):
    names = ("scene.toml", "mine.toml", "cut.csv")
    scene = Scene.load("scene.toml")
    assert scene.files == {name: digest(folder / name) for name in names}
    assert scene.replace({"speed_rpm": 100.0}).files == scene.files
    for _ in range(2):  # it is read once
        assert Scene(mechanism="six_bar").files.keys() == {"exu_press:mechanism/files/six_bar.toml"}


def test_a_changed_missing_or_new_input_is_named(folder):
    scene = Scene.load("scene.toml")
    provenance = provenance_of(scene)
    assert changed_inputs(provenance, scene) == {}
    (folder / "cut.csv").write_text("time,force\n0.0, 0.0\n0.1, 101.0\n")
    (folder / "mine.toml").unlink()
    assert changed_inputs(provenance, scene) == {"cut.csv": "changed", "mine.toml": "missing"}
    step = folder / "rod.step"
    step.write_text("ISO-10303-21;")
    flexible = Scene(mechanism="slider_crank", bodies={"rod": {"flexible": str(step)}})
    assert provenance_of(flexible)["files"] == {str(step): digest(step)}


def test_summary_result_and_study_say_where_they_come_from(folder):
    words = ["run", "scene.toml", "--no-error", "--no-pictures", "--quiet", "--out", "o"]
    assert main(words) == 0
    summary = json.loads(Path("o/summary.json").read_text())["provenance"]
    with recorded_files() as files:
        assert summary == Result.load("o/run.nc").info["provenance"]
    assert files == {"o/run.nc": digest(folder / "o/run.nc")}
    assert summary["command"] == " ".join(["exu-press", *words])
    assert summary["files"].keys() == {"scene.toml", "mine.toml", "cut.csv"}
    Path("study.toml").write_text('scene = "scene.toml"\n[keys]\nspeed_rpm = [100.0]\n')
    more = ["--workers", "1", "--quiet", "--no-pictures", "--out", "s"]
    assert main(["sweep", "study.toml", *more]) == 0
    report = json.loads(Path("s/report.json").read_text())["provenance"]
    assert report["files"].items() > summary["files"].items()
    assert report["files"]["study.toml"] == digest(folder / "study.toml")
    rows = {"s/runs.jsonl": digest(folder / "s/runs.jsonl")}
    Path("scene.toml").write_text(f"# a comment{SCENE}")
    assert main(["sweep", "study.toml", *more]) == 0
    again = json.loads(Path("s/report.json").read_text())["provenance"]
    changed = {"scene.toml": digest(folder / "scene.toml")}
    assert again["files"] == {**report["files"], **changed, **rows}, "rows are an earlier command's"
