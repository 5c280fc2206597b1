"""Film laws in any state: finite, dissipative, continuous; tried by Hypothesis."""

import math

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from exu_press.laws.film import dissipated_power, finite, pi_film, pinkus, short, with_asperities
from exu_press.laws.film.ball import ball

FILMS = {
    "pinkus": pinkus(),
    "pi_film": pi_film(),
    "short": short(0.4),
    "finite": finite(0.71),
    "finite, narrow": finite(0.1),
    "finite, wide": finite(4.0),
    "ball": ball().law,
    "ball, narrow caps": ball(0.9).law,
}
MIXED = {
    "mixed pi_film": with_asperities(pi_film(), 0.05),
    "mixed finite": with_asperities(finite(0.71), 1e-3),
    "mixed short": with_asperities(short(0.4), 0.9),
    "mixed ball": ball(1.4, 0.01).law,
}
EVERY = pytest.mark.parametrize("law", (FILMS | MIXED).values(), ids=(FILMS | MIXED).keys())

# 1 - eps down to 1e-4, where the opening force of `short` has lost ten digits; rates up to those of
# 10 m/s across 1e-7 m
NARROWEST = 1e-4
gaps = st.floats(NARROWEST, 1.0)
rates = st.floats(-1e8, 1e8).filter(lambda rate: rate == 0.0 or abs(rate) > 1e-12)


@EVERY
@settings(max_examples=50, deadline=None)
@given(gap=gaps, eps_dot=rates, eps_w=rates, way=st.tuples(*[st.floats(-1.0, 1.0)] * 3))
def test_finite_dissipative_and_continuous(law, gap, eps_dot, eps_w, way):
    """A step of 1e-7 of the gap and of the speeds changes the force by about as little."""
    eps, speed = 1.0 - gap, math.hypot(eps_dot, eps_w)
    force = law(eps, eps_dot, eps_w)
    assert all(map(math.isfinite, force))
    size = math.hypot(force[0], force[1]) * speed
    assert dissipated_power(force, eps_dot, eps_w) >= -1e-9 * size
    near = min(max(eps + 1e-7 * gap * way[0], 0.0), 1.0 - 0.5 * NARROWEST)
    there = law(near, eps_dot + 1e-7 * speed * way[1], eps_w + 1e-7 * speed * way[2])
    # what a motion with these speeds can do at most: the damping of pure squeeze is the largest
    largest = max(abs(law(eps, speed, 0.0)[0]), abs(law(eps, -speed, 0.0)[0]))
    largest += math.hypot(*law(eps, 0.0, speed)[:2])
    assert math.dist(force[:2], there[:2]) <= 1e-4 * largest


@pytest.mark.parametrize("law", FILMS.values(), ids=FILMS.keys())
def test_no_force_is_made_up_where_there_is_no_film(law):
    for eps in (1.0, 1.5, 1e9, -1e-300, -3.0, math.nan):
        assert all(map(math.isnan, law(eps, 3.0, -2.0)))


@pytest.mark.parametrize("law", MIXED.values(), ids=MIXED.keys())
@settings(max_examples=50, deadline=None)
@given(eps=st.floats(0.0, 1e6), eps_dot=rates, eps_w=rates)
def test_mixed_film_holds_at_any_penetration(law, eps, eps_dot, eps_w):
    force = law(eps, eps_dot, eps_w)
    assert all(map(math.isfinite, force))
    size = math.hypot(force[0], force[1]) * math.hypot(eps_dot, eps_w)
    assert dissipated_power(force, eps_dot, eps_w) >= -1e-9 * size
