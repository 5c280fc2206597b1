"""Figures are written with as many digits as their errors leave."""

import pytest

from exu_press.quantities.uncertain import uncertain


@pytest.mark.parametrize(
    ("value", "error", "text"),
    [
        (856.937, 0.304, "856.94 +- 0.30"),
        (1014.2, 167.3, "1010 +- 170"),
        (0.00012345, 1.2e-6, "0.0001234 +- 0.0000012"),
        (5, 5e-9, "5 exact"),
        (0.0, 0.0, "0 exact"),
        (26.28, 1e-9, "26.28 exact"),
    ],
)
def test_text(value, error, text):
    told = {"error": error, "determined": True, "low": value - error, "high": value + error}
    assert uncertain(value, told) == text


def test_units_scale_value_and_error():
    told = {"error": 500.0, "determined": True, "low": 0.0, "high": 1.0}
    assert uncertain(12340.0, told, 1e-3) == "12.34 +- 0.50"


def test_without_value_or_error():
    assert uncertain(None, None) == "-"
    assert uncertain(1234.56, None) == "1235"


def test_bounds():
    told = {"error": 1.0, "determined": False, "low": 0.0, "high": 1084.6}
    assert uncertain(900.0, told) == "0 to 1080, not determined"


def test_a_count_that_is_not_determined_has_its_value_too():
    told = {"error": 2.0, "determined": False, "low": 3, "high": 7}
    assert uncertain(5, told) == "5 (3 to 7, not determined)"
