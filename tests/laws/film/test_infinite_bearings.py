"""The long and the short bearing against Reynolds' equation, and the paper's Eq. 35 literally."""

import math
import random

import pytest
from exact_bearings import long_half_film, short_half_film

from exu_press.laws.film import pi_film, pinkus, short


def relative_error(law, state, exact):
    f_r, f_t, *_ = law(*state)
    return math.hypot(f_r - exact[0], f_t - exact[1]) / math.hypot(*exact)


def states(closing, count=25):
    rng = random.Random(7)
    for _ in range(count):
        eps_dot = math.copysign(10.0 ** rng.uniform(-2, 1), 1 if closing else -1)
        yield rng.uniform(0.02, 0.95), eps_dot, rng.choice([-1, 1]) * 10.0 ** rng.uniform(-2, 1)


@pytest.mark.parametrize("closing", [True, False])
def test_pi_film_is_the_half_film(closing):
    worst = max(relative_error(pi_film(), s, long_half_film(*s)) for s in states(closing))
    assert worst < 5e-4


@pytest.mark.parametrize("law", [pinkus(), pi_film()])
@pytest.mark.parametrize("eps", [0.01, 0.1, 0.5, 0.9, 0.99])
@pytest.mark.parametrize("w", [1.0, -3.0])
def test_steady_limits(law, eps, w):
    f_r, f_t, *_ = law(eps, 0.0, eps * w)
    n, s2 = 2.0 + eps * eps, 1.0 - eps * eps
    assert f_r == pytest.approx(-12.0 * eps**2 * abs(w) / (n * s2))
    assert f_t == pytest.approx(6.0 * math.pi * eps * w / (n * math.sqrt(s2)))


@pytest.mark.parametrize("eps", [0.1, 0.5, 0.9])
@pytest.mark.parametrize("eps_dot", [-2.0, -0.1, 0.1, 2.0])
@pytest.mark.parametrize("w", [0.5, 5.0])
def test_pinkus_is_the_papers_equation_35_with_the_absolute_speed(eps, eps_dot, w):
    k = math.sqrt((1 - eps**2) * ((w / (2 * eps_dot)) ** 2 + 1 / eps**2))
    factor = (k + 3) / (k + 1.5) if eps_dot > 0 else k / (k + 1.5)
    sign = 1 if eps_dot > 0 else -1
    n, s2 = 2 + eps**2, 1 - eps**2
    radial = -6 * abs(eps_dot) / (n * s2**1.5)
    radial *= 4 * k * eps**2 + sign * n * math.pi * factor
    tangential = 6 * math.pi * eps * w / (n * math.sqrt(s2)) * factor
    f_r, f_t, *_ = pinkus()(eps, eps_dot, eps * w)
    assert f_r == pytest.approx(radial)
    assert f_t == pytest.approx(tangential)


def test_the_factor_of_equation_34b_multiplies():
    """In the scan it divides; closing, the exact half film says which of the two it does."""
    multiplied, divided = [], []
    for eps, eps_dot, eps_w in states(closing=True):
        exact = long_half_film(eps, eps_dot, eps_w)[1]
        k = math.sqrt((1 - eps**2) * ((eps_w / (2 * eps * eps_dot)) ** 2 + 1 / eps**2))
        without = 6 * math.pi * eps_w / ((2 + eps**2) * math.sqrt(1 - eps**2))
        factor = (k + 3) / (k + 1.5)
        assert pinkus()(eps, eps_dot, eps_w)[1] == pytest.approx(without * factor)
        multiplied.append(abs(without * factor / exact - 1))
        divided.append(abs(without / factor / exact - 1))
    assert max(multiplied) == pytest.approx(0.106, abs=0.001)
    assert max(divided) == pytest.approx(0.657, abs=0.001)


def test_no_jump_of_the_printed_equation_35a():
    for law in (pinkus(), pi_film()):
        before, after = law(0.5, -1e-9, 0.5)[0], law(0.5, 1e-9, 0.5)[0]
        assert before == pytest.approx(-16 / 9, rel=1e-6)
        assert after == pytest.approx(-16 / 9, rel=1e-6)


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
