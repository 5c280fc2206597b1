"""Free flight, impact and permanent contact."""

import numpy as np
import pytest

from paper.contact_modes import LONGEST_IMPACT, contact_modes


def test_shares_of_a_known_history():
    time = np.linspace(0.0, 0.1, 10001)  # 10 us steps
    penetration = np.full_like(time, -1e-5)
    penetration[1000:1051] = 1e-6  # 0.5 ms
    penetration[3000:3051] = 1e-6  # 0.5 ms
    penetration[5000:7001] = 1e-6  # 20 ms
    modes = contact_modes(time, penetration)
    assert modes["impact"] == pytest.approx(0.01)
    assert modes["permanent"] == pytest.approx(0.2)
    assert modes["free_flight"] == pytest.approx(0.79)
    assert modes["impacts"] == 2


def test_the_bound_between_impact_and_permanent_contact():
    time = np.linspace(0.0, 0.1, 10001)
    for length, mode in ((0.9 * LONGEST_IMPACT, "impact"), (1.1 * LONGEST_IMPACT, "permanent")):
        penetration = np.where((time > 0.05) & (time < 0.05 + length), 1e-6, -1e-6)
        modes = contact_modes(time, penetration)
        assert modes[mode] == pytest.approx(length / 0.1, rel=0.05)


def test_always_apart_and_always_touching():
    time = np.linspace(0.0, 0.1, 11)
    assert contact_modes(time, np.full(11, -1e-6))["free_flight"] == 1.0
    assert contact_modes(time, np.full(11, 1e-6))["permanent"] == pytest.approx(1.0)
