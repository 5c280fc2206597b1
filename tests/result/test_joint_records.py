"""result.joints: any joint with clearance, on the frame and between links; its recorded states."""

import functools

import numpy as np
import pytest

from exu_press import InputError, Scene, simulate
from exu_press.joints import user_force_of
from exu_press.joints.history import history
from exu_press.joints.joint import GROUND as STILL
from exu_press.mechanism import GROUND
from exu_press.model import build
from exu_press.result.motion import sensor
from exu_press.scene import mechanism_of

SCENES = {
    "shaft": {"shaft": "lubricated", "crank_pin": "lubricated"},
    "frame": {"shaft": "dry", "pivots": {"kind": "dry", "clearance": 5.1e-5}},
    "both ends of a link": {"crank_pin": "dry", "slide_pin": "lubricated"},
    "unlike balls": {"balls": "dry", "ball_left": {"clearance": 2e-4}},
    "many": {"knuckles": "dry", "plunger_pins": "lubricated", "slide_joints": "dry"},
}


@functools.cache
def run(name):
    result = simulate(Scene(joints=SCENES[name], revolutions=0.05))
    assert result.completed, result.info["reason"]
    return result


def world(result, body, point):
    if body == GROUND:
        return np.array([point])
    x, y, angle = result["body_position"][:, result.bodies.index(body)].T
    return np.column_stack(
        [
            x + np.cos(angle) * point[0] - np.sin(angle) * point[1],
            y + np.sin(angle) * point[0] + np.cos(angle) * point[1],
        ]
    )


@pytest.mark.parametrize(
    "name", [pytest.param(n, marks=[pytest.mark.long] * (n in ("shaft", "many"))) for n in SCENES]
)
def test_eccentricities_are_where_the_bodies_are_and_joints_alone_lose_energy(name):
    """Journal centre minus bearing centre, from the bodies' recorded poses; ideal joints meet."""
    result = run(name)
    mechanism = mechanism_of(result.scene)
    for joint in mechanism.joints:
        record = result.joints[joint.name]
        journal, bearing = mechanism.ends(joint)
        apart = world(result, *journal) - world(result, *bearing)
        assert np.abs(record.eccentricity[:, :2] - apart).max() < 2e-9, joint.name
    assert result.quantity("energy.residual").value < 1e-3
    lost = {n: result.quantity(f"joints.{n}.dissipated").value for n in result.clearance_joints}
    assert sum(lost.values()) == pytest.approx(result["energy_dissipated"][-1], rel=1e-12)
    for joint, energy in lost.items():
        power = result.joints[joint].dissipated_power
        assert np.trapezoid(power, result.time) == pytest.approx(energy, rel=0.3)


def test_a_record_holds_all_of_a_joint():
    result = run("both ends of a link")
    pin, n = result.joints["crank_pin"], len(result.time)
    assert (pin.kind, pin.clearance, pin.spherical) == ("dry", 1e-4, False)
    assert pin.force.shape == pin.eccentricity.shape == pin.moment.shape == (n, 2)
    assert pin.gap.shape == pin.dissipated_power.shape == (n,)
    assert np.array_equal(pin.gap, 1e-4 - np.linalg.norm(pin.eccentricity, axis=1))
    touching = pin.gap < 0.0
    assert touching.any() and np.all(pin.force[pin.gap > 0.0] == 0.0)
    assert np.abs(pin.moment[touching]).max() > 0.0, "friction at the journal's surface"
    ideal = result.joints["pivot_left"]
    assert ideal.kind == "ideal" and np.abs(ideal.force).max() > 0.0
    assert not ideal.eccentricity.any() and not ideal.gap.any() and not ideal.moment.any()
    assert result.joints["ball_left"].spherical and result.joints["ball_left"].force.shape == (n, 3)


@pytest.mark.long
@pytest.mark.parametrize("clearance", [4.8e-5, 6e-5])
def test_contacts_on_the_frame_do_not_chase_rounding(clearance):
    """Newton's method leaves 1e-11 m in positions; steps that resolve less end below the least."""
    joints = {"shaft": "dry", "pivots": {"kind": "dry", "clearance": clearance}}
    result = simulate(Scene(joints=joints, revolutions=0.05))
    assert result.completed, result.info["reason"]


def test_a_crank_that_rests_in_two_bearings_has_no_clearance_there():
    scene = Scene(bodies={"crank": {"flexible": "crank", "modes": 0}}, joints={"shaft": "dry"})
    with pytest.raises(InputError, match=r"joints\.shaft: holds 2 faces .* allowed is 'ideal'"):
        simulate(scene)


LUBRICATED = Scene.from_dict(
    {
        "mechanism": "slider_crank",
        "joints": {"crank_pin": "lubricated"},
        "film": {"law": "finite"},
        "revolutions": 0.1,
    }
)


@pytest.fixture
def oiled():
    model = build(LUBRICATED)
    model.solve()
    return model, sensor(model, model.mechanism.slider, "position", with_time=True)[:, 0]


def test_they_are_those_of_the_recorded_coordinates(oiled):
    """To the last bit: a film has no memory."""
    model, time = oiled
    joint = model.clearance_joints["crank_pin"]
    states = history(model.states, joint, time)
    names = {number: name for name, number in model.nodes.items()}
    q, q_t = (
        np.hstack([sensor(model, names[node], level) for node in user_force_of(model.mbs).nodes])
        for level in ("position", "velocity")
    )
    for i in range(0, len(time), 7):
        out = [0.0] * (q.shape[1] + len(STILL))
        joint.add_force([*q[i], *STILL], [*q_t[i], *STILL], out)
        assert joint.state.force == tuple(states.force[i])
        assert joint.state.eccentricity == tuple(states.eccentricity[i])
        assert joint.state.power == states.power[i]


def test_some_instants_may_be_left_out(oiled):
    model, time = oiled
    joint = model.clearance_joints["crank_pin"]
    whole, part = (history(model.states, joint, instants) for instants in (time, time[::3]))
    assert np.array_equal(part.force, whole.force[::3])
    assert whole.rubbing.shape == part.rubbing.shape == (0, 2)
