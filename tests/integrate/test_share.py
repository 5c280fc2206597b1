"""What one step may have of a run's tolerance."""

import pytest

from exu_press.integrate.share import Share


def test_a_usual_run_gives_each_step_the_whole():
    share = Share.of(1e-4, duration=1.0, many_steps=10.0, impacts=False)
    assert share.at(1e-3) == pytest.approx(1e-6)  # a thousand steps
    assert share.at(1e-5) == pytest.approx(1e-7)  # a hundred times as many


def test_impacts_leave_a_hundredth():
    assert Share.of(1e-6, 1.0, 10.0, impacts=True).at(1e-9) == pytest.approx(1e-8)
    assert Share.of(1e-6, 1.0, 10.0, impacts=False).whole == pytest.approx(1e-9)
