"""Every channel of a run is declared."""

import re

import pytest

from exu_press import Scene, simulate
from exu_press.result.channel import AXES
from exu_press.result.declared import PLACES
from exu_press.result.ideal_joints import FORCE
from exu_press.result.recorders import all_declared, expected

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
def test_a_run_has_what_is_declared(name):
    scene = Scene.from_dict({**SCENES[name], "revolutions": 1e-3})
    run = simulate(scene)
    known = expected(scene, own_items=False)
    assert {one for one, (_, always) in known.items() if always} <= set(run)
    for shown, found in run.channels.items():
        if not FACE.search(shown):
            assert found.axis == known[shown][0], shown


def test_declarations_are_whole():
    names = [one.name for one in all_declared()]
    assert len(names) == len(set(names)) > 50
    for one in all_declared():
        assert one.of in PLACES
        assert one.unit
        assert one.meaning.format(**{one.of or "whole": "NAME", "way": "upwards"})


def test_a_channel_is_made_from_its_declaration():
    import numpy as np

    ((name, made),) = FORCE.record(np.zeros((4, 3)), "ball_left").items()
    assert (name, made.unit, made.axis) == ("ball_left_force", "N", "space")
    assert made.long_name == "ball left: force on journal"
    assert made.axis in AXES
