"""How often and how long surfaces touch, on paths with known answers."""

import numpy as np
import pytest

from exu_press.quantities.joints import contacts, share_of_contact

TIME = np.linspace(0.0, 1.0, 1001)
APART = np.full(1001, -5e-5)


def test_two_touches_and_their_share_of_time():
    depth = APART.copy()
    depth[100:201], depth[500:901] = 2e-6, 5e-6
    assert contacts(depth) == 2
    assert share_of_contact(TIME, depth) == pytest.approx(0.5, abs=3e-4)  # jumps take a step


def test_contact_from_the_first_instant_is_a_touch():
    assert contacts(-APART) == 1
    assert share_of_contact(TIME, -APART) == pytest.approx(1.0)


def test_free_flight_all_the_time():
    assert contacts(APART) == 0
    assert share_of_contact(TIME, APART) == 0.0


def test_any_penetration_is_a_touch():
    """That of a watch's shaft is 1e-17 m, and bears all of its load."""
    assert contacts(np.zeros(1001)) == 0
    assert contacts(np.full(1001, 1e-17)) == 1


def test_a_touch_begins_and_ends_within_steps():
    """Each of 37 coarse steps is ten percent of a swing, whose half is in contact."""
    time = np.linspace(0.0, 1.0, 38)
    depth = 1e-6 * np.sin(2.0 * np.pi * 3.7 * time - 0.35)
    fine = np.linspace(0.0, 1.0, 100_001)
    true = np.mean(np.sin(2.0 * np.pi * 3.7 * fine - 0.35) > 0.0)
    assert share_of_contact(time, depth) == pytest.approx(true, abs=2e-3)


def test_shares_are_shares_of_time_not_of_steps():
    time = np.concatenate([np.linspace(0.0, 0.9, 10), np.linspace(0.91, 1.0, 1000)])
    depth = np.where(time > 0.905, 1e-6, -1e-4)
    assert share_of_contact(time, depth) == pytest.approx(0.09, abs=1e-3)


def test_a_single_instant():
    assert share_of_contact(np.zeros(1), np.zeros(1)) == 0.0
