"""Archard's law and where it wears."""

import numpy as np
import pytest

from exu_press.laws.wear import archard, worn_by_angle


def test_archard_by_hand():
    assert archard(1e-5, 2e9, 1e4, 100.0) == pytest.approx(5e-12 * 1e3)


def test_a_journal_that_turns_under_a_steady_force_stays_round():
    angle = np.linspace(0.0, 20.0 * np.pi, 72001)[:-1] + 1e-6
    worn = worn_by_angle(np.full(72000, 1e-12), angle, 72)
    assert worn == pytest.approx(np.full(72, 1e-9), rel=2e-3)
    assert worn.sum() == pytest.approx(72e-9, rel=1e-12)
