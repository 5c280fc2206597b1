"""Limits that must come out, whatever the way there costs."""

import itertools

import numpy as np
import pytest

from exu_press import Scene, simulate
from exu_press.mechanism.press import PAPER_LAWS
from exu_press.scene import DryJoint

POINT = PAPER_LAWS
QUARTER = {"mechanism": "slider_crank", "revolutions": 0.08}


def run(**changes):
    result = simulate(Scene.from_dict({**QUARTER, **changes}))
    assert result.completed, result.info["reason"]
    return result


def from_ideal(result):
    """Return how far the slider is from the ideal mechanism's at most, m."""
    scene = result.scene
    there = scene.build().mechanism.ideal_slider(result["crank_angle"], scene.angular_speed)[0]
    return np.abs(result["slider_position"] - there).max()


def falling(values):
    return all(a > b for a, b in itertools.pairwise(values))


@pytest.mark.parametrize("pin", ["dry", "lubricated"])
def test_no_clearance_is_the_ideal_joint(pin):
    """A dry joint gives way by (F / K)^(2/3) besides, here less than 1e-6 m."""
    laws = {"contact": {**POINT["contact"], "stiffness": 2.5545e14}, "friction": POINT["friction"]}
    stiff = laws if pin == "dry" else {}
    clearances = (1e-3, 1e-6)
    apart = [
        from_ideal(run(joints={"crank_pin": {"kind": pin, "clearance": c}}, **stiff))
        for c in clearances
    ]
    assert falling(apart)
    assert all(a < 1.02 * c + 1e-6 for a, c in zip(apart, clearances, strict=True))


def test_infinite_viscosity_is_the_ideal_joint():
    apart = [from_ideal(run(film={"viscosity": mu})) for mu in (0.1, 10.0)]
    assert falling(apart)
    assert apart[-1] < 2e-6


def test_no_viscosity_under_asperities_is_the_dry_joint():
    """The dry joint whose clearance is smaller by the asperities' height, where contact begins.

    The last of a film goes slowly: squeezed to the asperities it is 1e5 times as stiff as in the
    middle, so that 1e-5 Pa s still cushion an impact.
    """
    laws = {**POINT}
    dry = run(joints={"crank_pin": DryJoint(clearance=1e-4 - 6e-7)}, **laws)
    apart = []
    for viscosity in (1e-3, 1e-8):
        film = {"law": "pinkus", "viscosity": viscosity, "at_contact": "mixed"}
        thin = run(film=film, **laws)
        there = np.interp(thin["crank_angle"], dry["crank_angle"], dry["slider_position"])
        apart.append(np.abs(thin["slider_position"] - there).max())
    assert falling(apart)
    assert apart[-1] < 2e-6


def test_infinite_stiffness_does_not_blow_up():
    """Of a contact that hardly damps."""
    depths = []
    for factor in (1e-2, 1e6):
        result = run(
            joints={"crank_pin": "dry"},
            contact={
                "shape": "point",
                "damping": "flores",
                "restitution": 0.9,
                "stiffness": 2.5545e10 * factor,
            },
            friction=POINT["friction"],
        )
        depths.append(result.quantity("joints.crank_pin.peak_penetration").value)
        assert result.quantity("energy.residual").value < 1e-3
        assert from_ideal(result) < 1.5e-4 + 2.0 * depths[-1]
    assert falling(depths)


def test_no_speed_is_the_static_solution():
    """The rod hangs on the pin: the slider lies lower by clearance and (F / K)^(2/3)."""
    result = simulate(
        Scene.from_dict(
            {
                "mechanism": "slider_crank",
                "joints": {"crank_pin": "dry"},
                "start": "centred",
                "speed_rpm": 0.01,
                "revolutions": 5e-5,  # 0.3 s
                "contact": {**POINT["contact"], "damping_max": 1e6},  # comes to rest within that
                "friction": POINT["friction"],
                "solver": {"step": 1e-4},
            }
        )
    )
    depth = ((184.5 + 1347.0) * 9.81 / 2.5545e10) ** (2.0 / 3.0)
    lower = result["slider_position"][0] - result["slider_position"][-1]
    assert lower == pytest.approx(1e-4 + depth, rel=2e-3)
    assert abs(result["slider_velocity"][-1]) < 1e-6
    force = result["crank_pin_force"][-1]
    assert force == pytest.approx([0.0, -(184.5 + 1347.0) * 9.81], rel=2e-3, abs=20.0)
    assert result.info["newton_iterations"] < 1.1 * 3000  # which rest does not need


@pytest.mark.parametrize(
    ("law", "viscosity"), [("pinkus", 1e-4), ("pi_film", 1e-2), ("short", 1.0), ("finite", 1e-2)]
)
def test_the_journal_stays_in_its_film_which_only_takes_energy(law, viscosity):
    """A film that does not carry stops the run with the journal still inside."""
    scene = {**QUARTER, "film": {"law": law, "viscosity": viscosity}}
    result = simulate(Scene.from_dict(scene))
    assert result.info["status"] in ("completed", "film broke down")
    ratio = np.linalg.norm(result["crank_pin_eccentricity"], axis=1) / 1e-4
    assert ratio.max() < 1.0
    lost = result["crank_pin_loss"]
    assert np.diff(lost).min() >= -1e-9 * lost[-1]
    assert lost[-1] > 0.0


def test_two_runs_are_the_same_bit_by_bit():
    joints = {"crank_pin": "lubricated", "balls": "dry"}
    scene = Scene.from_dict({"joints": joints, "revolutions": 0.02})
    one, other = simulate(scene), simulate(scene)
    assert set(one) == set(other)
    for name in one:
        assert np.array_equal(one[name], other[name]), name
