"""Archard's law, where it wears, and the profile of a worn surface."""

import math

import numpy as np
import pytest

from exu_press.laws.profile import profile
from exu_press.laws.wear import Contacts, accessible_depths, archard, worn_after, worn_by_angle


def test_archard_by_hand():
    assert archard(1e-5, 2e9, 1e4, 100.0) == pytest.approx(5e-12 * 1e3)


def test_a_volume_is_spread_over_the_overlap_of_the_surfaces():
    """A pin in a bearing: as wide as the surfaces overlap, deepest in the middle, none lost."""
    angle = 2.0 * np.pi * (np.arange(72) + 0.5) / 72
    overlap = 6e-5 * np.cos(angle - np.pi)[None] - 5e-5
    worn = worn_by_angle(np.array([1e-12]), overlap)
    half = np.degrees(np.arccos(5.0 / 6.0))
    assert np.count_nonzero(worn) * 5.0 == pytest.approx(2.0 * half, abs=10.0)
    assert worn[35] == worn.max() == pytest.approx(worn[36])
    assert worn.sum() == pytest.approx(1e-12, rel=1e-12)


def test_a_dent_that_is_too_narrow_is_spread_until_the_journal_can_follow():
    dent = np.zeros(72)
    dent[10:13] = 3e-5
    smooth = accessible_depths(dent, 5e-5)
    assert smooth.mean() == pytest.approx(dent.mean(), rel=0.02)
    assert profile(np.arange(72) * np.pi / 36, smooth).sharpest > -5e-5
    assert profile(np.arange(72) * np.pi / 36, dent).sharpest < -5e-5


@pytest.mark.parametrize(("overlap", "parts"), [(2e-5, 1), (2e-5, 20), (1e-8, 1)])
def test_a_pin_that_turns_under_a_steady_load_bores_a_dent_of_its_own_curvature(overlap, parts):
    """Closed form: w = e cos - c, the pin's own wear even, and both volumes Archard's."""
    clearance, area, volume = 5e-5, 2.0 * np.pi * 0.05 * 0.1 / 72, 7.6757e-8
    all_around = np.ones(72)
    contacts = Contacts(
        0.1 * all_around, 2.0 * np.pi * np.arange(72) / 72, overlap * all_around,
        volume / 72 * all_around, area,
    )  # fmt: skip
    journal, bearing = np.zeros(72), np.zeros(72)
    for _ in range(parts):
        journal, bearing = worn_after(journal, bearing, clearance, contacts, 1.0 / parts)
    assert [d.sum() * area for d in (journal, bearing)] == pytest.approx([volume] * 2, rel=1e-9)
    assert journal == pytest.approx(np.full(72, volume / area / 72), rel=0.01)
    assert bearing.max() == pytest.approx(16.4e-6, rel=0.01)
    assert clearance + bearing.max() + journal.max() == pytest.approx(68.8e-6, rel=2e-3)


ANGLES = np.linspace(0.0, 2.0 * np.pi, 72, endpoint=False)


def test_a_smooth_shape_is_met_with_both_derivatives():
    shape = profile(ANGLES, 1e-5 * (1.0 + np.cos(ANGLES - 0.3)))
    for angle in np.linspace(-7.0, 7.0, 50):
        depth, slope, bend = shape.derivatives(float(angle))
        assert depth == pytest.approx(1e-5 * (1.0 + math.cos(angle - 0.3)), abs=1e-10)
        assert slope == pytest.approx(-1e-5 * math.sin(angle - 0.3), abs=1e-9)
        assert bend == pytest.approx(-1e-5 * math.cos(angle - 0.3), abs=1e-8)
    assert shape.mean == pytest.approx(1e-5, rel=1e-9)
    assert shape.sharpest == pytest.approx(1e-5, rel=2e-3)  # a shifted circle stays a circle
