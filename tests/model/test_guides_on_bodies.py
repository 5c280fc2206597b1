"""Elastic, oiled and rubbing guides on moving bodies, against another model, limits and energy."""

import numpy as np
import pytest

from exu_press import Scene, simulate

MU = 0.3
OIL = {
    "clearance": 2e-5,
    "length": 0.08,
    "viscosity": 0.1,
    "face_width": 0.05,
    "contact_gap": 2e-6,
}


def run(mechanism, guide, **scene):
    tables = {"mechanism": mechanism, "joints": {}, "revolutions": 1.0, "guide": guide}
    result = simulate(Scene.from_dict({**tables, **scene}))
    assert result.completed
    return result


def by_hand(time, crank_speed):
    """Return side force, friction and crank torque of the inverted slider-crank with friction.

    The line of the arm passes its pivot at the distance h; the block lies on it at s. Moments
    about the pivot: N s - F h = (I_arm + m c^2 + I_block) phi'' - weight's.
    """
    pivot, h, gravity = np.array([0.03, -0.15]), -0.03, 9.81
    centre = np.array([-0.02, 0.1])  # of the arm's mass, from the pivot in the drawing

    def pose(at):
        angle = 0.5 * np.pi + crank_speed * at
        pin = 0.05 * np.column_stack([np.cos(angle), np.sin(angle)])
        x, y = (pin - pivot).T
        s = np.sqrt(x**2 + y**2 - h**2)
        turned = np.arctan2(y, x) - np.arctan2(s, h)
        return pin, s, np.unwrap(turned)

    step = 1e-4
    (pin, s, phi), ahead, behind = (pose(time + k * step) for k in (0, 1, -1))
    sliding = (ahead[1] - behind[1]) / (2.0 * step)
    angular = (ahead[2] - 2.0 * phi + behind[2]) / step**2
    acceleration = -(crank_speed**2) * pin
    c, sine = np.cos(phi), np.sin(phi)
    lever = c * centre[0] - sine * centre[1]
    moment = (0.012 + 2.0 * centre @ centre + 0.0003) * angular + 2.0 * gravity * lever
    normal = moment / (s + MU * np.sign(sliding) * h * np.sign(moment))
    friction = -MU * np.abs(normal) * np.sign(sliding)
    n, t = np.column_stack([c, sine]), np.column_stack([-sine, c])
    on_block = 0.6 * (acceleration + np.array([0.0, gravity]))
    on_block -= normal[:, None] * n + friction[:, None] * t
    torque = pin[:, 0] * on_block[:, 1] - pin[:, 1] * on_block[:, 0]
    return normal, friction, torque, sliding


@pytest.mark.parametrize(
    ("stiffness", "tolerance", "error"),
    [(None, 1e-5, 2e-4), (1e9, 1e-3, 1e-2)],  # a reversal of friction excites the elastic one
)
def test_a_rubbing_slide_on_a_turning_arm_is_that_of_another_model(stiffness, tolerance, error):
    guide = {"friction": "coulomb", "mu_kinetic": MU, "regularisation_velocity": 1e-4}
    if stiffness is not None:
        guide |= {"lateral_stiffness": stiffness, "length": 0.1, "damping_ratio": 0.5}
    result = run("inverted_slider_crank", {"block": guide}, solver={"tolerance": tolerance})
    normal, friction, torque, sliding = by_hand(result.time, result.scene.angular_speed)
    moves = (np.abs(sliding) > 0.02) & (result.time > 0.02)
    assert moves.sum() > 150
    for name, expected in (
        ("block_guide_force", normal),
        ("block_guide_friction", friction),
        ("drive_torque", torque),
    ):
        off = np.abs(result[name] - expected)[moves].max()
        assert off < error * np.abs(expected).max(), name


@pytest.mark.parametrize(
    "guide",
    [
        {"friction": "coulomb"},
        {"friction": "lugre", "lateral_stiffness": 1e9, "length": 0.1},
        OIL,
    ],
)
def test_what_a_guide_on_a_body_dissipates_the_drive_puts_in(guide):
    solver = {"tolerance": 3e-3 if "viscosity" in guide else 1e-3}
    result = run("whitworth", {"block": guide}, speed_rpm=120.0, solver=solver)
    lost = result.quantity("guides.block.dissipated").value
    assert lost > 0.5
    assert lost == pytest.approx(result.quantity("energy.dissipated").value, rel=1e-9)
    driven = np.trapezoid(result["drive_power"], result.time)
    assert driven == pytest.approx(lost, rel=1e-2)
    assert result.quantity("energy.residual").value < 1e-3
    if "viscosity" not in guide:
        assert (np.diff(result["block_guide_loss"]) >= -1e-5 * lost).all()


def test_each_guide_is_of_its_own_kind():
    result = run(
        "whitworth",
        {
            "block": {"lateral_stiffness": 1e9, "length": 0.1, "friction": "coulomb"},
            "ram": {**OIL, "length": 0.2},
        },
        revolutions=0.2,
        speed_rpm=60.0,
    )
    assert result.quantity("energy.residual").value < 1e-3
    assert result.quantity("guides.ram.min_film").value < OIL["clearance"]
    assert "guides.block.min_film" not in result.summary()["quantities"]
    force = np.abs(result["block_guide_force"])
    sliding = np.abs(result["block_guide_friction"]) > 0.0999 * force
    assert sliding.mean() > 0.5
