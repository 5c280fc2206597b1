"""Film laws in any state: finite, dissipative, continuous; tried by Hypothesis."""

import math

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from exu_press.errors import InputError
from exu_press.laws.film import (
    FILM_LAWS,
    dissipated,
    finite,
    pi_film,
    pinkus,
    short,
    with_asperities,
)
from exu_press.scene.laws import film_law
from exu_press.scene.tables import Film

FILMS = {
    "pinkus": pinkus(),
    "pi_film": pi_film(),
    "short": short(0.4),
    "finite": finite(0.71),
    "finite, narrow": finite(0.1),
    "finite, wide": finite(4.0),
}
MIXED = {
    "mixed pi_film": with_asperities(pi_film(), 0.05),
    "mixed finite": with_asperities(finite(0.71), 1e-3),
    "mixed short": with_asperities(short(0.4), 0.9),
}
EVERY = pytest.mark.parametrize("law", (FILMS | MIXED).values(), ids=(FILMS | MIXED).keys())

# 1 - eps down to 1e-4, where the opening force of `short` has lost ten digits; rates up to those of
# 10 m/s across 1e-7 m
NARROWEST = 1e-4
gaps = st.floats(NARROWEST, 1.0)
rates = st.floats(-1e8, 1e8).filter(lambda rate: rate == 0.0 or abs(rate) > 1e-12)


@EVERY
@settings(max_examples=80, deadline=None)
@given(gap=gaps, eps_dot=rates, eps_w=rates)
def test_finite_and_dissipative(law, gap, eps_dot, eps_w):
    force = law(1.0 - gap, eps_dot, eps_w)
    assert all(map(math.isfinite, force))
    size = math.hypot(force[0], force[1]) * math.hypot(eps_dot, eps_w)
    assert dissipated(force, eps_dot, eps_w) >= -1e-9 * size


@EVERY
@settings(max_examples=80, deadline=None)
@given(gap=gaps, eps_dot=rates, eps_w=rates, way=st.tuples(*[st.floats(-1.0, 1.0)] * 3))
def test_continuous(law, gap, eps_dot, eps_w, way):
    """A step of 1e-7 of the gap and of the speeds changes the force by about as little."""
    speed = math.hypot(eps_dot, eps_w)
    eps = 1.0 - gap
    near = min(max(eps + 1e-7 * gap * way[0], 0.0), 1.0 - 0.5 * NARROWEST)
    here = law(eps, eps_dot, eps_w)
    there = law(near, eps_dot + 1e-7 * speed * way[1], eps_w + 1e-7 * speed * way[2])
    # what a motion with these speeds can do at most: the damping of pure squeeze is the largest
    largest = max(abs(law(eps, speed, 0.0)[0]), abs(law(eps, -speed, 0.0)[0]))
    largest += math.hypot(*law(eps, 0.0, speed)[:2])
    assert math.dist(here[:2], there[:2]) <= 1e-4 * largest


@pytest.mark.parametrize("law", MIXED.values(), ids=MIXED.keys())
@settings(max_examples=80, deadline=None)
@given(eps=st.floats(0.0, 1e6), eps_dot=rates, eps_w=rates)
def test_mixed_film_holds_at_any_penetration(law, eps, eps_dot, eps_w):
    force = law(eps, eps_dot, eps_w)
    assert all(map(math.isfinite, force))
    size = math.hypot(force[0], force[1]) * math.hypot(eps_dot, eps_w)
    assert dissipated(force, eps_dot, eps_w) >= -1e-9 * size


@pytest.mark.parametrize("law", FILMS.values(), ids=FILMS.keys())
@settings(max_examples=50, deadline=None)
@given(eps=st.one_of(st.floats(1.0, 1e9), st.floats(-1e9, -1e-300)), eps_dot=rates, eps_w=rates)
def test_no_force_is_made_up_where_there_is_no_film(law, eps, eps_dot, eps_w):
    assert all(map(math.isnan, law(eps, eps_dot, eps_w)))


def jump_at_rest(law, eps, eps_w, share):
    """Return by how much the radial force changes from just closing to just opening, relative."""
    closing, opening = law(eps, share * eps_w, eps_w)[0], law(eps, -share * eps_w, eps_w)[0]
    return abs(closing - opening) / abs(closing)


def as_printed(eps, eps_dot, eps_w):
    """Eq. 35a with eps_dot for |eps_dot|: an opening film's radial force has its sign turned."""
    f_r, *rest = pinkus()(eps, eps_dot, eps_w)
    return (f_r if eps_dot >= 0.0 else -f_r, *rest)


@settings(max_examples=200, deadline=None)
@given(
    name=st.sampled_from(sorted(FILM_LAWS)),
    length=st.floats(0.015, 0.5),
    at_contact=st.sampled_from(["stop", "mixed"]),
    eps=st.floats(0.02, 0.98),
    eps_w=st.floats(1e-3, 1e3),
    share=st.floats(0.0, 1e-6),
)
def test_no_setting_reaches_the_printed_equation_35a(name, length, at_contact, eps, eps_w, share):
    table = Film(law=name, length=length, at_contact=at_contact)
    assert jump_at_rest(film_law(table, 0.07, 1e-4), eps, eps_w, share) < 1e-2


def test_the_printed_equation_35a_would_be_noticed():
    assert jump_at_rest(as_printed, 0.5, 1.0, 1e-9) == pytest.approx(2.0)


def test_a_scene_knows_no_other_film_than_these():
    assert set(FILM_LAWS) == {"pinkus", "pi_film", "short", "finite"}
    with pytest.raises(InputError, match=r"film\.law"):
        Film(law="printed")
