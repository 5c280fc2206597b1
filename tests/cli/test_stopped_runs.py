"""What a stopped run leaves in its directory, and what the next one there makes of it."""

import shutil
import signal
import subprocess
import sys
import time

import pytest

from exu_press import Result, Scene
from exu_press.cli import main
from exu_press.files.output_directory import checkpoint_directory
from exu_press.result import run

SCENE = Scene(
    mechanism="slider_crank",
    joints={"crank_pin": "dry"},
    revolutions=0.25,
    solver={"tolerance": 1e-2},
)

HELD = """
import pathlib, sys, time
from exu_press.cli import main
from exu_press.result import blocks, run
run.BLOCK = 0.07
keep, stop = blocks.write_checkpoint, int(sys.argv[1])
kept = []
def kept_and_held(*arguments):
    keep(*arguments)
    kept.append(1)
    if len(kept) == stop:
        pathlib.Path("held").touch()
        while pathlib.Path("held").exists():
            time.sleep(0.01)
blocks.write_checkpoint = kept_and_held
sys.exit(main(sys.argv[2:]))
"""

RUN = ["run", "scene.toml", "--no-error", "--no-pictures", "--quiet", "--out", "o"]


@pytest.fixture(autouse=True)
def folder(tmp_path, monkeypatch):
    """The working directory of runs whose blocks are short."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(run, "BLOCK", 0.07)
    SCENE.save("scene.toml")
    return tmp_path


def held(folder, blocks):
    """Return the process of a run that waits when it has finished so many blocks."""
    process = subprocess.Popen(
        [sys.executable, "-c", HELD, str(blocks), *RUN],
        cwd=folder,
        stderr=subprocess.PIPE,
        text=True,
    )
    end = time.monotonic() + 60.0
    while not (folder / "held").exists():
        assert process.poll() is None and time.monotonic() < end, "waited in vain"
        time.sleep(0.01)
    return process


@pytest.fixture(scope="module")
def killed_once(tmp_path_factory):
    folder = tmp_path_factory.mktemp("killed")
    SCENE.save(folder / "scene.toml")
    process = held(folder, 2)
    process.kill()
    process.communicate()
    return folder / "o"


@pytest.fixture
def killed(folder, killed_once):
    """The directory of a run that was killed when it had two blocks of 0.07 revolutions."""
    return shutil.copytree(killed_once, folder / "o")


def blocks_in(directory):
    return {file.name: file.read_bytes() for file in directory.iterdir() if file.name != ".lock"}


def test_finished_blocks_are_neither_deleted_nor_hidden(killed, capsys):
    left = blocks_in(killed / "run.nc.unfinished")
    assert main([*RUN, "--set", "revolutions=0.02"]) == 2
    said = capsys.readouterr().err
    assert "`--from o` goes on" in said and "`--overwrite` deletes" in said
    assert blocks_in(killed / "run.nc.unfinished") == left
    assert not (killed / "run.nc").exists()


@pytest.mark.parametrize(
    ("start", "revolutions"), [("o", 0.11), ("o/run.nc", 0.11), ("o/run.nc.unfinished", 0.05)]
)
def test_a_run_goes_on_in_its_own_directory(killed, start, revolutions):
    """With a result of an earlier run beside it the directory means what is newer."""
    if start == "o":
        assert main([*RUN[:-1], "p", "--set", "revolutions=0.02"]) == 0
        shutil.copy("p/run.nc", killed / "run.nc")
    left = blocks_in(killed / "run.nc.unfinished")
    with pytest.warns(UserWarning, match=r"has 0\.14 revolutions"):
        assert main([*RUN, "--from", start, "--overwrite"]) == 2  # which would delete its start
        assert main([*RUN, "--from", start, "--set", f"revolutions={revolutions}"]) == 0
    assert blocks_in(killed / "run.nc.unfinished.1") == left
    gone_on = Result.load(killed / "run.nc")
    assert gone_on.time[0] == pytest.approx(0.14 / 0.25 * SCENE.duration)
    assert gone_on.time[-1] == pytest.approx((0.14 + revolutions) / 0.25 * SCENE.duration)
    assert not checkpoint_directory(killed / "run.nc").exists()
    with pytest.warns(UserWarning, match=r"has 0\.14 revolutions"):
        assert Result.load(killed / "run.nc.unfinished.1").completed
    assert gone_on.info["provenance"]["start"] == "o/run.nc.unfinished.1"


def test_a_run_from_elsewhere_does_not_take_the_place_of_blocks(killed, folder, capsys):
    assert main([*RUN[:-1], "p", "--set", "revolutions=0.02"]) == 0
    assert main([*RUN, "--from", "p"]) == 2
    assert "finished blocks" in capsys.readouterr().err


def test_blocks_are_deleted_where_that_is_asked_for(killed):
    assert main([*RUN, "--overwrite"]) == 0
    assert sorted(path.name for path in killed.iterdir()) == [".lock", "run.nc", "summary.json"]
    assert Result.load(killed / "run.nc").time[-1] == pytest.approx(SCENE.duration)


def test_a_second_run_in_the_same_directory_is_refused(folder, capsys):
    process = held(folder, 1)
    assert main(RUN) == 2
    assert "o: another run is writing here" in capsys.readouterr().err
    assert main([*RUN, "--overwrite"]) == 2
    assert main(["compare", "scene.toml", "--out", "o"]) == 2
    (folder / "held").unlink()
    assert process.wait(60) == 0
    assert Result.load(folder / "o" / "run.nc").time[-1] == pytest.approx(SCENE.duration)
    assert main(RUN) == 0  # a run that has ended locks nobody out


@pytest.mark.parametrize("how", ["interrupted", "stopped", "killed"])
def test_a_run_that_ended_in_its_first_block_does_not_block_the_next(folder, how):
    """None of its blocks is finished."""
    if how == "stopped":
        assert main([*RUN, "--set", "solver.max_steps=50"]) == 3
    else:
        code = HELD.replace("keep(*arguments)", "pass")
        process = subprocess.Popen([sys.executable, "-c", code, "1", *RUN])
        while not (folder / "held").exists():
            time.sleep(0.01)
        process.send_signal(signal.SIGINT if how == "interrupted" else signal.SIGKILL)
        process.wait(60)
        (folder / "held").unlink()
    assert main(RUN) == 0
    assert sorted(path.name for path in (folder / "o").iterdir()) == [
        ".lock",
        "run.nc",
        "summary.json",
    ]


def test_a_link_in_the_place_of_blocks_is_not_followed(folder, capsys):
    (folder / "outside").mkdir()
    (folder / "outside" / "notes.txt").write_text("mine")
    (folder / "o").mkdir()
    (folder / "o" / "run.nc.unfinished").symlink_to(folder / "outside")
    for options in ([], ["--overwrite"]):
        assert main([*RUN, *options]) == 2
        assert "run.nc.unfinished: is a link" in capsys.readouterr().err
    assert [path.name for path in (folder / "outside").iterdir()] == ["notes.txt"]
