"""Wear of a run against the ideal motion and against the heat of friction."""

import numpy as np
import pytest

from exu_press import InputError, Scene, simulate
from exu_press.quantities.wear import sliding_of, wear_depths
from exu_press.scene import mechanism_of
from exu_press.scene.warnings import scene_warnings

WEAR = {"coefficient": 1e-4, "hardness": 2e9, "length": 0.1}


@pytest.fixture(scope="module")
def result():
    return simulate(
        Scene(
            mechanism="slider_crank",
            joints={"crank_pin": "dry"},
            friction={"law": "coulomb", "mu_kinetic": 0.05},
            revolutions=2.0,
            settle=1.0,
            wear=WEAR,
        )
    )


def test_volume_is_that_of_the_heat_of_friction(result):
    """V = k / (mu H) times the work of Coulomb friction; impacts of the damping add little."""
    lost = result.quantity("joints.crank_pin.dissipated").value
    worn = result.quantity("joints.crank_pin.wear.volume").value
    assert 0.9 * lost < worn * 2e9 / 1e-4 * 0.05 < 1.02 * lost


def test_the_way_is_that_of_the_ideal_motion(result):
    """Nearly: the journal's own way in its clearance comes on top."""
    slid = sliding_of(result, "crank_pin")
    scene = result.scene
    pin = next(j for j in mechanism_of(scene).joints if j.name == "crank_pin")
    motion = mechanism_of(scene).motion(result["crank_angle"], scene.angular_speed)
    relative = np.diff(motion[pin.journal].position[:, 2] - motion[pin.bearing].position[:, 2])
    radius = scene.joints["crank_pin"].radius
    assert slid.distance.sum() == pytest.approx(radius * np.abs(relative).sum(), rel=0.02)


def test_depths_hold_the_volume(result):
    slid = sliding_of(result, "crank_pin")
    volume = 1e-4 / 2e9 * (slid.force * slid.distance).sum()
    sector = 2.0 * np.pi * result.scene.joints["crank_pin"].radius / 72 * WEAR["length"]
    for depth in wear_depths(result, "crank_pin"):
        assert depth.sum() * sector == pytest.approx(volume, rel=1e-12)


def test_wear_changes_nothing_in_the_run_and_is_in_proportion(result):
    other = simulate(result.scene.replace("wear.coefficient", 2e-4))
    assert (other["slider_position"] == result["slider_position"]).all()
    for name in ("volume", "bearing_depth", "journal_depth"):
        full = f"joints.crank_pin.wear.{name}"
        assert other.quantity(full).value == pytest.approx(2.0 * result.quantity(full).value)
    heat = (result.quantity(f"joints.crank_pin.wear.{n}").value for n in ("pressure_velocity",))
    assert all(value > 0.0 for value in heat)


@pytest.mark.parametrize(
    ("keys", "words"),
    [
        ({"wear": {"coefficient": 1e-4, "hardness": 2e9}}, "length"),
        ({"wear": WEAR | {"coefficient": 2.0}}, "coefficient"),
        ({"wear": WEAR, "joints": {}}, "no revolute joint is dry"),
    ],
)
def test_what_is_refused(keys, words):
    with pytest.raises(InputError, match=words):
        Scene(**({"mechanism": "slider_crank", "joints": {"crank_pin": "dry"}} | keys))


def test_a_coefficient_of_a_thousand_times_steel_is_warned_of(result):
    assert not [words for words in scene_warnings(result.scene) if "wear" in words]
    doubtful = scene_warnings(result.scene.replace("wear.coefficient", 0.5))
    assert any("wear.coefficient" in words for words in doubtful)
