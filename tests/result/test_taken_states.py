"""The states of joints are those of the steps' ends, as the integration left them."""

import numpy as np
import pytest

from exu_press import Scene
from exu_press.joints import user_force_of
from exu_press.joints.history import history
from exu_press.joints.joint import GROUND
from exu_press.model import build
from exu_press.result.motion import sensor

LUBRICATED = Scene.from_dict(
    {
        "mechanism": "slider_crank",
        "joints": {"crank_pin": "lubricated"},
        "film": {"law": "finite"},
        "revolutions": 0.1,
    }
)


@pytest.fixture
def run():
    model = build(LUBRICATED)
    model.solve()
    return model, sensor(model, model.mechanism.slider, "position", with_time=True)[:, 0]


def test_they_are_those_of_the_recorded_coordinates(run):
    """To the last bit: a film has no memory."""
    model, time = run
    joint = model.clearance_joints["crank_pin"]
    states = history(model.states, joint, time)
    names = {number: name for name, number in model.nodes.items()}
    q, q_t = (
        np.hstack([sensor(model, names[node], level) for node in user_force_of(model.mbs).nodes])
        for level in ("position", "velocity")
    )
    for i in range(0, len(time), 7):
        out = [0.0] * (q.shape[1] + len(GROUND))
        joint.add_force([*q[i], *GROUND], [*q_t[i], *GROUND], out)
        assert joint.state.force == tuple(states.force[i])
        assert joint.state.eccentricity == tuple(states.eccentricity[i])
        assert joint.state.power == states.power[i]


def test_some_instants_may_be_left_out(run):
    model, time = run
    joint = model.clearance_joints["crank_pin"]
    whole, part = (history(model.states, joint, instants) for instants in (time, time[::3]))
    assert np.array_equal(part.force, whole.force[::3])
    assert whole.rubbing.shape == part.rubbing.shape == (0, 2)
