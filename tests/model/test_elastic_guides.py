"""Elastic guides: springs instead of constraints, nothing else."""

import numpy as np
import pytest
from pressed import pressed_slider_crank
from scipy.optimize import fsolve

from exu_press import Scene, simulate

ECCENTRIC = {"kind": "blanking", "force": 1e4, "offset": [0.1, 0.0], "end_angle_deg": 60.0}


def run(**scene):
    result = simulate(Scene.from_dict(scene))
    assert result.completed, result.info["reason"]
    return result


def test_tilt_of_a_slider_under_a_static_eccentric_force():
    """Slider-crank, pinned in the slider's centre: the guide alone carries F e = k phi."""
    guide = {"lateral_stiffness": 1e9, "tilting_stiffness": 3e6, "damping_ratio": 0.5}
    result = pressed_slider_crank(
        2e4, (0.15, 0.0), start_angle_deg=90.0, revolutions=0.05, guide=guide
    )
    assert result["load_die_moment"] == pytest.approx(3e3)
    assert result["slider_tilt"][-1] == pytest.approx(2e4 * 0.15 / 3e6, rel=5e-4)
    assert result["guide_moment"][-1] == pytest.approx(-3e3, rel=5e-4)


def test_tilt_of_the_press_under_a_static_eccentric_force():
    """At bottom dead centre guide and both balls' contacts, K delta^1.5, share the moment.

    A thousandth of the default contact damping: with the default one the balls are dashpots that
    give way at 26 um/s under half the slider's weight. What is left lags by half a percent.
    """
    force, eccentricity, arm, stiffness = 8e3, 0.05, 0.1655, 2.5545e10
    result = run(
        joints={"balls": "dry"},
        speed_rpm=1.0,
        start_angle_deg=175.0,
        revolutions=0.016,
        load={
            "eccentric": {
                "kind": "blanking",
                "force": force,
                "offset": [eccentricity, 0.0],
                "rise": 0.4,
                "fall": 0.4,
                "end_angle_deg": 180.5,
            }
        },
        guide={"lateral_stiffness": 1e9},
        friction={"law": "none"},
        contact={"damping_max": 2.5545e5},
    )
    weight, tilting = 1347.0 * 9.81, 1e9 * 0.5**2 / 12

    def unbalanced(unknowns):
        depth, tilt = 1e-6 * np.asarray(unknowns)
        balls = stiffness * np.array([depth + arm * tilt, depth - arm * tilt]) ** 1.5
        moment = arm * (balls[0] - balls[1]) + tilting * tilt
        return [balls.sum() / (weight - force) - 1, moment / (force * eccentricity) - 1]

    expected = 1e-6 * fsolve(unbalanced, [20.0, 10.0])[1]
    peak = int(np.argmax(result["load_eccentric_force"]))
    assert expected > 1e-5
    assert result["slider_tilt"][peak] == pytest.approx(expected, rel=1e-2)
    assert abs(result["slider_lateral"][peak]) < 1e-3 * expected * arm


@pytest.mark.parametrize("balls", ["ideal", "dry"])
def test_ideal_guides_carry_the_eccentric_moment(balls):
    """With dry balls the guide; with ideal ones these, by forces that differ by M / a."""
    result = run(
        joints={"balls": balls},
        revolutions=0.17,
        load={"blanking": ECCENTRIC},
        solver={"step": 5e-5},
    )
    moment = result["load_blanking_moment"]
    assert moment.max() > 950.0
    assert moment == pytest.approx(0.1 * result["load_blanking_force"])
    carried = 0.1655 * (result["ball_right_force"] - result["ball_left_force"])[:, 1]
    assert ("guide_moment" in result) == (balls == "dry")
    if balls == "dry":
        carried = carried - result["guide_moment"]
    assert np.abs(carried - moment).max() < 1e-4 * moment.max()
    assert np.abs(result["slider_tilt"]).max() < 1e-12


def test_energy_balance_with_what_guides_store_and_lose():
    """With the default tolerance; measured 3e-5 ... 2e-4 of the largest work.

    With elastic guides a ball's centre moves sideways in its socket, as in figure 18 of the paper.
    """
    result = run(
        joints={"crank_pin": "lubricated", "balls": "dry"},
        revolutions=0.17,
        load={"blanking": ECCENTRIC},
        guide={"lateral_stiffness": 1e9},
    )
    assert result.quantity("energy.residual").value < 5e-4
    names = [name for name in result if name.endswith("guide_loss")]
    assert len(names) == 5
    lost = np.sum([result[name] for name in names], axis=0)
    assert lost[-1] > 0.01
    for name in names:
        assert np.all(np.diff(result[name]) >= 0.0), name
    others = [result[f"{joint}_loss"] for joint in result.clearance_joints]
    total = np.sum([lost, *others], axis=0)
    assert result["energy_dissipated"] == pytest.approx(total, abs=1e-12)
    assert np.abs(result["ball_left_eccentricity"][:, 0]).max() > 1e-6
