"""Quantities are written with as many digits as their errors leave."""

import pytest

from exu_press.quantities.uncertain import significant, uncertain


@pytest.mark.parametrize(
    ("value", "digits", "text"),
    [(331.7, 2, "330"), (-12345.0, 4, "-12340"), (0.01234, 2, "0.012"), (0.0, 2, "0")],
)
def test_no_exponent_where_digits_do(value, digits, text):
    assert significant(value, digits) == text


@pytest.mark.parametrize(
    ("value", "error", "text"),
    [
        (856.937, 0.304, "856.94 +- 0.30"),
        (1014.2, 167.3, "1010 +- 170"),
        (0.00012345, 1.2e-6, "0.0001234 +- 0.0000012"),
        (5, 5e-9, "5 exact"),
        (0.0, 0.0, "0 exact"),
        (26.28, 1e-9, "26.28 exact"),
        (1234.56, None, "1235"),
        (167100.0, None, "167100"),
        (None, None, "-"),
    ],
)
def test_an_error_says_how_many_digits(value, error, text):
    stated = None
    if error is not None:
        stated = {"error": error, "determined": True, "low": value - error, "high": value + error}
    assert uncertain(value, stated) == text


def test_units_scale_value_and_error():
    stated = {"error": 500.0, "determined": True, "low": 0.0, "high": 1.0}
    assert uncertain(12340.0, stated, 1e-3) == "12.34 +- 0.50"


@pytest.mark.parametrize(
    ("value", "low", "high", "text"),
    [(900.0, 0.0, 1084.6, "0 to 1080, not determined"), (5, 3, 7, "5 (3 to 7, not determined)")],
)
def test_without_determination_there_are_bounds(value, low, high, text):
    stated = {"error": 1.0, "determined": False, "low": low, "high": high}
    assert uncertain(value, stated) == text
