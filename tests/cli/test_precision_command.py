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


def test_the_command_writes_report_and_pictures(tmp_path, capsys):
    arguments = ["precision", "--quick", "--quiet", "--case", "slider_crank_ideal"]
    assert main([*arguments, "--out", str(tmp_path)]) == 0
    report = json.loads((tmp_path / "precision.json").read_text())
    assert {row["case"] for row in report["rows"]} == {"slider_crank_ideal"}
    assert all(row.keys() >= COLUMNS for row in report["rows"])
    assert report["machine"]["processor"] and report["machine"]["versions"]["exudyn"]
    assert (tmp_path / "precision_slider_crank_ideal.png").stat().st_size > 10_000
    assert capsys.readouterr().out == ""


def test_a_scene_of_the_users_own(tmp_path, capsys):
    scene = tmp_path / "mine.toml"
    scene.write_text('mechanism = "slider_crank"\njoints = {}\nrevolutions = 0.05\n')
    arguments = ["precision", str(scene), "--quick", "--no-pictures", "--out", str(tmp_path / "o")]
    assert main([*arguments, "--set", "speed_rpm=300"]) == 0
    assert "mine: Scene" in capsys.readouterr().out
    report = json.loads((tmp_path / "o" / "precision.json").read_text())
    assert report["cases"]["mine"]["duration"] == pytest.approx(0.01)


@pytest.mark.parametrize(
    ("arguments", "named"),
    [
        (["--case", "nothing"], "--case nothing"),
        (["--set", "speed_rpm=300"], "--set"),
        (["press", "--case", "squeezer"], "--case squeezer"),
        (["nowhere.toml"], "nowhere.toml"),
        (["press", "--set", "speed_rpm=-1"], "speed_rpm"),
    ],
)
def test_wrong_input_is_refused_in_one_line(arguments, named, capsys, tmp_path):
    assert main(["precision", *arguments, "--out", str(tmp_path)]) == 2
    message = capsys.readouterr().err
    assert named in message and message.count("\n") == 1
    assert not list(tmp_path.iterdir())
