"""Every channel of a run is declared, and says which direction is positive."""

import re
from dataclasses import replace

import numpy as np
import pytest

from exu_press import Scene, simulate
from exu_press.mechanism import Guide, shipped_mechanism
from exu_press.result.channel import OWNERS, direction_text
from exu_press.result.ideal_joints import CHANNELS
from exu_press.result.recorders import declared_channels, expected_channels

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


def test_declarations_are_whole():
    names = [declared.name for declared in declared_channels()]
    assert len(names) == len(set(names)) > 50
    for declared in declared_channels():
        assert declared.owner in OWNERS
        assert declared.unit
        assert declared.meaning.format(**{declared.owner or "run": "NAME", "positive": "upwards"})


def test_a_channel_follows_its_declaration():
    ((name, channel),) = CHANNELS.record("ball_left", force=np.zeros((4, 3))).items()
    assert (name, channel.unit, channel.axis) == ("ball_left_force", "N", "space")
    assert channel.long_name == "ball left: force on journal"


def test_the_positive_direction_is_that_of_output_and_guide():
    """To the right of a guide along +x is down."""
    mechanism = shipped_mechanism("four_bar")
    for direction, text in (
        ((1.0, 0.0), "to the right"),
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
