"""Friction laws against Canudas de Wit et al. 1995, their limits and finite differences."""

import itertools
import math
import random

import pytest
from scipy.integrate import solve_ivp

from exu_press.laws.friction import LuGre, coulomb, lugre_steady, no_friction, stribeck

# Canudas de Wit et al. 1995, Table I, with a unit normal force.
CANUDAS = LuGre(1.5, 1.0, 1e5, math.sqrt(1e5), 0.4, stribeck_velocity=1e-3, stribeck_exponent=2.0)
STATELESS = {
    "none": no_friction(),
    "coulomb": coulomb(0.1, 1e-3),
    "stribeck": stribeck(0.2, 0.1, 0.01, 0.5, 1e-3, sigma_2=0.05),
    "lugre_steady": lugre_steady(0.2, 0.1, 0.05, 0.01, 2.0, 1e-3),
}


def force(v: float, z: float) -> float:
    """Friction force of the bristle's own differential equation."""
    return CANUDAS.sigma_0 * z + CANUDAS.sigma_1 * CANUDAS.rate(v, z) + CANUDAS.sigma_2 * v


def unit_mass(load, until: float, **options):
    """Integrate a unit mass under load(t, x), with CANUDAS' friction."""
    return solve_ivp(
        lambda t, y: (y[1], load(t, y[0]) - force(y[1], y[2]), CANUDAS.rate(y[1], y[2])),
        (0.0, until), (0.0, 0.0, 0.0), "LSODA", rtol=1e-12, atol=1e-14, **options,
    )  # fmt: skip


def pulled(t: float, x: float) -> float:
    """Spring k = 2 N/m pulled at 0.1 m/s."""
    return 2.0 * (0.1 * t - x)


def test_canudas_de_wit_1995_stick_slip() -> None:
    x, v, _ = unit_mass(pulled, 25.0).y[:, -1]
    assert x == pytest.approx(1.9088391992, abs=2e-9)
    assert v == pytest.approx(9.4241546e-6, rel=1e-7)


def test_the_bristle_is_of_second_order() -> None:
    """In a given, smooth motion, against its differential equation."""
    friction = LuGre(0.24, 0.21, 7e3, 400.0, 0.0, 0.01, 2.0)

    def speed(t: float) -> float:
        return 0.05 * math.sin(40.0 * t) + 0.06

    def stepped(count: int) -> float:
        z, h = 0.0, 0.1 / count
        for i in range(count):
            z = friction.advance(speed((i + 1) * h), z, h, speed(i * h))[2]
        return z

    exact = solve_ivp(
        lambda t, z: [friction.rate(speed(t), z[0])], (0.0, 0.1), [0.0], rtol=1e-11, atol=1e-16
    ).y[0, -1]
    errors = [abs(stepped(count) - exact) for count in (200, 400, 800)]
    orders = [math.log2(a / b) for a, b in itertools.pairwise(errors)]
    assert orders == pytest.approx([2.0, 2.0], abs=0.1)


def test_a_reversal_may_be_anywhere_in_a_step() -> None:
    """A linear speed through zero in steps far above the bristle's time constant."""
    friction = LuGre(0.21, 0.21, 1e5, 400.0, 0.0, 0.01, 2.0)
    exact = solve_ivp(
        lambda t, z: [friction.rate(0.01 - 10.0 * t, z[0])],
        (0.0, 2.1e-3), [2.1e-6], rtol=1e-11, atol=1e-16,
    ).y[0, -1]  # fmt: skip
    assert friction.advance(-0.011, 2.1e-6, 2.1e-3, 0.01)[2] == pytest.approx(exact, rel=1e-6)
    assert exact < -1.5e-6


def test_presliding_stiffness_is_sigma_0() -> None:
    friction = LuGre(1.5, 1.0, 1e5, 0.0, 0.0, 1e-3, 2.0)
    displacement, z = 1e-8, 0.0
    for _ in range(10):
        mu, _, z = friction.advance(v=1e-9, z0=z, h=displacement / 10 / 1e-9)
    assert mu / displacement == pytest.approx(1e5, rel=1e-3)
    assert z == pytest.approx(displacement, rel=1e-3)


@pytest.mark.parametrize("v", [-2.0, -0.01, -1e-3, 1e-4, 1e-3, 0.01, 2.0])
def test_bristle_in_steady_sliding_is_eq_33(v: float) -> None:
    """With steps far below and far above the bristle's time constant g / (sigma_0 |v|)."""
    steady = lugre_steady(1.5, 1.0, 0.4, 1e-3, 2.0, regularisation_velocity=1e-6)(v)[0]
    for h, count in ((1e-6 / abs(v), 500), (1e-2 / abs(v), 10)):
        z = 0.0
        for _ in range(count):
            mu, _, z = CANUDAS.advance(v, z, h)
        assert mu == pytest.approx(steady, rel=1e-9)
    g = 1.0 + 0.5 * math.exp(-((v / 1e-3) ** 2))
    assert steady == pytest.approx(math.copysign(g, v) + 0.4 * v, rel=1e-14)


def test_bristle_with_no_step_is_its_own_instant_value() -> None:
    """Its damping falls with the speed, so that a relaxed bristle makes no energy."""
    limit = 4.0 * math.sqrt(2.0 * math.e) * CANUDAS.mu_kinetic / CANUDAS.sigma_1
    for v, z in ((0.0, 1e-6), (1e-3, -1e-6), (-0.2, 5e-6)):
        mu, _, z1 = CANUDAS.advance(v, z, 0.0)
        damping = CANUDAS.sigma_1 * math.exp(-((v / limit) ** 2))
        assert z1 == z
        assert mu == pytest.approx(1e5 * z + damping * CANUDAS.rate(v, z) + 0.4 * v, rel=1e-12)


def test_bristle_derivative_against_finite_differences() -> None:
    rng = random.Random(7)
    for exponent in (0.5, 1.0, 2.0):
        friction = LuGre(0.2, 0.1, 1e5, 400.0, 0.1, 0.01, exponent)
        for _ in range(200):
            v = rng.choice((-1, 1)) * 10 ** rng.uniform(-5, 0)
            z, h = rng.uniform(-2e-6, 2e-6), rng.choice((0.0, 1e-7, 1e-5, 1e-3))
            d = 1e-5 * abs(v)
            start = rng.choice((None, rng.uniform(-2.0, 2.0) * v))
            low, high = (friction.advance(v + s * d, z, h, start)[0] for s in (-1, 1))
            slope = friction.advance(v, z, h, start)[1]
            tolerance = 1e-6 * abs(slope) + 1e-11 * abs(high) / d
            assert (high - low) / (2 * d) == pytest.approx(slope, abs=tolerance)
        for h in (0.0, 1e-4):  # v = 0: the mean of the two sides
            d = 1e-9
            low, high = (friction.advance(s * d, 1e-6, h)[0] for s in (-1, 1))
            slope = friction.advance(0.0, 1e-6, h)[1]
            if exponent == 2.0:
                assert (high - low) / (2 * d) == pytest.approx(slope, rel=1e-4)
            assert math.isfinite(slope)


@pytest.mark.parametrize("name", list(STATELESS))
def test_stateless_derivatives_are_exact_and_the_laws_odd_and_dissipative(name: str) -> None:
    friction, rng = STATELESS[name], random.Random(5)
    assert friction(0.0)[0] == 0.0
    for _ in range(200):
        v = rng.choice((-1, 1)) * 10 ** rng.uniform(-5, 1)
        mu, slope = friction(v)
        d = 1e-5 * abs(v)
        low, high = friction(v - d)[0], friction(v + d)[0]
        tolerance = 1e-7 * abs(slope) + 1e-10 * abs(mu) / abs(v)
        assert (high - low) / (2 * d) == pytest.approx(slope, abs=tolerance)
        assert mu * v >= 0.0
        assert friction(-v) == (-mu, slope)


def test_stribeck_limits() -> None:
    friction = stribeck(0.3, 0.1, 0.1, 2.0, 1e-5, sigma_2=0.02)
    assert friction(0.0) == (0.0, pytest.approx(0.3 / 1e-5 + 0.02))
    assert friction(1e-3)[0] == pytest.approx(0.3, rel=1e-3)  # v_r << v << v_s: static
    assert friction(0.1)[0] == pytest.approx(0.1 + 0.2 / math.e + 0.002)
    assert friction(10.0) == (pytest.approx(0.3), pytest.approx(0.02))  # kinetic and viscous
    flat = stribeck(0.1, 0.1, 0.1, 2.0, 1e-3)
    assert flat(2e-3) == pytest.approx(coulomb(0.1, 1e-3)(2e-3))
