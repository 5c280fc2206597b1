"""The film under touching asperities: no jump at onset or at eps = 1, and a graceful end."""

import itertools

import numpy as np
import pytest
from slopes import slopes

from exu_press.laws.film import finite, pi_film, short, with_asperities

ONSET = 0.02
FILMS = {"pi_film": pi_film(), "short": short(0.5), "finite": finite(0.71)}
EVERY = pytest.mark.parametrize("film", FILMS.values(), ids=FILMS.keys())
SPEEDS = [(1.0, 0.0), (-1.0, 0.0), (0.0, 1.0), (0.3, -1.0), (-0.01, 1.0)]


@EVERY
def test_is_the_film_itself_down_to_the_onset(film):
    mixed = with_asperities(film, ONSET)
    for eps, speeds in itertools.product((0.0, 0.5, 0.97, 1.0 - ONSET), SPEEDS):
        assert mixed(eps, *speeds) == film(eps, *speeds)


@EVERY
@pytest.mark.parametrize("eps", [1.0 - ONSET, 1.0, 1.0 + ONSET])
@pytest.mark.parametrize("speeds", SPEEDS)
def test_force_damping_and_stiffness_have_no_jump(film, eps, speeds):
    mixed = with_asperities(film, ONSET)
    below, at, above = (mixed(eps + d, *speeds) for d in (-1e-10, 0.0, 1e-10))
    assert below == pytest.approx(above, rel=1e-4, abs=1e-6 * max(map(abs, at)))


@EVERY
def test_fades_as_the_surfaces_sink_into_each_other(film):
    mixed = with_asperities(film, ONSET)
    depths = [1.0 - ONSET, 1.0, 1.0 + ONSET, 1.1, 1.5, 3.0, 100.0]
    damping = [-mixed(eps, 1.0, 0.0)[3] for eps in depths]
    assert all(a > b > 0.0 for a, b in itertools.pairwise(damping))
    assert damping[-1] < 1e-8 * damping[0]
    turning = [mixed(eps, 0.0, 1.0)[7] for eps in depths]
    assert 0.0 < max(turning) < 40.0 * turning[0]


@EVERY
@pytest.mark.parametrize("eps", [0.985, 1.0, 1.03])
def test_derivatives_beyond_the_onset(film, eps):
    mixed = with_asperities(film, ONSET)
    state = eps, -0.02, 0.9
    expected = slopes(mixed, state, (1e-7, 1e-6, 1e-6))[:, :2].T
    assert np.reshape(mixed(*state)[2:8], (2, 3)) == pytest.approx(expected, rel=1e-4)
