"""[guide] with friction and without clearance: statics by hand, losses, balance of the press."""

import numpy as np
import pytest
from pressed import by_statics, pressed_slider_crank

from exu_press import Scene, simulate
from exu_press.mechanism import Body, Guide, Joint, Mechanism, Output
from exu_press.mechanism.parts import GROUND
from exu_press.scene import mechanism_of

MU, FORCE = 0.2, 1e5


@pytest.fixture(scope="module", params=["ideal", "elastic"])
def pressed(request):
    guide = {"friction": "coulomb", "mu_kinetic": MU}
    if request.param == "elastic":
        guide |= {"lateral_stiffness": 1e10}
    fine = {"max_step_deg": 0.3}
    return pressed_slider_crank(FORCE, revolutions=1.0, guide=guide, solver=fine)


def test_side_force_friction_and_torque_are_those_of_statics(pressed):
    side, velocity, torque = by_statics(pressed, FORCE, MU)
    side = np.abs(side)
    sliding = np.abs(velocity) > 4e-3
    assert sliding.sum() > 100
    assert np.abs(np.abs(pressed["guide_force"]) - side)[sliding].max() < 2e-3 * side.max()
    found = pressed["guide_friction"][sliding]
    assert np.abs(found + MU * side[sliding] * np.sign(velocity[sliding])).max() < 1e-3 * side.max()
    assert np.abs(pressed["drive_torque"] - torque)[sliding].max() < 2e-3 * np.abs(torque).max()


def test_the_losses_are_mu_times_the_side_force_times_the_way(pressed):
    """Over a revolution the constant load gives back what it took: the drive pays for friction."""
    power = MU * np.abs(pressed["guide_force"] * pressed["slider_velocity"])
    expected = np.trapezoid(power, pressed.time)
    lost = pressed.quantity("guides.slider.dissipated").value
    assert lost == pytest.approx(expected, rel=2e-2)  # smooth at rest
    assert lost > 50.0
    driven = np.trapezoid(pressed["drive_power"], pressed.time)
    assert driven == pytest.approx(lost, rel=2e-3)
    assert pressed.quantity("energy.dissipated").value == pytest.approx(lost, rel=1e-3)
    assert pressed.quantity("energy.residual").value < 1e-3
    assert (np.diff(pressed["guide_loss"]) >= -1e-9).all()
    assert pressed.quantity("guides.slider.peak_friction").value == pytest.approx(
        MU * pressed.quantity("guides.slider.peak_force").value, rel=1e-2
    )
    assert pressed.quantity("guides.slider.mean_power").value == pytest.approx(
        lost / pressed.time[-1], rel=1e-9
    )
    assert "drive.guide_friction_power" not in pressed.summary()["quantities"]


LAWS, CLEARANCES = (
    ("stribeck", "lugre_steady", "lugre"),
    {"crank_pin": "lubricated", "balls": "dry"},
)


@pytest.mark.parametrize(
    ("law", "joints"),
    [
        (LAWS[2], {}),
        (LAWS[0], CLEARANCES),
        *(pytest.param(law, {}, marks=pytest.mark.long) for law in LAWS[:2]),
        *(pytest.param(law, CLEARANCES, marks=pytest.mark.long) for law in LAWS[1:]),
    ],
)
def test_the_balance_of_the_press_closes(law, joints):
    result = simulate(Scene(joints=joints, revolutions=0.15, guide={"friction": law}))
    assert result.completed
    assert result.quantity("energy.residual").value < 3e-3
    guides = [guide.body for guide in mechanism_of(result.scene).guides]
    lost = [result.quantity(f"guides.{name}.dissipated").value for name in guides]
    assert min(lost) > 0.0
    in_joints = sum(result[f"{name}_loss"][-1] for name in result.clearance_joints)
    dissipated = result.quantity("energy.dissipated").value
    assert sum(lost) + in_joints == pytest.approx(dissipated, rel=1e-9)


def test_the_frame_bears_the_friction():
    """The forces on the frame are the weights and the inertia forces of all bodies."""
    result = simulate(
        Scene(mechanism="six_bar", joints={}, speed_rpm=60.0, guide={"friction": "coulomb"})
    )
    weight = sum(body.mass for body in mechanism_of(result.scene).bodies) * result.scene.gravity
    whole = result["frame_force"][:, 1] + weight
    shaking = result["shaking_force"][:, 1]
    assert np.abs(whole - shaking)[1:].max() < 1e-4 * np.abs(shaking).max()
    assert np.abs(result["guide_friction"]).max() > 0.01 * np.abs(shaking).max()


def test_lugre_in_guides_follows_the_scenes_bristles():
    """Softer bristles need a longer way to their friction: less is lost."""
    scene = {"mechanism": "slider_crank", "joints": {}, "guide": {"friction": "lugre"}}
    lost = [
        simulate(Scene(**scene, revolutions=1.0, friction={"sigma_0": stiffness})).quantity(
            "guides.slider.dissipated"
        )
        for stiffness in (10.0, 1e5)
    ]
    assert lost[0].value < 0.9 * lost[1].value


WATCH = Mechanism(
    name="slider_crank",
    bodies=(
        Body("crank", 0.025, 3.4e-7, (-0.0012, -0.0019)),
        Body("rod", 0.015, 9e-6, (-0.01, -0.028)),
        Body("ram", 0.049, 5.9e-6, (-0.015, -0.058)),
    ),
    joints=(
        Joint("shaft", (0.0, 0.0), GROUND, "crank"),
        Joint("crank_pin", (-0.0045, -0.003), "rod", "crank"),
        Joint("wrist_pin", (-0.0142, -0.0519), "ram", "rod"),
    ),
    guides=(Guide("ram"),),
    crank="crank",
    output=Output("ram"),
)


@pytest.mark.parametrize(
    "tolerance", [1e-4, *(pytest.param(t, marks=pytest.mark.long) for t in (1e-3, 1e-5))]
)
def test_a_crank_in_oil_takes_one_iteration_a_step_with_friction(tolerance):
    """At 1e-4 Newton's method failed within a microsecond, without derivatives by side forces."""
    run = simulate(
        Scene(
            mechanism=WATCH,
            speed_rpm=48.0,
            revolutions=0.01,
            start_angle_deg=143.0,
            start="centred",
            joints={"shaft": {"kind": "lubricated", "clearance": 2.4e-6, "radius": 1.4e-3}},
            film={"length": 0.004, "viscosity": 0.03},
            guide={"friction": "coulomb", "mu_kinetic": 0.1},
            solver={"tolerance": tolerance},
        )
    )
    assert run.completed
    tries = run.info["steps"] + run.info["rejected_steps"]
    assert run.info["newton_iterations"] < 1.2 * tries
