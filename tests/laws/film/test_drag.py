"""What a film's shear takes: Sommerfeld, Reynolds' equation, published friction tables."""

import math

import numpy as np
import pytest
from exact_bearings import long_full_film_moments, long_half_film_moments
from test_finite_bearing import BUTENSCHOEN, ERROR, WIDTHS, rows

from exu_press.joints.interface import FilmInterface
from exu_press.laws.film import finite, pi_film


def moments(law, eps, eps_dot, eps_w, spin):
    """On journal and bearing of a pair with P c = 1; the film's W is eps_w / eps."""
    pair = FilmInterface(law, 1.0, 1.0)
    v_t = 0.5 * (eps * spin - eps_w)  # the bearing stands still
    load = pair.load(eps, eps_dot, v_t, spin, 0.0)
    return load[2], load[3]


@pytest.mark.validation(
    "closed form",
    "drag of a long bearing's full film",
    "A. Sommerfeld, Z. Math. Phys. 50 (1904) 97-155",
    "equation",
)
@pytest.mark.parametrize("eps", [0.1, 0.5, 0.8])
def test_sommerfeld_1904_full_film(eps, compare):
    """A film that may pull: what differs in the two closed forms is the couple e x F."""

    def sommerfeld(eps, eps_dot, eps_w):
        _, f_t, *_ = pi_film()(eps, 0.0, eps_w)
        return (0.0, 2.0 * f_t, *[0.0] * 6, *pi_film()(eps, 0.0, eps_w)[8:])

    size = 4.0 * math.pi / ((2.0 + eps**2) * math.sqrt(1.0 - eps**2))
    closed = -size * (1.0 + 2.0 * eps**2), size * (1.0 - eps**2)
    computed = moments(sommerfeld, eps, 0.0, eps, 1.0)
    compare("moment on journal and bearing over P c", closed, computed, error=0.0, rel=1e-12)
    assert long_full_film_moments(eps, eps, 1.0) == pytest.approx(closed, rel=1e-5)


@pytest.mark.parametrize("eps", [0.0, 0.3, 0.8])
@pytest.mark.parametrize("speeds", [(0.0, 1.0), (0.4, 0.7), (-0.4, 0.7)])
def test_long_half_film_against_the_stress_on_both_walls(eps, speeds):
    eps_dot, eps_w = speeds
    found = long_half_film_moments(eps, eps_dot, eps_w, 1.3)
    assert moments(pi_film(), eps, eps_dot, eps_w, 1.3) == pytest.approx(found, rel=1e-4)


def friction(ratio, eps):
    """(R / c) f of a journal that turns steadily: its moment over c times the load."""
    f_r, f_t, *_ = finite(ratio)(eps, 0.0, eps)
    return -moments(finite(ratio), eps, 0.0, eps, 1.0)[0] / math.hypot(f_r, f_t)


@BUTENSCHOEN
def test_butenschoen_1976_friction(compare):
    """mu / psi = pi / (So sqrt(1 - eps^2)) + eps / 2 sin(beta), So and beta from his tables.

    The formula as MBDyn's module-hydrodynamic_plain_bearing has it from him; DIN 31652 has it too.
    """
    ratios, load = rows("rotation")
    sine = np.sin(np.radians(rows("attitude")[1]))
    eps = ratios[:, None]
    published = math.pi / (load * np.sqrt(1.0 - eps**2)) + 0.5 * eps * sine
    computed = np.array([[friction(width, e) for width in WIDTHS] for e in ratios])
    assert np.abs(computed / published - 1.0).mean() < 2e-3
    compare("friction, mu / psi", published, computed, error=ERROR * computed, rel=1e-2)
