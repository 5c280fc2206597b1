"""Files that earlier versions have written are read, and a later version's refused by that name.

`tests/stored/0.9` is as 0.9 writes them: a run and a sweep of a slider-crank with a dry crank pin.
"""

import json
import shutil
from pathlib import Path

import pytest
from stored_results import rewritten

from exu_press import Result, Scene
from exu_press.cli import main
from exu_press.errors import InputError
from exu_press.parallel.rows import RowFile

STUDY = """
scene = {mechanism = "slider_crank"}
[keys]
speed_rpm = [100.0, 200.0]
"""

STORED = Path(__file__).parent / "stored"
VERSIONS = sorted(path.name for path in STORED.iterdir())


@pytest.mark.parametrize("version", VERSIONS)
def test_a_stored_run_is_read(version):
    result = Result.load(STORED / version / "run.nc")
    assert result.completed
    assert result.time[-1] == pytest.approx(0.02 * 0.25)
    assert result.scene.joints["crank_pin"].clearance == 1e-4
    assert result["slider_position"][-1] == pytest.approx(-0.3531142, abs=1e-6)


@pytest.mark.parametrize("version", VERSIONS)
def test_a_stored_study_is_read(version, tmp_path):
    folder = tmp_path / "sweep"
    shutil.copytree(STORED / version, folder, ignore=shutil.ignore_patterns("run.nc"))
    with RowFile(folder / "runs.jsonl") as file:
        assert file.count == 2
    assert main(["report", str(folder), "--quiet"]) == 0
    assert "joints.crank_pin.clearance" in (folder / "report.html").read_text(encoding="utf-8")


def test_a_key_without_use_that_an_earlier_version_took_is_left_out(tmp_path):
    content = (STORED / "0.9" / "run.nc").read_bytes()
    scene = Result.load(STORED / "0.9" / "run.nc").scene.to_dict()
    guide = {"lateral_stiffness": 1e9, "slider": {"kind": "ideal"}}
    earlier = tmp_path / "run.nc"
    earlier.write_bytes(rewritten(content, {"scene": json.dumps({**scene, "guide": guide})}))
    assert Result.load(earlier).scene == Scene.from_dict(
        {**scene, "guide": {"slider": guide["slider"]}}
    )
    unknown = rewritten(content, {"scene": json.dumps({**scene, "guide": {"foo": 1}})})
    earlier.write_bytes(unknown)
    with pytest.raises(InputError, match=r"or damaged: guide\.foo = 1: unknown key"):
        Result.load(earlier)


def test_a_run_of_a_later_version_is_refused_as_such(tmp_path, capsys):
    content = (STORED / "0.9" / "run.nc").read_bytes()
    later = tmp_path / "run.nc"
    later.write_bytes(rewritten(content, {"format": "exu_press result 3"}))
    with pytest.raises(InputError, match=r"run\.nc: is of format 3, written by a newer version"):
        Result.load(later)
    assert main(["report", str(later), "--quiet"]) == 2
    assert "update exu_press" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("name", "words"),
    [("report.json", ["report", "--quiet"]), ("study.json", ["sweep", "study.toml", "--quiet"])],
)
def test_a_study_of_a_later_version_is_refused_as_such(name, words, tmp_path, monkeypatch, capsys):
    folder = tmp_path / "sweep"
    shutil.copytree(STORED / "0.9", folder, ignore=shutil.ignore_patterns("run.nc"))
    text = (folder / name).read_text(encoding="utf-8")
    assert text.count("exu_press study 1") == 1
    (folder / name).write_text(text.replace("exu_press study 1", "exu_press study 2"), "utf-8")
    (tmp_path / "study.toml").write_text(STUDY, encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    where = ["--out", "sweep"] if words[0] == "sweep" else ["sweep"]
    assert main([*words, *where]) == 2
    error = capsys.readouterr().err
    assert f"{name}: is of format 2" in error and "update exu_press" in error
