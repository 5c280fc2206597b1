"""A full disk: status 3, one message that names the file, and what was finished is kept.

A limit on the size of files stands for it here, as a test may make no file system.
scripts/full_disks.py makes small ones, where the rights allow it.
"""

import errno
import json
import os
import subprocess
import sys

import pytest

from exu_press import simulate
from exu_press.cli import main
from exu_press.errors import DiskFullError, error_prefix
from exu_press.verification import run as with_errors

LIMITED = """
import resource, sys
resource.setrlimit(resource.RLIMIT_FSIZE, (int(sys.argv[1]), int(sys.argv[1])))
from exu_press.cli import main
from exu_press.result import run
run.BLOCK = 0.1
sys.exit(main(sys.argv[2:]))
"""

OF_A_RUN = ["--no-error", "--no-pictures", "--quiet"]


def limited(size, *arguments, **variables):
    """Return a command that has ended, whose files may have so many bytes.

    It keeps no bytecode, which would be half a file.
    """
    command = [sys.executable, "-c", LIMITED, str(size), *arguments]
    env = {**os.environ, "PYTHONDONTWRITEBYTECODE": "1", **variables}
    return subprocess.run(command, capture_output=True, text=True, timeout=100, env=env)


def test_a_result_that_does_not_fit(tmp_path):
    run = ["run", "slider_crank", "--set", "revolutions=0.01", *OF_A_RUN]
    done = limited(20_000, *run, "--out", tmp_path)
    assert done.returncode == 3
    assert done.stderr == f"exu-press: {tmp_path / 'run.nc'}: cannot be written (File too large)\n"
    assert [file.name for file in tmp_path.iterdir() if file.name != ".lock"] == []


def test_blocks_that_do_not_fit(tmp_path):
    """What was finished before stays, to go on from."""
    run = ["run", "slider_crank", "--set", "revolutions=1", *OF_A_RUN, "--out", tmp_path]
    done = limited(120_000, *run)
    assert done.returncode == 3
    folder = tmp_path / "run.nc.unfinished"
    assert done.stderr.startswith(f"exu-press: {folder}{os.sep}")
    assert done.stderr.endswith("cannot be written (File too large)\n")
    assert done.stderr.count("\n") == 1
    assert (folder / "head.nc").is_file()


STUDY = """
[scene]
mechanism = "slider_crank"
revolutions = 0.01
[keys]
speed_rpm = [100.0, 200.0, 300.0]
"""


def test_a_study_says_how_many_runs_failed_and_goes_on_later(tmp_path, monkeypatch, capsys):
    def full_at_200(scene, **options):
        if scene.speed_rpm == 200.0:
            raise OSError(errno.ENOSPC, "No space left on device", "/small/x")
        return simulated(scene, **options)

    simulated = simulate
    monkeypatch.setattr("exu_press.verification.simulate.simulate", full_at_200)
    (tmp_path / "study.toml").write_text(STUDY)
    command = ["sweep", str(tmp_path / "study.toml"), "--no-pictures", "--quiet"]
    assert main([*command, "--out", str(tmp_path / "o")]) == 3
    said = capsys.readouterr().err
    assert said.startswith("exu-press: /small/x: cannot be written (No space left on device): ")
    assert "1 of 3 runs failed, 1 are finished" in said and said.count("\n") == 1
    monkeypatch.undo()
    assert main([*command, "--out", str(tmp_path / "o")]) == 0
    assert (tmp_path / "o" / "table.csv").read_text().count("completed") == 3


def test_refinements_without_room_leave_the_run_without_errors(tmp_path, monkeypatch, capsys):
    def full(refinements):
        raise DiskFullError("/small/x: cannot be written (No space left on device)")
        yield

    monkeypatch.setattr(with_errors.RefinementRuns, "results", full)
    run = ["run", "slider_crank", "--set", "revolutions=0.01", "--once", "--no-pictures"]
    assert main([*run, "--quiet", "--out", str(tmp_path)]) == 3
    assert capsys.readouterr().err == (
        "exu-press: no errors of the quantities are known: /small/x: cannot be written "
        "(No space left on device)\n"
    )
    summary = json.loads((tmp_path / "summary.json").read_text())
    assert summary["status"] == "completed" and "/small/x" in summary["reason"]
    assert {told["error"] for told in summary["quantities"].values()} == {None}


def test_a_full_disk_stays_one_below_a_prefix():
    with pytest.raises(DiskFullError, match=r"^bodies\.rod: no room"), error_prefix("bodies.rod: "):
        raise DiskFullError("no room")


def test_a_child_says_that_its_disk_is_full(tmp_path):
    """Blocks of a long run, and of its refinements, in the temporary folder."""
    run = ["run", "slider_crank", "--set", "revolutions=1", "--within", "5%", "--no-pictures"]
    done = limited(30_000, *run, "--quiet", "--out", tmp_path, TMPDIR=str(tmp_path))
    assert done.returncode == 3
    assert done.stderr.startswith(f"exu-press: {tmp_path}{os.sep}exu_press_temporary_")
    assert done.stderr.count("\n") == 1
