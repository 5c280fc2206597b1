"""A result's channels, status and summary; every channel is declared, with its direction."""

import re
from dataclasses import replace

import numpy as np
import pytest

from exu_press import Scene, simulate
from exu_press.mechanism import Guide, shipped_mechanism
from exu_press.result.channel import direction_text
from exu_press.result.recorders import expected_channels

FACE = re.compile(r"_\d+_force$")
"""One face of several of a joint."""

SCENES = {
    "ideal": {"joints": {}},
    "mixed joints": {
        "joints": {"crank_pin": "lubricated", "balls": "dry"},
        "load": {"die": {"kind": "blanking", "force": 1e3}},
    },
    "motor and guideway": {
        "mechanism": "slider_crank",
        "drive": {"rated_torque": 50.0, "slip": 0.05, "inertia": 1.0},
        "guide": {"clearance": 1e-4, "length": 0.2, "width": 0.1},
    },
}


@pytest.mark.parametrize("name", SCENES)
def test_a_run_has_the_declared_channels(name):
    scene = Scene.from_dict({**SCENES[name], "revolutions": 1e-3})
    run = simulate(scene)
    expected = expected_channels(scene, own_items=False)
    assert {channel for channel, (_, always) in expected.items() if always} <= set(run)
    for channel_name, channel in run.channels.items():
        if not FACE.search(channel_name):
            assert channel.axis == expected[channel_name][0], channel_name


def test_the_positive_direction_is_that_of_output_and_guide():
    """To the right of a guide along +x is down."""
    mechanism = shipped_mechanism("four_bar")
    for direction, text in (
        ((0.0, -1.0), "downwards"),
        ((3.0, 4.0), "along [0.6, 0.8]"),
    ):
        turned = replace(mechanism, output=replace(mechanism.output, direction=direction))
        run = simulate(Scene(mechanism=turned, joints={}, revolutions=0.01))
        assert run.channels["slider_position"].long_name == f"slider position, {text}"
    assert direction_text(Guide("ram", direction=(1.0, 0.0)).normal) == "downwards"
    run = simulate(Scene(mechanism="slider_crank", joints={}, revolutions=0.01))
    meaning = run.channels["guide_force"].long_name
    assert meaning == "slider guide: force on the body, to the right"


SCENE = {"mechanism": "press", "revolutions": 0.02, "solver": {"step": 1e-4}}


@pytest.fixture(scope="module")
def result():
    return simulate(
        Scene.from_dict({**SCENE, "load": {"blanking": {"kind": "blanking", "force": 1e4}}})
    )


def test_time_holds_every_step_from_the_ideal_mechanism_with_centred_journals_on(result):
    assert result.time[0] == 0.0
    assert result.time[-1] == pytest.approx(result.scene.duration, rel=1e-9)
    assert len(result.time) == result.info["steps"] + 1
    assert np.all(np.diff(result.time) > 0.0)
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
