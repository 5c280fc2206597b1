"""Wear of a run against the ideal motion and against the heat of friction."""

import numpy as np
import pytest
from heavy_wheel import HEAVY_WHEEL

from exu_press import InputError, Scene, simulate
from exu_press.quantities.wear import guideway_depths, pin_depths, wear_depths

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
            solver={"tolerance": 1e-2},
        )
    )


def test_volume_is_that_of_the_heat_of_friction(result):
    """V = k / (mu H) times the work of Coulomb friction; impacts of the damping add little."""
    lost = result.quantity("joints.crank_pin.dissipated").value
    worn = result.quantity("joints.crank_pin.wear.volume").value
    assert 0.9 * lost < worn * 2e9 / 1e-4 * 0.05 < 1.02 * lost


@pytest.fixture(scope="module")
def weight():
    return simulate(
        Scene(
            mechanism=HEAVY_WHEEL,
            joints={"shaft": {"kind": "dry", "clearance": 5e-5, "radius": 0.05}},
            contact={"length": 0.1},
            friction={"law": "coulomb", "mu_kinetic": 0.02},
            speed_rpm=20.0,
            revolutions=3.0,
            settle=1.0,
            wear=WEAR,
        )
    )


def test_volume_of_a_turning_journal_under_its_weight_by_hand(weight):
    """V = k F s / H with F the weight and s the circumference, in each revolution."""
    by_hand = 1e-4 / 2e9 * 500.0 * 9.81 * 2.0 * np.pi * 0.05
    volume = weight.quantity("joints.shaft.wear.volume").value
    assert volume == pytest.approx(by_hand, rel=1e-3)
    sector = 2.0 * np.pi * 0.05 / 72 * WEAR["length"]
    for depth in wear_depths(weight, "shaft"):  # of all three revolutions
        assert depth.sum() * sector == pytest.approx(3.0 * volume, rel=1e-3)


def test_that_journal_stays_round_and_its_bearing_wears_below(weight):
    journal, bearing = wear_depths(weight, "shaft")
    assert journal == pytest.approx(np.full(72, journal.mean()), rel=0.05)
    below = np.arange(72)[bearing > 0.01 * bearing.max()] * 5.0
    assert 230.0 < below.min() < below.max() < 310.0
    assert bearing.sum() == pytest.approx(journal.sum(), rel=1e-9)
    drawn = weight.joints["shaft"]
    half = np.degrees(np.arccos(drawn.clearance / drawn.distance[-1]))
    assert np.ptp(below) == pytest.approx(2.0 * half, abs=10.0)  # as wide as the surfaces overlap


def test_one_joint_has_its_own_hardness(weight):
    other = simulate(weight.scene.replace({"wear.joints.shaft.hardness": 1e9}))
    ratio = [run.quantity("joints.shaft.wear.volume").value for run in (other, weight)]
    assert ratio[0] == pytest.approx(2.0 * ratio[1], rel=1e-12)
    assert Scene.from_dict(other.scene.to_dict()) == other.scene


def test_a_mixed_joint_wears_where_its_surfaces_touch(weight):
    """The film carries a part, which wears nothing off."""
    film = {"law": "finite", "viscosity": 0.002, "length": 0.1, "at_contact": "mixed"}
    changes = {"joints.shaft.kind": "lubricated", "film": film, "speed_rpm": 2.0}
    mixed = simulate(weight.scene.replace(changes))
    carried = mixed["shaft_normal_force"][-1]
    force = float(np.linalg.norm(mixed.joints["shaft"].force[-1]))
    assert 0.05 * force < carried < 0.999 * force
    volume = mixed.quantity("joints.shaft.wear.volume").value
    assert volume == pytest.approx(1e-4 / 2e9 * carried * 2.0 * np.pi * 0.05, rel=0.05)


@pytest.mark.long
def test_guides_with_clearance_wear_and_places_are_ranked():
    guided = simulate(
        Scene(
            mechanism="slider_crank",
            joints={"crank_pin": "dry"},
            revolutions=2.0,
            settle=1.0,
            guide={"clearance": 2e-5, "friction": "coulomb"},
            wear=WEAR,
        )
    )
    lost = guided.quantity("guides.slider.wear.volume").value
    depths = guideway_depths(guided, "slider")
    width = np.ptp(guided["slider_position"]) / 72
    assert depths.sum() * width * WEAR["length"] / 2.0 == pytest.approx(lost, rel=0.02)
    ranks = [
        guided.quantity(f"{place}.wear.rank").value
        for place in ("joints.crank_pin", "guides.slider")
    ]
    assert sorted(ranks) == [1, 2]


SLOTTED = Scene(
    mechanism="scotch_yoke",
    joints={},
    speed_rpm=60.0,
    start_angle_deg=40.0,
    revolutions=0.3,
    guide={
        "clearance": 2e-5,
        "friction": "coulomb",
        "mu_kinetic": 0.05,
        "width": 0.03,
        "length": 0.1,
    },
    wear=WEAR,
    solver={"tolerance": 1e-2},
)


def test_a_slot_and_its_pin_lose_what_archard_says():
    """V = k / (mu H) times the work of friction, off the walls and off the pin, whose side rubs."""
    worn = simulate(SLOTTED)
    assert worn.completed, worn.info["reason"]
    walls, pin = guideway_depths(worn, "yoke_slot"), pin_depths(worn, "yoke_slot")
    assert walls.shape == (1, 2, 72)
    volume = pin.sum() * 2.0 * np.pi * 0.015 / 72 * WEAR["length"]
    heat = worn["yoke_slot_slot_loss"][-1]
    assert 0.9 * heat < volume * 2e9 / 1e-4 * 0.05 < 1.02 * heat
    path = np.ptp(0.1 * np.cos(worn["crank_angle"]))
    assert walls.sum() * path / 72 * WEAR["length"] == pytest.approx(volume, rel=1e-3)
    # the yoke is pushed to the right throughout, by the pin's side that lies there
    assert walls[0, 0].max() < 1e-3 * walls[0, 1].max()
    rubbed = np.flatnonzero(pin > 1e-3 * pin.max())
    assert (5.0 * rubbed[[0, -1]]).tolist() == [210.0, 315.0], "360 deg - 148 deg, - 40 deg"


def test_a_pin_without_a_diameter_does_not_wear():
    changes = {"guide.width": 0.0, "wear.guides": {"yoke_slot": {"coefficient": 1e-5}}}
    with pytest.raises(InputError, match=r"guide\.width = 0"):
        SLOTTED.replace(changes)


def test_a_run_that_stops_at_its_start_has_both_ends_of_its_guides():
    run = simulate(SLOTTED.replace({"solver.min_step": 0.5}))
    assert (run["guide_sliding"].shape, run["yoke_slot_slot_pin_sliding"].shape) == ((1, 2), (1,))
