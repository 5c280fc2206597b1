"""Archard's law and where it wears."""

import numpy as np
import pytest

from exu_press.laws.profile import profile
from exu_press.laws.wear import archard, reached, worn_by_angle


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
    smooth = reached(dent, 5e-5)
    assert smooth.mean() == pytest.approx(dent.mean(), rel=0.02)
    assert profile(np.arange(72) * np.pi / 36, smooth).sharpest > -5e-5
    assert profile(np.arange(72) * np.pi / 36, dent).sharpest < -5e-5


def test_the_shape_that_a_pin_bores_stays():
    """A pin that sank in by 30 um: its centre has one place there, and the smooth shape a few."""
    angle = 2.0 * np.pi * np.arange(72) / 72
    crescent = np.maximum(0.0, 8e-5 * np.cos(angle) - 5e-5)
    smooth = reached(crescent, 5e-5)
    assert np.abs(smooth - crescent).max() < 0.25 * crescent.max()
    assert smooth.mean() == pytest.approx(crescent.mean(), rel=0.02)
