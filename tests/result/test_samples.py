"""Samples at crank angles: steps end on them, of a motor's crank too."""

import numpy as np
import pytest

from exu_press import InputError, Result, Scene, simulate

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
