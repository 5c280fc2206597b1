"""Ocvirk's short bearing against direct integration of its Reynolds equation."""

import math
import random

import pytest
from exact_bearings import short_half_film

from exu_press.laws.film import short


def test_short_is_the_half_film_under_rotation_and_squeeze():
    rng = random.Random(11)
    worst = 0.0
    for _ in range(40):
        turn = rng.uniform(0.0, 2.0 * math.pi)
        state = rng.uniform(0.0, 0.97), math.cos(turn), math.sin(turn)
        exact = short_half_film(*state, 0.3)
        f_r, f_t, *_ = short(0.3)(*state)
        worst = max(worst, math.hypot(f_r - exact[0], f_t - exact[1]) / math.hypot(*exact))
    assert worst < 1e-5


@pytest.mark.validation(
    "closed form",
    "short bearing under a steady load",
    "F. W. Ocvirk, NACA TN 2808 (1952)",
    "equation, public domain",
)
@pytest.mark.parametrize("eps", [0.01, 0.3, 0.6, 0.95])
def test_ocvirk_1952_steady_load(eps, compare):
    f_r, f_t, *_ = short(0.25)(eps, 0.0, eps)
    s2 = 1.0 - eps**2
    closed = -4 * 0.25**2 * eps**2 / s2**2, 4 * 0.25**2 * math.pi * eps / (4 * s2**1.5)
    compare("force along and across the eccentricity", closed, (f_r, f_t), error=0.0, rel=1e-12)
