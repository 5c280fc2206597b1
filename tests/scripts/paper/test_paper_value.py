"""Figures between their bounds."""

import math

import pytest

from paper.value import Value, distance, product


def around(value, error):
    return Value(value, value - error, value + error)


def test_a_product_is_between_the_products_of_the_bounds():
    found = product(around(2.0, 0.1), Value(3.0, 2.0, 5.0, False), power=2.0)
    assert (found.value, found.low, found.high) == pytest.approx((18.0, 1.9 * 4.0, 2.1 * 25.0))
    assert not found.determined


def test_distances():
    aims = [10.0, 10.0]
    twice = [around(20.0, 1.0), Value(5.0, 5.0, 5.0)]
    found = distance(twice, aims)
    assert found.value == pytest.approx(math.log(2.0))
    # d sqrt((x^2 + y^2) / 2) / dx = x / (2 d), and here x = d
    assert found.error == pytest.approx(0.5 * 0.05)
    assert distance([around(10.0, 1.0), None], aims) is None
    assert not distance([around(10.0, 1.0), Value(9.0, 8.0, 11.0, False)], aims).determined
