"""exu-press stability: exit status, files and what it prints."""

import json

from exu_press import Scene
from exu_press.cli import main
from exu_press.studies.stability import Row, StabilityReport
from exu_press.studies.stability.run import StabilityCommand

SCENE = ["slider_crank", "--set", "revolutions=0.03"]


def test_one_key_of_a_scene(tmp_path, capsys):
    arguments = ["stability", *SCENE, "--key", "contact.modulus", "--workers", "1"]
    assert main([*arguments, "--out", str(tmp_path)]) == 0
    report = json.loads((tmp_path / "stability.json").read_text())
    assert report["counts"]["wrong"] == 0 and report["counts"]["right"] >= 1
    case = report["cases"][0]
    assert case.keys() >= {
        "name", "axis", "value", "parameters", "verdict", "reason", "checks", "wall_time",
        "residual", "status", "steps",
    }  # fmt: skip
    pushed = [case["parameters"]["contact"]["modulus"] for case in report["cases"]]
    assert len(pushed) == 6 and min(pushed) < 1e9 < 1e13 < max(pushed)
    assert (tmp_path / "stability.png").stat().st_size > 10_000
    printed = capsys.readouterr().out
    assert "6 cases: " in printed


def test_a_wrong_case_makes_the_command_fail(tmp_path, monkeypatch, capsys):
    row = Row("b", "a", "c", {}, "wrong", "completed", reason="d")
    report = StabilityReport(Scene(), True, (row,))
    monkeypatch.setattr(StabilityCommand, "run", lambda *_, **__: report)
    arguments = ["stability", *SCENE, "--no-pictures", "--out", str(tmp_path)]
    assert main(arguments) == 1
    assert "wrong: b" in capsys.readouterr().out


def test_an_axis_that_the_scene_does_not_have(tmp_path, capsys):
    assert main(["stability", *SCENE, "--key", "nothing", "--out", str(tmp_path / "out")]) == 2
    message = capsys.readouterr().err
    assert "--key nothing: allowed are" in message and message.count("\n") == 1
    assert not (tmp_path / "out").exists()
