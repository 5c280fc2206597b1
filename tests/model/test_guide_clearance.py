"""[guide] with clearance: Coulomb's law in a slider-crank, contact, energy."""

import numpy as np
import pytest
from pressed import by_statics, pressed_slider_crank

from exu_press import Scene, simulate
from exu_press.scene import mechanism_of

MU, FORCE, CLEARANCE = 0.2, 1e5, 2e-5


@pytest.fixture(scope="module")
def pressed():
    guide = {"clearance": CLEARANCE, "friction": "coulomb", "mu_kinetic": MU}
    calm = {"contact": {"restitution": 0.1}, "solver": {"tolerance": 1e-4}}
    return pressed_slider_crank(FORCE, start_angle_deg=20.0, revolutions=0.85, guide=guide, **calm)


def test_side_force_friction_and_torque_are_those_of_statics(pressed):
    side, velocity, torque = by_statics(pressed, FORCE, MU)
    settled = (pressed.time > 0.5) & (np.abs(velocity) > 5e-3) & (np.abs(side) > 500.0)
    assert settled.sum() > 500
    scale = np.abs(side).max()
    assert np.abs(np.abs(pressed["guide_force"]) - np.abs(side))[settled].max() < 5e-3 * scale
    found = pressed["guide_friction"][settled]
    assert found == pytest.approx(
        -MU * np.sign(velocity[settled]) * np.abs(pressed["guide_force"][settled]), rel=1e-3
    )
    wrong = np.abs(pressed["drive_torque"] - torque)[settled].max()
    assert wrong < 5e-3 * np.abs(torque).max()


def test_the_losses_are_the_work_of_friction(pressed):
    power = np.abs(pressed["guide_friction"] * pressed["slider_velocity"])
    work = np.trapezoid(power, pressed.time)
    assert pressed["guide_loss"][-1] == pytest.approx(work, rel=1e-2)
    assert pressed["guide_loss"][-1] > 20.0
    summary = pressed.summary()
    assert summary["quantities"]["energy.residual"]["value"] < 2e-4
    assert summary["quantities"]["guides.slider.dissipated"]["value"] == pressed["guide_loss"][-1]
    assert summary["quantities"]["guides.slider.peak_friction"]["value"] > 1e3


def test_the_slider_has_its_clearance_and_the_give_of_its_guideway(pressed):
    stiffness = pressed.scene.guide.support.lateral_stiffness
    beside = np.abs(pressed["slider_lateral"])
    expected = CLEARANCE + np.abs(pressed["guide_force"]) / stiffness
    side, velocity, _ = by_statics(pressed, FORCE, MU)
    lying = (pressed.time > 0.5) & (np.abs(velocity) > 5e-3) & (np.abs(side) > 500.0)
    assert np.abs(beside - expected)[lying].max() < 1e-7
    assert pressed["slider_lateral"].max() > CLEARANCE
    assert pressed["slider_lateral"].min() < -CLEARANCE


@pytest.mark.parametrize(
    "friction",
    ["stribeck", *(pytest.param(law, marks=pytest.mark.long) for law in ("none", "lugre"))],
)
def test_the_balance_of_the_press_closes(friction):
    guide = {"clearance": 5e-5, "friction": friction, "width": 0.2}
    result = simulate(Scene(revolutions=0.025, guide=guide))
    assert result.completed
    summary = result.summary()
    assert summary["quantities"]["energy.residual"]["value"] < 1e-4
    guides = [guide.body for guide in mechanism_of(result.scene).guides]
    lost = sum(result.quantity(f"guides.{name}.dissipated").value for name in guides)
    joints = sum(result[f"{name}_loss"][-1] for name in result.clearance_joints)
    assert lost + joints == pytest.approx(
        summary["quantities"]["energy.dissipated"]["value"], rel=1e-9
    )


@pytest.mark.parametrize(
    "mechanism", ["eccentric_press", pytest.param("six_bar", marks=pytest.mark.long)]
)
def test_any_mechanisms_guides_have_it(mechanism):
    guide = {"clearance": 5e-5, "friction": "coulomb"}
    result = simulate(Scene(mechanism=mechanism, joints={}, revolutions=0.3, guide=guide))
    assert result.completed
    assert result.quantity("energy.residual").value < 1e-3
    guides = [guide.body for guide in mechanism_of(result.scene).guides]
    assert any(result.quantity(f"guides.{name}.peak_friction").value > 0.0 for name in guides)


def test_without_its_key_a_guide_is_another_one():
    loose = Scene(guide={"clearance": 1e-5, "friction": "coulomb"})
    elastic = Scene(guide={"lateral_stiffness": 1e9, "friction": "coulomb"})
    assert loose.replace({"guide.clearance": None}) == elastic
    assert Scene.from_dict(loose.to_dict()) == loose
