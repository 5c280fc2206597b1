"""What a run's file keeps: channels, steps and samples, with quantities read of all of them."""

import numpy as np
import pytest

from exu_press import InputError, Result, Scene, simulate
from exu_press.cli.main import main

SCENE = Scene(
    mechanism="slider_crank",
    joints={"crank_pin": {"kind": "dry", "clearance": 1e-4, "radius": 0.03}},
    contact={"length": 0.05},
    revolutions=0.4,
    solver={"tolerance": 1e-2},
)


def kept(tmp_path, **output):
    run = simulate(SCENE.replace({"output": output}))
    run.save(tmp_path / "run.nc")
    return run, Result.load(tmp_path / "run.nc")


def test_quantities_do_not_depend_on_the_channels_kept(tmp_path):
    run, loaded = kept(tmp_path, channels=[])
    assert set(loaded) == {"time", "crank_angle"}
    assert loaded.summary() == run.summary()
    assert loaded.summary()["quantities"]["stroke"]["value"] > 0.0
    loaded.save(tmp_path / "again.nc")
    assert Result.load(tmp_path / "again.nc").summary() == run.summary()


def test_patterns_and_density(tmp_path):
    run, loaded = kept(tmp_path, channels=["crank_pin_*", "slider_position"], every=7)
    assert "crank_pin_force" in loaded
    assert "slider_velocity" not in loaded
    assert np.array_equal(loaded.time[:-1], run.time[:-1:7])
    assert loaded.time[-1] == run.time[-1]
    assert np.array_equal(loaded["crank_pin_force"][:-1], run["crank_pin_force"][:-1:7])
    assert loaded.joints["crank_pin"].clearance == 1e-4


def test_samples_have_every_channel_whatever_is_kept(tmp_path):
    run, loaded = kept(tmp_path, channels=[], samples=[0.0, 90.0], every=1000)
    assert len(loaded.time) < len(run.time) / 100
    for name in run:
        assert np.array_equal(loaded.samples[name], run.samples[name]), name
    assert loaded.samples.revolution.tolist() == run.samples.revolution.tolist()


def test_what_was_not_kept_is_said_with_its_cure(tmp_path, capsys):
    _, loaded = kept(tmp_path, channels=["slider_position"])
    with pytest.raises(InputError, match=r"'slider_tilt': was not kept; keep it by \[output\]"):
        loaded["slider_tilt"]
    assert main(["spectrum", str(tmp_path / "run.nc"), "slider_tilt"]) == 2
    assert "Traceback" not in capsys.readouterr().err


def test_an_unknown_channel_is_refused_before_the_run():
    scene = SCENE.replace({"output": {"channels": ["slider_positon"]}, "revolutions": 1e6})
    with pytest.raises(InputError, match="is no channel of this scene"):
        simulate(scene)
