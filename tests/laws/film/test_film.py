"""What every film law owes, and films under touching asperities, which fade without a jump."""

import itertools
import math
import random

import numpy as np
import pytest
from slopes import slopes

from exu_press.laws.film import finite, pi_film, short, with_asperities
from exu_press.scene.film import FILMS

LAWS = {name: FILMS[name]().film(0.4) for name in ("pinkus", "pi_film", "short", "finite")} | {
    "finite_1": finite(1.0),
    "finite_4": finite(4.0),
    "mixed_pi_film": with_asperities(pi_film(), 0.05),
    "mixed_finite": with_asperities(finite(0.71), 0.05),
}
EVERY = pytest.mark.parametrize("law", LAWS.values(), ids=LAWS.keys())


def states(count, highest=0.999, seed=1):
    rng = random.Random(seed)
    for _ in range(count):
        eps = min(rng.choice([rng.random(), 1.0 - 10.0 ** rng.uniform(-3, 0)]), highest)
        speed, turn = 10.0 ** rng.uniform(-3, 3), rng.uniform(0, 2 * math.pi)
        yield eps, speed * math.cos(turn), speed * math.sin(turn)


@EVERY
def test_derivatives_against_central_differences(law):
    for state in states(300, highest=0.99, seed=4):
        exact = law(*state)
        eps, speed = state[0], math.hypot(*state[1:])
        scale = min(1.0 - eps, eps) * np.array([1.0, speed, speed])
        off = np.abs(slopes(law, state, 1e-4 * scale)[:, :2].T - np.reshape(exact[2:8], (2, 3)))
        allowed = 1e-4 * np.abs(np.reshape(exact[2:8], (2, 3)))
        assert (off < allowed + 2e-6 * math.hypot(exact[0], exact[1]) / scale).all()


@EVERY
def test_mirror_image_under_reversed_rotation(law):
    for eps, eps_dot, eps_w in states(100, seed=5):
        f, g = law(eps, eps_dot, eps_w), law(eps, eps_dot, -eps_w)
        signs = (1, -1, 1, 1, -1, -1, -1, 1, 1, 1)
        assert g == pytest.approx([s * x for s, x in zip(signs, f, strict=True)], rel=1e-12)


@EVERY
@pytest.mark.parametrize("eps", [0.0, 0.3, 0.9, 0.97])
def test_drag_is_the_shear_all_round_the_gap_the_film_has(law, eps):
    """j = integral of d theta / h; of a mixed film h is the gap that stays open."""
    shear, by_eps = law(eps, 0.3, -0.7)[8:]
    gap = 1.0 - eps
    if law in (LAWS["mixed_pi_film"], LAWS["mixed_finite"]) and gap < 0.05:
        gap = 0.05 - 0.025 * math.atan(2.0 * (0.05 - gap) / 0.05)
    theta = np.linspace(0.0, 2.0 * math.pi, 4001)[:-1]
    around = np.mean(1.0 / (1.0 - (1.0 - gap) * np.cos(theta))) * 2.0 * math.pi
    assert shear == pytest.approx(around, rel=1e-12)
    if eps > 0.0:
        wider, narrower = law(eps - 1e-6, 0.3, -0.7)[8], law(eps + 1e-6, 0.3, -0.7)[8]
        assert by_eps == pytest.approx((narrower - wider) / 2e-6, rel=1e-6)


@EVERY
def test_isotropic_damper_at_the_centre(law):
    damping = -law(0.0, 1.0, 0.0)[0]
    if law in (LAWS["pinkus"], LAWS["pi_film"]):
        assert damping == pytest.approx(6.0 * math.pi)
    for turn in (0.3, 1.0, 2.0, 4.0, 5.5):
        f_r, f_t, *_ = law(0.0, math.cos(turn), 2.0 * math.sin(turn))
        assert f_r == pytest.approx(-damping * math.cos(turn))
        assert f_t == pytest.approx(damping * math.sin(turn))


ONSET = 0.02
UNDER_ASPERITIES = {"pi_film": pi_film(), "short": short(0.5), "finite": finite(0.71)}
EVERY_FILM = pytest.mark.parametrize("film", UNDER_ASPERITIES.values(), ids=UNDER_ASPERITIES.keys())
SPEEDS = [(1.0, 0.0), (-1.0, 0.0), (0.0, 1.0), (0.3, -1.0), (-0.01, 1.0)]


@EVERY_FILM
def test_is_the_film_itself_down_to_the_onset(film):
    mixed = with_asperities(film, ONSET)
    for eps, speeds in itertools.product((0.0, 0.5, 0.97, 1.0 - ONSET), SPEEDS):
        assert mixed(eps, *speeds) == film(eps, *speeds)


@EVERY_FILM
@pytest.mark.parametrize("eps", [1.0 - ONSET, 1.0, 1.0 + ONSET])
@pytest.mark.parametrize("speeds", SPEEDS)
def test_force_damping_and_stiffness_have_no_jump(film, eps, speeds):
    mixed = with_asperities(film, ONSET)
    below, at, above = (mixed(eps + d, *speeds) for d in (-1e-10, 0.0, 1e-10))
    assert below == pytest.approx(above, rel=1e-4, abs=1e-6 * max(map(abs, at)))


@EVERY_FILM
def test_fades_as_the_surfaces_sink_into_each_other(film):
    mixed = with_asperities(film, ONSET)
    depths = [1.0 - ONSET, 1.0, 1.0 + ONSET, 1.1, 1.5, 3.0, 100.0]
    damping = [-mixed(eps, 1.0, 0.0)[3] for eps in depths]
    assert all(a > b > 0.0 for a, b in itertools.pairwise(damping))
    assert damping[-1] < 1e-8 * damping[0]
    turning = [mixed(eps, 0.0, 1.0)[7] for eps in depths]
    assert 0.0 < max(turning) < 40.0 * turning[0]
