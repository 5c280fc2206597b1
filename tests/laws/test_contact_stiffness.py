"""Elastic parts of the normal contact against closed forms and their own integrals."""

import math

import pytest
from contacts import STIFFNESSES
from scipy.integrate import quad

from exu_press.laws.contact import cylindrical, hertz_stiffness


@pytest.mark.parametrize("stiffness", STIFFNESSES.values(), ids=STIFFNESSES)
def test_elastic_energy_is_the_integral_of_the_force(stiffness) -> None:
    for penetration in (1e-8, 0.99e-6, 1.01e-6, 1e-5, 1e-4, 1e-3):  # series and closed form
        work, _ = quad(lambda d: stiffness.force(d)[0], 0.0, penetration, epsabs=0, epsrel=1e-13)
        assert stiffness.energy(penetration) == pytest.approx(work, rel=1e-10)
        d = 1e-5 * penetration
        slope = (stiffness.force(penetration + d)[0] - stiffness.force(penetration - d)[0]) / (
            2 * d
        )
        assert stiffness.force(penetration)[1] == pytest.approx(slope, rel=1e-8)


@pytest.mark.validation(
    "closed form",
    "stiffness of a pin in a bore",
    "Z. F. Bai, Y. Zhao, J. Chen, Tribology International 64 (2013) 85-95",
    "equation",
)
def test_cylindrical_slope_is_the_stiffness_of_bai_zhao_chen_2013(compare) -> None:
    """K = 1/8 pi E L sqrt(2 delta (3 c + 2 delta)^2 / (c + delta)^3)."""
    modulus, length, c = 113.7e9, 0.1, 50e-6
    for d in (1e-7, 1e-5, 1e-3):
        published = (
            math.pi / 8 * modulus * length * math.sqrt(2 * d * (3 * c + 2 * d) ** 2 / (c + d) ** 3)
        )
        slope = cylindrical(modulus, length, c).force(d)[1]
        compare("stiffness", published, slope, error=0.0, rel=1e-12, unit="kN/um", show=1e-9)


def test_cylindrical_limits() -> None:
    modulus, length, c = 113.7e9, 0.1, 50e-6
    force = cylindrical(modulus, length, c).force
    closely_fitting = math.pi * modulus * length / (2 * math.sqrt(2))
    assert force(1e4 * c)[1] == pytest.approx(closely_fitting, rel=1e-4)
    assert force(2e-4 * c)[0] / force(1e-4 * c)[0] == pytest.approx(2**1.5, rel=1e-4)


def test_hertz_stiffness_of_eq_26() -> None:
    assert hertz_stiffness(0.04, 3.0e9) == pytest.approx(0.8e9)
