"""Restitution of the contact laws against published values and bounces."""

import math

import numpy as np
import pytest
from contacts import CASES
from scipy.integrate import solve_ivp

from exu_press.laws.contact import (
    DAMPING_LAWS,
    delivered_restitution,
    hertz,
    restitution_of,
    step_damping,
)


@pytest.mark.validation(
    "closed form",
    "restitution that five contact laws deliver",
    "roots of ln((1 + chi) / (1 - chi e)) = chi (1 + e), chi of each law's paper",
    "equation",
)
@pytest.mark.parametrize(("law", "wanted", "delivered"), CASES)
def test_restitution_table_by_a_bounce(law, wanted, delivered, compare) -> None:
    contact = DAMPING_LAWS[law](hertz(1e8), wanted)
    bounce = delivered_restitution(contact, mass=2.0, speed=0.3)
    compare("restitution of a bounce", delivered, bounce, error=None, abs=6e-5)


def test_restitution_of_meets_its_equation_and_its_limits() -> None:
    for chi in (1.1e-4, 1e-3, 0.1, 1.0, 5.0, 10.0):
        e = restitution_of(chi)
        assert math.log1p(chi) - math.log1p(-chi * e) == pytest.approx(chi * (1 + e), rel=1e-9)
    assert restitution_of(0.0) == 1.0
    assert restitution_of(1e-6) == pytest.approx(1 - 2e-6 / 3, abs=1e-12)
    assert restitution_of(0.99999e-4) == pytest.approx(restitution_of(1.00001e-4), abs=2e-9)
    assert restitution_of(1e6) == pytest.approx(1e-6)


def test_default_press_contact_is_a_dashpot() -> None:
    """Spec 2: with the printed c_max almost nothing rebounds."""
    contact = step_damping(hertz(2.5545e10), damping_max=2.5545e8, damping_depth=1e-5)
    for mass, delivered in ((1347.0, 9.350e-5), (200.0, 1.2245e-4)):
        assert delivered_restitution(contact, mass, 0.1) == pytest.approx(delivered, rel=1e-3)


@pytest.mark.validation(
    "closed form",
    "impact of a sphere without damping",
    "K. L. Johnson, Contact Mechanics (1985), section 11.4",
    "equation",
)
def test_undamped_hertz_depth_and_duration(compare) -> None:
    """delta_max = (5 m v^2 / 4 K)^0.4, T = 3.218 (m^2 / (K^2 v))^0.2 (Johnson 1985, section 11.4).

    The exact factor, 2 sqrt(pi) Gamma(1.4) / Gamma(0.9) 1.25^0.4, is 3.21806.
    """
    mass, stiffness, speed = 3.0, 1e8, 0.2
    contact = step_damping(hertz(stiffness), damping_max=0.0, damping_depth=1e-4)
    depth = (5 * mass * speed**2 / (4 * stiffness)) ** 0.4
    factor = 2 * math.sqrt(math.pi) * math.gamma(1.4) / math.gamma(0.9) * 1.25**0.4
    assert factor == pytest.approx(3.21799, rel=3e-5)
    duration = factor * (mass**2 / (stiffness**2 * speed)) ** 0.2
    assert contact.elastic_energy(depth) == pytest.approx(0.5 * mass * speed**2, rel=1e-12)

    def released(_t, y):
        return y[0]

    released.terminal, released.direction = True, -1
    bounce = solve_ivp(
        lambda _t, y: (y[1], -contact.force(y[0], y[1], speed)[0] / mass),
        (0.0, 2.0 * duration), (0.0, speed), "DOP853", events=released, rtol=1e-11, atol=1e-15,
        max_step=duration / 500,
    )  # fmt: skip
    compare("duration", duration, bounce.t[-1], error=None, rel=1e-8, unit="ms", show=1e3)
    compare("depth", depth, max(bounce.y[0]), error=None, rel=1e-4, unit="um", show=1e6)
    assert delivered_restitution(contact, mass, speed) == pytest.approx(1.0, abs=1e-6)


def test_the_default_law_delivers_what_is_wanted():
    """Hu and Guo's: to 0.013 from 0.5 to 1, and to 0.035 everywhere."""
    wanted = np.linspace(0.01, 1.0, 100)
    off = np.array([abs(restitution_of(1.5 * (1.0 - e) / e) - e) for e in wanted])
    assert off.max() < 0.035
    assert off[wanted >= 0.5].max() < 0.013
