"""What a run keeps: samples at crank angles, parts of its record, channels in its file."""

import numpy as np
import pytest

from exu_press import InputError, Result, Scene, simulate
from exu_press.cli.main import main
from exu_press.result.windows import at_instant, revolutions_of, up_to

ANGLES = (0.0, 90.0, 200.0)
DRY = Scene(
    mechanism="slider_crank",
    joints={"crank_pin": {"kind": "dry", "clearance": 1e-4, "radius": 0.03}},
    contact={"length": 0.05},
    revolutions=1.25,
    start_angle_deg=30.0,
    output={"samples": ANGLES},
    solver={"tolerance": 1e-2},
)
MOTOR = {"drive": {"rated_torque": 200.0, "inertia": 2.0}, "joints.crank_pin": "ideal"}


@pytest.mark.parametrize("change", [{}, MOTOR], ids=["constant speed", "motor"])
def test_steps_end_on_the_angles(change, tmp_path):
    run = simulate(DRY.replace(change))
    assert run.completed
    samples = run.samples
    turned = np.degrees(samples["crank_angle"]) - samples.angle_deg
    off = turned - 360.0 * np.round(turned / 360.0)
    assert np.abs(off).max() < (3e-5 if change else 1e-7)
    assert len(samples.at_angle(90.0)) == 2
    assert samples.revolution.tolist() == sorted(samples.revolution.tolist())
    assert samples.angle_deg[:3].tolist() == [90.0, 200.0, 0.0], "from 30 deg on"
    assert samples["slider_position"].shape == (len(samples),)
    assert samples["crank_pin_force"].shape == (len(samples), 2)
    run.save(tmp_path / "run.nc")
    again = Result.load(tmp_path / "run.nc").samples
    assert np.array_equal(again["slider_velocity"], samples["slider_velocity"])


def test_samples_of_a_motors_crank_change_no_peak():
    """Without clearance the step behind a sample once took rounding for motion: 25 times the peak.

    The force in the shaft of an eccentric press is 62.4 kN.
    """
    motor = {"drive": {"rated_torque": 300.0, "inertia": 3.0}}
    press = Scene(mechanism="eccentric_press", joints={}, revolutions=0.5, **motor)
    for name in ("joints.shaft.peak_force", "peak_acceleration.resolved"):
        plain, sampled = (
            simulate(scene).quantity(name).value
            for scene in (press, press.replace({"output": {"samples": [0.0, 90.0]}}))
        )
        assert sampled == pytest.approx(plain, rel=2e-3), name


def test_samples_at_constant_speed_are_the_closed_forms():
    scene = DRY.replace({"joints.crank_pin": "ideal", "revolutions": 3.0, "start_angle_deg": 0.0})
    run = simulate(scene)
    positions = run.samples.at_angle(90.0)["slider_position"]
    assert len(positions) == 3
    assert np.ptp(positions) < 1e-9
    start = run.samples.at_angle(0.0)
    assert start["time"][0] == 0.0 and start.revolution.tolist()[:3] == [0, 1, 2]


def test_runs_without_samples_and_other_angles_are_refused():
    run = simulate(Scene(joints={}, revolutions=0.01))
    with pytest.raises(InputError, match="samples: this run has none"):
        run.samples  # noqa: B018
    sampled = simulate(Scene(joints={}, revolutions=0.01, output={"samples": [1.0]}))
    with pytest.raises(InputError, match="samples at 7 deg: this run has them at 1"):
        sampled.samples.at_angle(7.0)


PERIOD = 0.25
"""s, at 240 rpm."""


@pytest.fixture(scope="module")
def run():
    return simulate(Scene(mechanism="slider_crank", joints={}, revolutions=2.5))


@pytest.mark.parametrize("share", [0.0, 0.001, 0.5, 0.999, 1.0])
def test_between_samples_a_record_is_cubic(run, share):
    cubic = (run.time - 0.1) ** 3 + run.time
    instant = share * run.time[-1]
    found = at_instant(run.with_values({"energy_stored": cubic}), instant)
    assert found.time == pytest.approx([instant], abs=1e-12)
    assert found["energy_stored"] == pytest.approx([(instant - 0.1) ** 3 + instant])
    assert found["shaft_force"].shape == (1, 2)


def test_whole_revolutions_follow_each_other(run):
    first, second = revolutions_of(run)
    assert first.time[0] == 0.0
    assert first.time[-1] <= PERIOD <= second.time[-1] <= 2.0 * PERIOD
    assert PERIOD <= second.time[0] <= first.time[-1] + 2.0 * np.diff(run.time).max()
    assert np.ptp(second["crank_angle"]) == pytest.approx(2.0 * np.pi, abs=0.2)


def test_a_revolution_that_is_not_whole_is_none(run):
    assert revolutions_of(up_to(run, 0.99 * PERIOD)) == []
    assert len(revolutions_of(up_to(run, 1.99 * PERIOD))) == 1


CRANK = Scene(
    mechanism="slider_crank",
    joints={"crank_pin": {"kind": "dry", "clearance": 1e-4, "radius": 0.03}},
    contact={"length": 0.05},
    revolutions=0.4,
    solver={"tolerance": 1e-2},
)


def kept(tmp_path, **output):
    run = simulate(CRANK.replace({"output": output}))
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


def test_an_unknown_channel_is_refused_before_the_run(tmp_path):
    scene = CRANK.replace({"output": {"channels": ["slider_positon"]}, "revolutions": 1e6})
    scene.save(tmp_path / "scene.toml")
    for asked, file in ((scene, ""), (Scene.load(tmp_path / "scene.toml"), r".*scene\.toml: ")):
        with pytest.raises(InputError, match=f"^{file}output.channels: .* is no channel of this"):
            simulate(asked)
