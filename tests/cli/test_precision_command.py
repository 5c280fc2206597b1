"""exu-press precision, in its reduced form and reduced further."""

import json

import pytest

from exu_press.cli import main

COLUMNS = {
    "case",
    "solver",
    "setting",
    "error_position",
    "error_velocity",
    "error_peak_acceleration",
    "wall_time",
    "cpu_time",
    "steps",
    "rejected_steps",
    "newton_iterations",
    "law_evaluations",
    "status",
}


def test_a_scene_of_the_users_own(tmp_path, capsys):
    scene = tmp_path / "mine.toml"
    scene.write_text('mechanism = "slider_crank"\njoints = {}\nrevolutions = 0.01\n')
    arguments = ["precision", str(scene), "--quick", "--out", str(tmp_path / "o")]
    assert main([*arguments, "--set", "speed_rpm=300"]) == 0
    assert "mine: Scene" in capsys.readouterr().out
    report = json.loads((tmp_path / "o" / "precision.json").read_text())
    assert report["cases"]["mine"]["duration"] == pytest.approx(0.002)
    assert all(row.keys() >= COLUMNS for row in report["rows"])
    assert report["machine"]["processor"] and report["machine"]["versions"]["exudyn"]
    assert (tmp_path / "o" / "precision_mine.png").stat().st_size > 10_000
