"""exu-press run and compare: exit status, files, and what is left alone."""

import json
import re
import signal
import sys
from pathlib import Path

import pytest

from exu_press import Result
from exu_press.cli import main
from exu_press.errors import InputError
from exu_press.files.output_directory import PICTURES

linux = pytest.mark.skipif(sys.platform != "linux", reason="no process is copied there")

QUICK = ["--set", "revolutions=0.02", "--no-pictures", "--no-error"]
KEYS = {
    "status", "reason", "end_time", "warnings", "read_from", "assumed", "quantities", "horizon",
    "lyapunov_exponent", "strokes", "stress", "solids", "cost", "own_items", "versions",
    "provenance", "scene",
}  # fmt: skip


def test_run_writes_summary_and_result(tmp_path, capsys):
    with_errors = [argument for argument in QUICK if argument != "--no-error"]
    assert main(["run", "press", *with_errors, "--out", str(tmp_path / "a" / "b")]) == 0
    summary = json.loads((tmp_path / "a" / "b" / "summary.json").read_text())
    assert set(summary) == KEYS
    values = summary["quantities"]
    known = {name for name, entry in values.items() if entry["error"] is not None}
    there = {name for name, entry in values.items() if entry["value"] is not None}
    assert known == there - {"energy.residual"}
    assert Result.load(tmp_path / "a" / "b" / "run.nc").summary() == summary
    shown = capsys.readouterr()
    assert re.search(r"peak acceleration, m/s\^2 +\S+\(\d\)\n", shown.out)
    (warning,) = summary["warnings"]
    assert warning.startswith("film.law = 'pinkus' is meant for L/D of at least 2. This bearing")
    assert f"exu-press: warning: {warning}" in " ".join(shown.err.split())


def test_pictures_of_an_earlier_run_do_not_stay(tmp_path, capsys):
    """Those of the package alone: a user's own stay."""
    pictures = {name: [f"{each}.png" for each in PICTURES[name]] for name in PICTURES}
    for name in (*pictures["run"], "mine.png"):
        (tmp_path / name).write_text("old")
    assert main(["run", "press", *QUICK, "--quiet", "--out", str(tmp_path)]) == 0
    captured = capsys.readouterr()
    assert captured.out == captured.err == ""
    summary = json.loads((tmp_path / "summary.json").read_text())
    assert {entry["error"] for entry in summary["quantities"].values()} == {None}
    assert {path.name for path in tmp_path.glob("*.png")} == {"mine.png"}
    (tmp_path / "dry").mkdir()
    for name in (*pictures["compare"], "dry/orbit.png"):
        (tmp_path / name).write_text("old")
    assert main(["compare", "slider_crank", *QUICK, "--quiet", "--out", str(tmp_path)]) == 0
    assert {path.name for path in tmp_path.rglob("*.png")} == {"mine.png"}


def test_early_stop_is_status_3_and_keeps_what_was_computed(tmp_path, capsys):
    arguments = ["run", "press", "--set", "film.viscosity=1e-7", "--set", "solver.step=1e-4"]
    arguments += ["--set", "revolutions=0.1", "--no-pictures", "--out", str(tmp_path)]
    assert main(arguments) == 3
    summary = json.loads((tmp_path / "summary.json").read_text())
    assert summary["status"] == "film broke down"
    assert summary["reason"].startswith("film broke down at t = ")
    assert summary["reason"] in capsys.readouterr().err
    assert 0.0 < Result.load(tmp_path / "run.nc").time[-1] < 0.025


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["run", "no_such_file.toml"], "no_such_file.toml: cannot be read"),
        (["run", "presss"], "presss: no such scene (did you mean 'press'?); allowed are a"),
        (["run", "six_bar"], "six_bar: is a shipped mechanism, not a scene; allowed is a scene of"),
        (["run", "press", "--set", "speed_rpm=-1"], "speed_rpm = -1"),
        (["compare", "press", "--set", "joints.balls.clearance=nan"], "balls.clearance = nan"),
    ],
)
def test_wrong_input_is_status_2_in_one_line(arguments, message, tmp_path, capsys):
    out = tmp_path / "out"
    assert main([*arguments, "--out", str(out)]) == 2
    captured = capsys.readouterr()
    assert message in captured.err
    assert captured.err.count("\n") == 1
    assert not out.exists()


@pytest.mark.parametrize("copied", [pytest.param(True, marks=linux), False])
def test_the_run_is_stored_and_printed_before_its_pictures_are_there(
    copied, tmp_path, capsys, monkeypatch
):
    def draw(result, directory, early):
        if not copied:
            assert "peak acceleration" in capsys.readouterr().out
        (directory / ".slider.png.half.part").touch()
        raise InputError("no picture")

    monkeypatch.setattr("os.cpu_count", lambda: 2)
    monkeypatch.setattr("fe_models.processes.may_copy", lambda: copied)
    monkeypatch.setattr("exu_press.plots.save_pictures", draw)
    arguments = ["run", "slider_crank", "--set", "revolutions=0.01", "--no-error"]
    assert main([*arguments, "--out", str(tmp_path)]) == 2
    captured = capsys.readouterr()
    assert ("peak acceleration" in captured.out) == copied and "no picture" in captured.err
    assert {path.name for path in tmp_path.iterdir()} == {"run.nc", "summary.json", ".lock"}


def test_ctrl_c_while_a_finished_run_is_stored_loses_nothing(tmp_path, capsys, monkeypatch):
    def write(file, text, **keys):
        signal.raise_signal(signal.SIGINT)
        return file.write_bytes(text.encode())

    monkeypatch.setattr(Path, "write_text", write)
    arguments = ["run", "slider_crank", "--set", "revolutions=1.01", "--no-error"]
    assert main([*arguments, "--out", str(tmp_path)]) == 130
    assert capsys.readouterr().err.endswith("exu-press: interrupted\n")
    assert json.loads((tmp_path / "summary.json").read_text())["status"] == "completed"
    assert Result.load(tmp_path / "run.nc").completed
    assert {path.name for path in tmp_path.iterdir()} == {"run.nc", "summary.json", ".lock"}


def test_ctrl_c_before_its_errors_are_known_leaves_a_run_without_them(
    tmp_path, capsys, monkeypatch
):
    def draw_early(*_):
        raise KeyboardInterrupt

    monkeypatch.setattr("exu_press.cli.pictures_beside.PicturesBeside.draw_early", draw_early)
    monkeypatch.setattr("exu_press.plots.save_pictures", lambda *_: [])
    monkeypatch.setattr("fe_models.processes.may_copy", lambda: False)
    arguments = ["run", "slider_crank", "--set", "revolutions=0.01", "--quiet"]
    with pytest.warns(UserWarning, match="no errors of the quantities are known: interrupted"):
        assert main([*arguments, "--out", str(tmp_path)]) == 0
    assert not Result.load(tmp_path / "run.nc").info["errors"]


@pytest.mark.parametrize("size", [100, 200_000_000])
def test_a_result_is_no_scene(size, tmp_path, capsys):
    with (tmp_path / "run.nc").open("wb") as file:
        file.write(b"CDF\2")
        file.truncate(size)
    for command in ("run", "draw"):
        assert main([command, str(tmp_path / "run.nc")]) == 2
        assert f"a stored result, which `exu-press report {tmp_path}" in capsys.readouterr().err
