"""[guide] with oil: energy, the frame's force, quantities, starts, flexible bodies."""

import numpy as np
import pytest
from pressed import pressed_slider_crank

from exu_press import Scene, simulate
from exu_press.scene import flexible_press, mechanism_of
from exu_press.scene.warnings import scene_warnings
from exu_press.solving import scales

DRY = {"clearance": 2e-5, "length": 0.3, "width": 0.1, "friction": "coulomb"}
OILED = {**DRY, "viscosity": 0.1, "face_width": 0.08, "contact_gap": 2e-6}


@pytest.mark.parametrize("start", ["loaded", "centred"])
def test_the_balance_closes(start):
    joints = {"crank_pin": "lubricated", "wrist_pin": "dry"}
    scene = {"mechanism": "slider_crank", "joints": joints, "revolutions": 0.1, "start": start}
    result = simulate(Scene(guide=OILED, **scene))
    assert result.completed, result.info["reason"]
    assert result.quantity("energy.residual").value < 1e-3
    guides = [guide.body for guide in mechanism_of(result.scene).guides]
    lost = {name: result.quantity(f"guides.{name}.dissipated").value for name in guides}
    assert min(lost.values()) > 0.0
    joints = sum(result[f"{name}_loss"][-1] for name in result.clearance_joints)
    total = result.quantity("energy.dissipated").value
    assert sum(lost.values()) + joints == pytest.approx(total, rel=1e-9)


def test_frame_carries_inertia_and_weight():
    result = simulate(Scene(revolutions=0.1, joints={}, guide=OILED))
    weight = 9.81 * sum(body.mass for body in mechanism_of(result.scene).bodies)
    expected = result["shaking_force"].copy()
    expected[:, 1] -= weight
    error = np.abs(result["frame_force"] - expected).max()
    assert error < 0.2 * result.scene.solver.tolerance * scales(result.scene).force


@pytest.fixture(scope="module")
def pressed():
    """Return a slider pressed by 100 kN against thin oil, which films and contacts then share."""
    thin = {**OILED, "viscosity": 0.001, "friction": "none"}
    return pressed_slider_crank(1e5, start_angle_deg=20.0, revolutions=1.0, guide=thin)


def test_the_film_of_a_pressed_slider_thins_until_contact_bears(pressed):
    gap, force = pressed["guide_gap"], np.abs(pressed["guide_force"])
    assert pressed.quantity("guides.slider.min_film").value == max(0.0, gap.min())
    assert gap.max() > 1e-5
    assert gap.min() < 2e-6
    stored, lost = pressed["energy_stored"], pressed["energy_dissipated"]
    missed = np.abs(pressed["energy_input"] - stored - lost).max()
    assert missed < 1e-4 * np.abs(pressed["load_die_work"]).max()
    beside = np.abs(pressed["slider_lateral"])
    assert gap == pytest.approx(2e-5 - beside, abs=2e-9)  # the pin is the middle: hardly any tilt
    assert force.max() > 5e3


def test_the_drag_is_that_of_couettes_flow():
    """With the slider in the middle: 2 mu w L v / c."""
    result = simulate(Scene(mechanism="slider_crank", joints={}, revolutions=1.0, guide=OILED))
    expected = -2.0 * 0.1 * 0.08 * 0.3 / 2e-5 * result["slider_velocity"]
    assert result["guide_friction"] == pytest.approx(expected, abs=2e-3 * np.abs(expected).max())
    lost = np.trapezoid(-expected * result["slider_velocity"], result.time)
    # across the film it is lost as well
    assert lost < result["guide_loss"][-1] < 1.01 * lost


@pytest.mark.parametrize(
    "mechanism",
    [
        "six_bar",
        *(pytest.param(m, marks=pytest.mark.long) for m in ("eccentric_press", "drag_link")),
    ],
)
def test_any_mechanisms_guides_have_it(mechanism):
    result = simulate(Scene(mechanism=mechanism, joints={}, revolutions=0.3, guide=OILED))
    assert result.completed
    assert result.quantity("energy.residual").value < 1e-3
    for guide in mechanism_of(result.scene).guides:
        assert 0.0 < result.quantity(f"guides.{guide.body}.min_film").value < 2e-5


@pytest.mark.long
def test_flexible_bodies_have_it():
    pytest.importorskip("ngsolve")
    scene = {"joints": {}, "revolutions": 0.01, "guide": OILED}
    rigid, soft = (
        simulate(Scene.from_dict({**scene, **more}))
        for more in ({}, {"bodies": flexible_press(modes=4)})
    )
    assert soft.completed
    assert soft.quantity("energy.residual").value < 1e-3
    for name in ("slide_guide_friction", "plunger_left_guide_friction"):
        assert soft[name][-1] == pytest.approx(rigid[name][-1], rel=0.02)


def test_without_its_key_a_guide_is_another_one():
    scene = Scene(guide=OILED)
    assert Scene.from_dict(scene.to_dict()) == scene
    assert scene.replace({"guide.viscosity": None}) == Scene(guide=DRY)


def test_a_viscosity_of_no_oil_is_warned_about():
    said = scene_warnings(Scene(joints={}, guide={**OILED, "viscosity": 46.0}))
    assert any(line.startswith("guide.viscosity = 46 Pa s is above 2") for line in said)
    assert not any("guide.viscosity" in line for line in scene_warnings(Scene(guide=OILED)))
