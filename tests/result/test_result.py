"""A result's channels, status and summary."""

import numpy as np
import pytest

from exu_press import Scene, simulate

SCENE = {"mechanism": "press", "revolutions": 0.02, "solver": {"step": 1e-4}}


@pytest.fixture(scope="module")
def result():
    return simulate(
        Scene.from_dict({**SCENE, "load": {"blanking": {"kind": "blanking", "force": 1e4}}})
    )


def test_time_holds_the_start_and_every_step(result):
    assert result.time[0] == 0.0
    assert result.time[-1] == pytest.approx(result.scene.duration, rel=1e-9)
    assert len(result.time) == result.info["steps"] + 1
    assert np.all(np.diff(result.time) > 0.0)


def test_run_starts_on_the_ideal_mechanism_with_centred_journals(result):
    for joint in result.clearance_joints:
        assert np.abs(result[f"{joint}_eccentricity"][0]).max() < 1e-12
    assert result["slider_position"][0] == pytest.approx(0.47 + 26.19e-3, abs=0.02e-3)
    assert result["slider_velocity"][0] == pytest.approx(0.0, abs=1e-9)


def test_summary_has_what_the_interface_promises(result):
    summary = result.summary()
    assert summary["status"] == "completed"
    assert summary["reason"] == ""
    assert summary["cost"]["bodies"] == 14
    assert (
        summary["cost"]["coordinates"] == 5 + 3 + 6 * 3
    )  # sliding, on pivots of the frame, others
    assert summary["cost"]["newton_iterations"] >= summary["cost"]["steps"] > 0
    assert summary["cost"]["law_evaluations"] > summary["cost"]["steps"]
    assert summary["cost"]["total_time"] >= summary["cost"]["wall_time"] > 0.0
    values = summary["quantities"]
    assert {"value", "unit", "error", "low", "high", "determined"} == set(values["stroke"])
    assert values["joints.crank_pin.peak_force"]["unit"] == "N"
    assert not any(name.startswith("cost.") for name in values)
