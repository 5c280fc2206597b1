"""Numbers as people write them."""

import pytest

from exu_press.quantities.uncertain import significant, uncertain


@pytest.mark.parametrize(
    ("value", "digits", "text"),
    [(331.7, 2, "330"), (-12345.0, 4, "-12340"), (0.01234, 2, "0.012"), (0.0, 2, "0")],
)
def test_no_exponent_where_digits_do(value, digits, text):
    assert significant(value, digits) == text


def test_a_figure_without_error_is_written_out():
    assert uncertain(167100.0, None) == "167100"
