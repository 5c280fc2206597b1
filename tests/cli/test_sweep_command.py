"""exu-press sweep: what it writes, how it is stopped, and what it refuses in one line."""

import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from exu_press.cli import main
from exu_press.parallel import cluster

STUDY = """
{top}
[scene]
joints = {{}}
revolutions = {revolutions}
[keys]
speed_rpm = {speeds}
"""


def study(directory, speeds=(200.0, 300.0), revolutions=0.01, top=""):
    path = directory / "study.toml"
    path.write_text(STUDY.format(speeds=list(speeds), revolutions=revolutions, top=top))
    return str(path)


def test_table_and_picture(tmp_path, capsys):
    out = tmp_path / "out"
    assert main(["sweep", study(tmp_path), "--workers", "1", "--out", str(out)]) == 0
    printed = capsys.readouterr().out.splitlines()
    assert "drive.peak_torque, kN m" in printed[0]
    assert printed[-2:] == [
        "2 runs: 2 completed",
        f"written: table.csv, table.nc, sweep.png in {out}",
    ]
    assert (out / "sweep.png").stat().st_size > 10_000
    assert len((out / "table.csv").read_text().splitlines()) == 3


def test_quiet_prints_nothing_and_the_second_time_runs_nothing(tmp_path, capsys):
    arguments = ["sweep", study(tmp_path), "--out", str(tmp_path / "o"), "--quiet", "--no-pictures"]
    (tmp_path / "o").mkdir()
    (tmp_path / "o" / "sweep.png").write_text("of an earlier time")
    assert main([*arguments, "--workers", "1"]) == 0
    before = (tmp_path / "o" / "table.csv").read_bytes()
    assert main(arguments) == 0
    assert (tmp_path / "o" / "table.csv").read_bytes() == before  # the times too
    shown = capsys.readouterr()
    assert shown.out == shown.err == ""
    assert not (tmp_path / "o" / "sweep.png").exists()


def test_a_study_whose_runs_all_fail_is_a_table(tmp_path, capsys, processes):
    path = study(tmp_path, revolutions=1.0, top="time_limit = 0.02")
    assert main(["sweep", path, "--workers", "2", "--out", str(tmp_path / "o")]) == 3
    shown = capsys.readouterr()
    assert "2 runs: 2 time limit" in shown.out
    assert "2 x time limit: stopped after 0.02 s" in shown.out
    assert "no run reached its end" in shown.err


@pytest.mark.parametrize(
    ("arguments", "named"),
    [
        (["--workers", "0"], "workers = 0"),
        (["--over", "film.length"], "--over film.length: allowed are speed_rpm"),
        (["--dask", "nonsense"], "dask = nonsense"),
        (["--dask", "tcp://127.0.0.1:1"], "dask = tcp://127.0.0.1:1: no scheduler answers"),
    ],
)
def test_wrong_arguments_are_refused_in_one_line(arguments, named, tmp_path, capsys, monkeypatch):
    if named.endswith("answers"):
        pytest.importorskip("distributed")
    monkeypatch.setattr(cluster, "SECONDS_TO_ANSWER", 0.5)
    out = str(tmp_path / "o")
    assert main(["sweep", study(tmp_path), "--quiet", "--out", out, *arguments]) == 2
    message = capsys.readouterr().err
    assert named in message and message.count("\n") == 1
    assert not list((tmp_path).glob("o/table*"))


def test_a_study_whose_runs_all_stop_early_fails(tmp_path, capsys):
    path = study(tmp_path)
    text = Path(path).read_text().replace("joints = {}", "joints = {}\nsolver.max_steps = 2")
    Path(path).write_text(text)
    assert main(["sweep", path, "--no-pictures", "--out", str(tmp_path / "o")]) == 3
    assert "no run reached its end" in capsys.readouterr().err


def test_a_column_that_is_not_there(tmp_path, capsys):
    arguments = ["sweep", study(tmp_path), "--quiet", "--out", str(tmp_path / "o")]
    assert main([*arguments, "--workers", "1", "--show", "nothing"]) == 2
    message = capsys.readouterr().err
    assert "--show nothing: allowed are" in message and message.count("\n") == 1
    assert not (tmp_path / "o").exists()  # nothing is run for a wrong name


@pytest.mark.long
def test_a_printed_column_can_be_asked_for(tmp_path, capsys):
    path = tmp_path / "study.toml"
    path.write_text("[scene]\nrevolutions = 0.01\n[keys]\nspeed_rpm = [200.0, 300.0]\n")
    arguments = ["sweep", str(path), "--workers", "1", "--out", str(tmp_path / "o")]
    arguments.append("--no-pictures")
    assert main(arguments) == 0
    head, *_ = capsys.readouterr().out.splitlines()
    printed = [column.partition(",")[0].strip() for column in head.split("  ") if column]
    assert len(printed) > 2
    for column in printed[1:-1]:
        assert main([*arguments, "--show", column]) == 0
        assert column in capsys.readouterr().out.splitlines()[0]


@pytest.mark.long
def test_ctrl_c_keeps_what_is_finished(tmp_path):
    speeds = [100.0 + n for n in range(200)]
    command = [str(Path(sys.executable).with_name("exu-press")), "sweep"]
    out = tmp_path / "o"
    process = subprocess.Popen(
        [*command, study(tmp_path, speeds, revolutions=0.1), "--workers", "1", "--out", str(out)],
        stderr=subprocess.PIPE,
        text=True,
    )
    end = time.monotonic() + 30.0
    while not (out / "runs.jsonl").exists() or not (out / "runs.jsonl").read_text().count("\n") > 2:
        assert time.monotonic() < end
        time.sleep(0.01)
    process.send_signal(signal.SIGINT)
    _, errors = process.communicate(timeout=20)
    assert process.returncode == 3
    assert errors.splitlines()[-1].startswith("exu-press: interrupted: finished runs are kept in")
    assert "Traceback" not in errors
    assert 2 < (out / "runs.jsonl").read_text().count("\n") < 200
