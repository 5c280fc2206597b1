"""Runs of many revolutions: memory holds one block, the disk the channels."""

import pickle
import random
import shutil
import subprocess
import sys

import numpy as np
import pytest

from exu_press import InputError, Result, Scene, simulate
from exu_press.cli import main
from exu_press.files.output_directory import checkpoint_directory
from exu_press.report import Kind, find_output
from exu_press.result import channels, run
from exu_press.result.channel import Channel
from exu_press.result.channels import (
    LazyChannels,
    MemmapChannels,
    channel_headers,
    is_on_disk,
    read_columns,
    read_rows,
)
from exu_press.result.checkpoint import remove
from exu_press.result.windows import settled_part

FILM = {"crank_pin": {"kind": "lubricated", "clearance": 5e-5, "radius": 0.07}}
SCENE = Scene.from_dict(
    {
        "mechanism": "slider_crank",
        "joints": FILM,
        "film": {"viscosity": 0.1, "length": 0.1},
        "revolutions": 1.25,
    }
)


@pytest.fixture(scope="module")
def whole():
    return simulate(SCENE)


@pytest.fixture(scope="module")
def blocks():
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(run, "BLOCK", 0.35)
        return simulate(SCENE)


@pytest.fixture
def short_blocks(monkeypatch):
    monkeypatch.setattr(run, "BLOCK", 0.35)


def test_blocks_are_one_run(whole, blocks):
    """They differ by the steps that end where a block does, within the tolerance."""
    assert isinstance(blocks.channels, MemmapChannels)
    assert not isinstance(whole.channels, MemmapChannels)
    assert blocks.completed
    assert list(blocks) == list(whole)
    assert blocks.time[-1] == pytest.approx(SCENE.duration, rel=1e-12)
    assert (np.diff(blocks.time) > 0.0).all()
    assert len(blocks.time) == blocks.info["steps"] + 1
    for name in ("crank_angle", "energy_input", "energy_dissipated", "crank_pin_loss"):
        there = np.interp(whole.time, blocks.time, blocks[name])
        assert there == pytest.approx(whole[name], abs=2e-4 * np.ptp(whole[name])), name
    for name, told in whole.summary()["quantities"].items():
        if name in ("stroke", "peak_velocity", "joints.crank_pin.peak_force", "energy.dissipated"):
            again = blocks.quantity(name).value
            assert again == pytest.approx(told["value"], rel=1e-3), name


def test_a_long_run_is_saved_and_sent_whole(blocks, tmp_path):
    blocks.save(tmp_path / "run.nc")
    for again in (Result.load(tmp_path / "run.nc"), pickle.loads(pickle.dumps(blocks))):
        assert again.scene == blocks.scene
        assert all(np.array_equal(again[name], blocks[name]) for name in blocks)
    assert settled_part(blocks.map_values(lambda _, values: values)).time[0] == blocks.time[0]


def test_what_is_changed_of_the_disk_stays_there(blocks):
    twice = blocks.with_values({"drive_torque": 2.0 * blocks["drive_torque"]})
    assert isinstance(twice.channels, LazyChannels)
    assert is_on_disk(twice.channels)
    assert np.array_equal(twice["drive_torque"], 2.0 * blocks["drive_torque"])
    assert twice["crank_speed"] == pytest.approx(blocks["crank_speed"])
    assert all(not len(channel.values) for channel in channel_headers(twice.channels).values())
    assert twice.units == blocks.units


def test_files_go_with_the_run(short_blocks):
    blocks = simulate(SCENE.replace({"revolutions": 0.75}))
    folder = blocks.channels._file("time").parent
    assert folder.exists()
    del blocks
    assert not folder.exists()


KILLED = """
import os, sys
from exu_press import Scene, simulate
from exu_press.result import blocks, run
run.BLOCK = 0.35
kept, count = blocks.write_checkpoint, []
def keep(*arguments):
    kept(*arguments)
    count.append(1)
    if len(count) == 2:
        os.kill(os.getpid(), 9)
blocks.write_checkpoint = keep
simulate(Scene.load(sys.argv[1]), unfinished=sys.argv[2])
"""


@pytest.fixture(scope="module")
def killed(tmp_path_factory):
    """The place of a run whose process was killed within its third block."""
    place = tmp_path_factory.mktemp("killed")
    SCENE.save(place / "scene.toml")
    left = checkpoint_directory(place / "run.nc")
    done = subprocess.run(
        [sys.executable, "-c", KILLED, place / "scene.toml", left], check=False, timeout=300
    )
    assert done.returncode == -9
    return place


def test_a_killed_run_leaves_what_it_had_and_goes_on(whole, killed, tmp_path):
    with pytest.warns(UserWarning, match=r"was killed; it has 0\.7 revolutions"):
        left = Result.load(killed / "run.nc")
    assert left.completed
    assert left.scene == SCENE.replace({"revolutions": 0.7})
    assert left.time[-1] == pytest.approx(0.56 * SCENE.duration, rel=1e-12)
    before = whole.time <= left.time[-1]
    there = np.interp(whole.time[before], left.time, left["crank_angle"])
    assert there == pytest.approx(whole["crank_angle"][before], abs=1e-6)
    left.save(tmp_path / "run.nc")
    again = Result.load(tmp_path / "run.nc")
    assert all(np.array_equal(again[name], left[name]) for name in left)
    rest = simulate(SCENE.replace({"revolutions": 0.55}), start=left.info["state"])
    assert rest.time[-1] == pytest.approx(SCENE.duration, rel=1e-9)
    assert rest["slider_position"][-1] == pytest.approx(whole["slider_position"][-1], abs=1e-7)


def test_commands_read_what_a_killed_run_left(killed, tmp_path):
    assert find_output(killed) == (Kind.RUN, killed / "run.nc")
    given = ["compare", str(killed), str(killed), "--no-pictures", "--quiet"]
    with pytest.warns(UserWarning, match="was killed"):
        assert main([*given, "--out", str(tmp_path / "out")]) == 0


def test_a_killed_run_is_not_taken_for_the_one_before(whole, killed, tmp_path):
    shutil.copytree(
        checkpoint_directory(killed / "run.nc"), checkpoint_directory(tmp_path / "run.nc")
    )
    whole.save(tmp_path / "run.nc")
    with pytest.warns(UserWarning, match="an earlier run's"):
        assert Result.load(tmp_path / "run.nc").scene == SCENE
    remove(checkpoint_directory(tmp_path / "run.nc"))
    assert [file.name for file in tmp_path.iterdir()] == ["run.nc"]


def test_damage_of_a_block_is_noticed_when_it_is_read(killed, tmp_path):
    """A bit of each of 40 places, named by its file; other channels are still there."""
    left = shutil.copytree(checkpoint_directory(killed / "run.nc"), tmp_path / "left")
    count = (left / "slider_tilt").stat().st_size // 8
    by = random.Random(69)
    for _ in range(40):
        name, width = by.choice([("crank_angle", 8), ("crank_pin_force", 16)])
        whole = (left / name).read_bytes()
        damaged = bytearray(whole)
        damaged[by.randrange(int(0.9 * count) * width)] ^= 1 << by.randrange(8)
        (left / name).write_bytes(damaged)
        with pytest.warns(UserWarning, match="was killed"):
            run = Result.load(left)
        assert len(run["slider_position"]) == run.channels.count
        with pytest.raises(InputError, match=f"left/{name}: damaged"):
            run[name]
        (left / name).write_bytes(whole)
    (left / "time").write_bytes((left / "time").read_bytes()[:800])
    with (
        pytest.warns(UserWarning, match="was killed"),
        pytest.raises(InputError, match="left/time: not a whole channel"),
    ):
        Result.load(left)["time"]


def test_another_directory_is_not_removed(tmp_path):
    (tmp_path / "notes.txt").write_text("mine")
    with pytest.raises(InputError, match="has other files"):
        simulate(SCENE.replace({"revolutions": 11.0}), unfinished=tmp_path)
    assert (tmp_path / "notes.txt").read_text() == "mine"


def test_instants_are_picked_across_parts(monkeypatch):
    monkeypatch.setattr(channels, "AT_ONCE", 4)
    found, values = MemmapChannels(), np.arange(22.0).reshape(11, 2)
    found.append(
        {"time": Channel(np.arange(11.0), "s", "time"), "x": Channel(values, "m", "x", "plane")}
    )
    rows = np.array([0, 3, 4, 4, 10])
    assert np.array_equal(read_rows(found, "x", rows), values[rows])
    assert np.array_equal(read_rows(found, "x", rows[:0]), values[:0])
    assert np.array_equal(read_columns(found, "x", lambda part: part[:, 1]), values[:, 1])
