"""result.joints: any joint of the mechanism with clearance, on the frame and between links."""

import functools

import numpy as np
import pytest

from exu_press import InputError, Scene, simulate
from exu_press.mechanism import GROUND
from exu_press.scene import mechanism_of

SCENES = {
    "shaft": {"shaft": "lubricated", "crank_pin": "lubricated"},
    "frame": {"shaft": "dry", "pivots": {"kind": "dry", "clearance": 5e-5}},
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


FEW = [pytest.param(n, marks=[pytest.mark.long] * (n == "many")) for n in SCENES]


@pytest.mark.parametrize("name", FEW)
def test_eccentricities_are_where_the_bodies_are(name):
    """Journal centre minus bearing centre, from the bodies' recorded poses; ideal joints meet."""
    result = run(name)
    mechanism = mechanism_of(result.scene)
    for joint in mechanism.joints:
        record = result.joints[joint.name]
        journal, bearing = mechanism.ends(joint)
        apart = world(result, *journal) - world(result, *bearing)
        assert np.abs(record.eccentricity[:, :2] - apart).max() < 2e-9, joint.name
        assert record.clearance == result.scene.joints[joint.name].clearance


@pytest.mark.parametrize("name", FEW)
def test_energy_is_balanced_and_lost_in_the_joints_alone(name):
    result = run(name)
    assert result.quantity("energy.residual").value < 1e-3
    lost = sum(_dissipated(result, name) for name in result.clearance_joints)
    assert lost == pytest.approx(result["energy_dissipated"][-1], rel=1e-12)
    assert lost > 0.0
    for name in result.clearance_joints:
        integral = np.trapezoid(result.joints[name].dissipated_power, result.time)
        assert integral == pytest.approx(_dissipated(result, name), rel=0.3)


def _dissipated(result, joint):
    return result.quantity(f"joints.{joint}.dissipated").value


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


@pytest.mark.parametrize(
    "clearance", [5.1e-5, *(pytest.param(c, marks=pytest.mark.long) for c in (4.8e-5, 6e-5))]
)
def test_contacts_on_the_frame_do_not_chase_rounding(clearance):
    """Newton's method leaves 1e-11 m in positions; steps that resolve less end below the least."""
    joints = {"shaft": "dry", "pivots": {"kind": "dry", "clearance": clearance}}
    result = simulate(Scene(joints=joints, revolutions=0.05))
    assert result.completed, result.info["reason"]


def test_a_stiff_joint_on_the_frame_is_nearly_ideal():
    """A film of ten micrometres in shaft and pivots lets the slider go astray by less."""
    film = {"kind": "lubricated", "clearance": 1e-5}
    joints = {"shaft": film, "pivots": film}
    result = simulate(Scene(joints=joints, revolutions=0.05, solver={"tolerance": 1e-4}))
    angle = result["crank_angle"]
    ideal = mechanism_of(result.scene).ideal_slider(angle, result.scene.angular_speed)[0]
    assert 1e-10 < np.abs(result["slider_position"] - ideal).max() < 1e-6


def test_a_crank_that_rests_in_two_bearings_has_no_clearance_there():
    scene = Scene(bodies={"crank": {"flexible": "crank", "modes": 0}}, joints={"shaft": "dry"})
    with pytest.raises(InputError, match=r"joints\.shaft: holds 2 faces .* allowed is 'ideal'"):
        simulate(scene)
