"""[guide] that rubs, has clearance or oil: statics by hand, losses, balance, the frame's force."""

import functools

import numpy as np
import pytest
from pressed import by_statics, pressed_slider_crank

from exu_press import Scene, simulate
from exu_press.model.settings import scales
from exu_press.scene import mechanism_of

MU, FORCE, CLEARANCE = 0.2, 1e5, 2e-5
SIZES = {"clearance": CLEARANCE, "length": 0.3, "width": 0.1, "friction": "coulomb"}
OILED = {**SIZES, "viscosity": 0.1, "face_width": 0.08, "contact_gap": 2e-6}
RUBBING = {
    "ideal": ({}, {"revolutions": 1.0, "solver": {"max_step_deg": 0.3}}),
    "loose": (
        {"clearance": CLEARANCE},
        {"start_angle_deg": 20.0, "revolutions": 0.85, "contact": {"restitution": 0.1}}
        | {"solver": {"tolerance": 3e-4}},
    ),
}


@functools.cache
def pressed(kind):
    """Return a run under a constant force, and where it slides once it lies on its way."""
    keys, scene = RUBBING[kind]
    guide = {"friction": "coulomb", "mu_kinetic": MU} | keys
    result = pressed_slider_crank(FORCE, guide=guide, **scene)
    side, velocity, _ = by_statics(result, FORCE, MU)
    slides = np.abs(velocity) > 5e-3
    if kind == "loose":
        slides &= (result.time > 0.5) & (np.abs(side) > 500.0)
    assert slides.sum() > 100
    return result, slides


@pytest.mark.parametrize("kind", RUBBING)
def test_side_force_friction_and_torque_are_those_of_statics(kind):
    result, slides = pressed(kind)
    side, velocity, torque = by_statics(result, FORCE, MU)
    allowed = 5e-3 if kind == "loose" else 2e-3
    force = np.abs(result["guide_force"])
    assert np.abs(force - np.abs(side))[slides].max() < allowed * np.abs(side).max()
    friction = -MU * np.sign(velocity) * force
    off = np.abs(result["guide_friction"] - friction)[slides].max()
    assert off < 1e-3 * np.abs(friction).max()
    assert np.abs(result["drive_torque"] - torque)[slides].max() < allowed * np.abs(torque).max()


@pytest.mark.parametrize("kind", RUBBING)
def test_the_losses_are_the_work_of_friction(kind):
    """Over a revolution the constant load gives back what it took: the drive pays for friction."""
    result, _ = pressed(kind)
    lost = result.quantity("guides.slider.dissipated").value
    power = np.abs(result["guide_friction"] * result["slider_velocity"])
    assert lost == pytest.approx(np.trapezoid(power, result.time), rel=1e-2)
    assert lost > 20.0
    assert (np.diff(result["guide_loss"]) >= -1e-9).all()
    assert result.quantity("energy.residual").value < 1e-3
    assert result.quantity("energy.dissipated").value == pytest.approx(lost, rel=1e-3)
    if kind != "loose":
        driven = np.trapezoid(result["drive_power"], result.time)
        assert driven == pytest.approx(lost, rel=2e-3)
        power = result.quantity("guides.slider.mean_power").value
        assert power == pytest.approx(lost / result.time[-1], rel=1e-9)
        peak = MU * result.quantity("guides.slider.peak_force").value
        assert result.quantity("guides.slider.peak_friction").value == pytest.approx(peak, rel=1e-2)


def test_a_loose_slider_has_its_clearance_and_the_give_of_its_guideway():
    result, lies = pressed("loose")
    stiffness = result.scene.guide.support.lateral_stiffness
    expected = CLEARANCE + np.abs(result["guide_force"]) / stiffness
    assert np.abs(np.abs(result["slider_lateral"]) - expected)[lies].max() < 1e-7
    assert result["slider_lateral"].max() > CLEARANCE
    assert result["slider_lateral"].min() < -CLEARANCE


def test_the_film_of_a_pressed_slider_thins_until_contact_bears():
    thin = {**OILED, "viscosity": 0.001, "friction": "none"}
    result = pressed_slider_crank(FORCE, start_angle_deg=20.0, revolutions=1.0, guide=thin)
    gap, beside = result["guide_gap"], np.abs(result["slider_lateral"])
    assert result.quantity("guides.slider.min_film").value == max(0.0, gap.min())
    assert gap.max() > 1e-5 and gap.min() < 2e-6
    missed = result["energy_input"] - result["energy_stored"] - result["energy_dissipated"]
    assert np.abs(missed).max() < 1e-4 * np.abs(result["load_die_work"]).max()
    assert gap == pytest.approx(
        CLEARANCE - beside, abs=2e-9
    )  # the pin is the middle: hardly a tilt
    assert np.abs(result["guide_force"]).max() > 5e3


def test_the_drag_is_that_of_couettes_flow():
    """With the slider in the middle: 2 mu w L v / c."""
    result = simulate(Scene(mechanism="slider_crank", joints={}, revolutions=1.0, guide=OILED))
    expected = -2.0 * 0.1 * 0.08 * 0.3 / CLEARANCE * result["slider_velocity"]
    assert result["guide_friction"] == pytest.approx(expected, abs=2e-3 * np.abs(expected).max())
    lost = np.trapezoid(-expected * result["slider_velocity"], result.time)
    # across the film it is lost as well
    assert lost < result["guide_loss"][-1] < 1.01 * lost


IDEAL = {"joints": {}, "revolutions": 0.15}
OF_CRANK = {"mechanism": "slider_crank", "revolutions": 0.1}
OF_CRANK |= {"joints": {"crank_pin": "lubricated", "wrist_pin": "dry"}}
LOOSE = {"clearance": 5e-5, "width": 0.2}


@pytest.mark.parametrize(
    ("scene", "guide"),
    [
        (IDEAL, {"friction": "lugre"}),
        ({"revolutions": 0.025}, LOOSE | {"friction": "stribeck"}),
        (OF_CRANK, OILED),
    ],
)
def test_the_balance_closes(scene, guide):
    result = simulate(Scene(**scene, guide=guide))
    assert result.completed, result.info["reason"]
    assert result.quantity("energy.residual").value < (1e-4 if "width" in guide else 3e-3)
    guides = [guide.body for guide in mechanism_of(result.scene).guides]
    lost = [result.quantity(f"guides.{name}.dissipated").value for name in guides]
    assert max(lost) > 0.0
    in_joints = sum(result[f"{name}_loss"][-1] for name in result.clearance_joints)
    dissipated = result.quantity("energy.dissipated").value
    assert sum(lost) + in_joints == pytest.approx(dissipated, rel=1e-9)


@pytest.mark.parametrize("guide", [{"friction": "coulomb"}, OILED], ids=["rubs", "oiled"])
def test_the_frame_bears_what_guides_do(guide):
    """The forces on the frame are the weights and the inertia forces of all bodies."""
    keys = {"mechanism": "six_bar", "joints": {}, "speed_rpm": 60.0, "revolutions": 0.5}
    result = simulate(Scene(**keys, guide=guide))
    weight = sum(body.mass for body in mechanism_of(result.scene).bodies) * result.scene.gravity
    expected = result["shaking_force"] - np.array([0.0, weight])
    error = np.abs(result["frame_force"] - expected)[1:].max()
    assert error < 0.2 * result.scene.solver.tolerance * scales(result.scene).force
    friction = np.abs(result["guide_friction"]).max()
    assert friction > 0.01 * np.abs(result["shaking_force"]).max()


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
