"""What happened in a clearance joint, on paths with known answers."""

import numpy as np
import pytest

from exu_press.observe import joint_summary
from exu_press.result import JointRecord

CLEARANCE = 1e-4
TIME = np.linspace(0.0, 1.0, 1001)


def path(distance, dimensions=2):
    """A path along a diagonal, so that every component counts."""
    direction = np.array([0.6, -0.8, 0.0][:dimensions])
    return np.asarray(distance)[:, None] * direction


def observe(distance, dimensions=2, force=None, time=TIME, kind="dry", onset=0.0):
    eccentricity = path(distance, dimensions)
    joint = JointRecord(
        kind=kind,
        spherical=dimensions == 3,
        clearance=CLEARANCE,
        force=np.zeros_like(eccentricity) if force is None else force,
        eccentricity=eccentricity,
        gap=CLEARANCE - np.asarray(distance),
        moment=np.zeros((len(time), 2)),
        dissipated_power=np.zeros(len(time)),
    )
    return joint_summary(time, joint, onset=onset)


@pytest.mark.parametrize("dimensions", [2, 3])
def test_two_touches_and_their_share_of_time(dimensions):
    distance = np.full(1001, 0.5 * CLEARANCE)
    distance[100:201] = CLEARANCE + 2e-6
    distance[500:901] = CLEARANCE + 5e-6
    entries = observe(distance, dimensions)
    assert entries["impacts"] == 2
    assert entries["share_contact"] == pytest.approx(0.5, abs=3e-4)  # jumps take a step
    assert entries["share_free_flight"] == 1.0 - entries["share_contact"]
    assert entries["peak_penetration"] == pytest.approx(5e-6)
    assert entries["max_eccentricity_ratio"] == pytest.approx(1.05)
    assert entries["min_film"] is None


def test_contact_from_the_first_instant_is_a_touch():
    entries = observe(np.full(1001, CLEARANCE + 1e-6))
    assert entries["impacts"] == 1
    assert entries["share_contact"] == pytest.approx(1.0)
    assert entries["share_free_flight"] == pytest.approx(0.0)


def test_free_flight_all_the_time():
    entries = observe(np.full(1001, 0.3 * CLEARANCE))
    assert entries["impacts"] == 0
    assert entries["share_contact"] == 0.0
    assert entries["peak_penetration"] == 0.0
    assert entries["max_eccentricity_ratio"] == pytest.approx(0.3)


def test_touching_begins_at_1e_10():
    """Spec 2: contact where the penetration exceeds 1e-10 m."""
    assert observe(np.full(1001, CLEARANCE + 0.5e-10))["impacts"] == 0
    assert observe(np.full(1001, CLEARANCE + 2e-10))["impacts"] == 1


def test_a_touch_begins_and_ends_within_steps():
    """Each of 37 coarse steps is ten percent of a swing, whose half is in contact."""
    time = np.linspace(0.0, 1.0, 38)
    distance = CLEARANCE + 1e-6 * np.sin(2.0 * np.pi * 3.7 * time - 0.35)
    fine = np.linspace(0.0, 1.0, 100_001)
    true = np.mean(np.sin(2.0 * np.pi * 3.7 * fine - 0.35) > 0.0)
    assert observe(distance, time=time)["share_contact"] == pytest.approx(true, abs=2e-3)


def test_shares_are_shares_of_time_not_of_steps():
    time = np.concatenate([np.linspace(0.0, 0.9, 10), np.linspace(0.91, 1.0, 1000)])
    distance = np.where(time > 0.905, CLEARANCE + 1e-6, 0.0)
    entries = observe(distance, time=time)
    assert entries["share_contact"] == pytest.approx(0.09, abs=1e-4)


def test_film_has_a_thickness_and_no_impacts():
    distance = CLEARANCE * (0.4 + 0.3 * np.sin(20.0 * TIME))
    entries = observe(distance, kind="lubricated", onset=None)
    assert entries["min_film"] == pytest.approx(0.3 * CLEARANCE, rel=1e-3)
    assert entries["max_eccentricity_ratio"] == pytest.approx(0.7, rel=1e-3)
    for name in ("peak_penetration", "impacts", "share_free_flight", "share_contact"):
        assert entries[name] is None


def test_peak_force_is_a_length():
    force = np.zeros((1001, 2))
    force[500] = (-3.0, 4.0)
    assert observe(np.zeros(1001), force=force)["peak_force"] == pytest.approx(5.0)


def test_mixed_film_touches_from_the_asperities_on():
    distance = np.full(1001, 0.5 * CLEARANCE)
    distance[100:201] = 0.97 * CLEARANCE
    assert observe(distance, kind="lubricated")["impacts"] == 0
    entries = observe(distance, kind="lubricated", onset=0.05 * CLEARANCE)
    assert entries["impacts"] == 1
    assert entries["share_contact"] == pytest.approx(0.1, abs=1e-4)
    assert entries["min_film"] == pytest.approx(0.03 * CLEARANCE)


def test_a_single_instant():
    entries = observe(np.zeros(1), time=np.zeros(1))
    assert entries["share_contact"] == 0.0
    assert entries["share_free_flight"] == 1.0


def test_entries_are_plain_numbers():
    for value in observe(np.full(1001, CLEARANCE + 1e-6)).values():
        assert value is None or type(value) in (int, float, str)


def test_an_ideal_joint_has_a_force_alone():
    force = np.full((1001, 2), 3.0)
    entries = observe(np.zeros(1001), force=force, kind="ideal", onset=None)
    assert entries == {"kind": "ideal", "clearance": 0.0, "peak_force": pytest.approx(18**0.5)}


def test_what_it_is():
    entries = observe(np.zeros(1001))
    assert (entries["kind"], entries["clearance"]) == ("dry", 1e-4)
