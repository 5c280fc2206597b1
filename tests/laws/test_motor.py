"""A motor's torque over its speed: rated point, breakdown, standstill, backwards, generator."""

import math

import numpy as np
import pytest
from slopes import slopes

from exu_press import InputError
from exu_press.laws.motor import kloss, torque_table

RATED = {"rated_torque": 100.0, "slip": 0.05, "breakdown_torque": 250.0, "no_load_speed": 100.0}
SPEEDS = np.linspace(-400.0, 400.0, 8001)


def test_through_the_rated_point_and_no_further_than_the_breakdown_torque():
    motor = kloss(**RATED)
    torques = np.array([motor(speed)[0] for speed in SPEEDS])
    assert motor(95.0)[0] == pytest.approx(100.0)
    assert motor(100.0)[0] == 0.0
    assert np.abs(torques).max() == pytest.approx(250.0, rel=1e-5)
    breakdown = 0.05 * (2.5 + math.sqrt(2.5**2 - 1.0))
    assert SPEEDS[torques.argmax()] == pytest.approx(100.0 * (1.0 - breakdown), abs=0.1)
    assert SPEEDS[torques.argmin()] == pytest.approx(100.0 * (1.0 + breakdown), abs=0.1)


@pytest.mark.parametrize(
    "motor", [kloss(**RATED), torque_table([-10.0, 0.0, 70.0, 110.0], [50.0, 90.0, 250.0, -80.0])]
)
def test_the_slope_is_the_derivative(motor):
    for speed in (-33.0, -5.0, 12.0, 75.0, 99.0, 104.0, 160.0):
        ((around, _),) = slopes(motor, [speed], [1e-4])
        assert motor(speed)[1] == pytest.approx(around, rel=1e-5, abs=1e-6)


def test_a_table_goes_on_at_both_ends():
    motor = torque_table([5.0, 15.0], [300.0, 0.0])
    assert [motor(speed)[0] for speed in (4.0, 5.0, 7.5, 15.0, 16.0)] == [300, 300, 225, 0, 0]


def test_what_is_refused():
    with pytest.raises(InputError, match=r"breakdown_torque = 90.0: allowed rated_torque = 100.0"):
        kloss(**RATED | {"breakdown_torque": 90.0})
    with pytest.raises(InputError, match="slip"):
        kloss(**RATED | {"slip": 0.0})
