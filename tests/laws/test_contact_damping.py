"""Normal contact with damping: derivatives, dissipation, contact from rest."""

import math

import pytest
from contacts import DELIVERED, chi_of, contacts, random_states

from exu_press.laws.contact import (
    delivered_restitution,
    restitution_of,
    step,
)
from exu_press.laws.contact.damping import Approach


def test_adams_step_at_its_ends() -> None:
    assert step(-1.0, 0.0, 2.0, 1.0, 5.0) == (2.0, 0.0)
    assert step(0.0, 0.0, 2.0, 1.0, 5.0) == (2.0, 0.0)
    assert step(1.0, 0.0, 2.0, 1.0, 5.0) == (5.0, 0.0)
    assert step(9.0, 0.0, 2.0, 1.0, 5.0) == (5.0, 0.0)
    assert step(0.5, 0.0, 2.0, 1.0, 5.0) == (3.5, 4.5)
    for end, inside in ((0.0, 1e-9), (1.0, 1.0 - 1e-9)):
        assert step(inside, 0.0, 2.0, 1.0, 5.0)[0] == pytest.approx(step(end, 0, 2, 1, 5)[0])
        assert step(inside, 0.0, 2.0, 1.0, 5.0)[1] == pytest.approx(0.0, abs=2e-8)


@pytest.mark.parametrize("name", [*DELIVERED, "step"])
@pytest.mark.parametrize("tension", [False, True])
def test_derivatives_against_finite_differences(name: str, tension: bool) -> None:
    contact = contacts(tension)[name]
    for penetration, rate, speed in random_states(300):
        force, by_penetration, by_rate = contact.force(penetration, rate, speed)
        if force == 0.0:
            assert (by_penetration, by_rate) == (0.0, 0.0)
            continue
        d, r = 1e-5 * penetration, 1e-5
        values = [contact.force(penetration + s * d, rate, speed)[0] for s in (-1, 1)]
        if min(values) > 0.0 or tension:
            central = (values[1] - values[0]) / (2 * d)
            scale = abs(by_penetration) + max(map(abs, values)) / penetration
            assert central == pytest.approx(by_penetration, abs=1e-6 * scale)
        values = [contact.force(penetration, rate + s * r, speed)[0] for s in (-1, 1)]
        if min(values) > 0.0 or tension:
            assert (values[1] - values[0]) / (2 * r) == pytest.approx(by_rate, rel=1e-6)


@pytest.mark.parametrize("name", [*DELIVERED, "step"])
def test_dissipative_and_never_pulling_without_tension(name: str) -> None:
    pulling, divergence = contacts(tension=True)[name], contacts()[name]
    pulled = 0
    for penetration, rate, speed in random_states(1000):
        force = divergence.force(penetration, rate, speed)[0]
        pull = pulling.force(penetration, rate, speed)[0]
        elastic = divergence.stiffness.force(penetration)[0]
        assert force == max(pull, 0.0)
        assert rate * (force - elastic) >= 0.0
        assert rate * (pull - elastic) >= 0.0
        assert divergence.dissipated_power(penetration, rate, speed) == rate * (force - elastic)
        pulled += pull < 0.0
    assert pulled > 10  # the states do reach where A-10 matters


@pytest.mark.parametrize("name", list(DELIVERED))
def test_contact_beginning_at_rest_is_regular(name: str) -> None:
    contact = contacts()[name]
    assert contact.needs_impact_speed
    at_rest = contact.force(1e-5, 1e-4, 0.0)
    assert at_rest == contact.force(1e-5, 1e-4, 0.5e-3) == contact.force(1e-5, 1e-4, 1e-3)
    assert all(map(math.isfinite, at_rest))
    assert contact.force(1e-5, 0.0, 0.0)[0] == contact.stiffness.force(1e-5)[0]
    slower = delivered_restitution(contact, mass=1.0, speed=1e-5)
    assert delivered_restitution(contact, mass=1.0, speed=1e-3) < slower < 1.0
    assert slower == pytest.approx(restitution_of(chi_of(contact) / 100), abs=1e-6)


@pytest.mark.parametrize("acceleration", [-4e4, 0.0, 6e5])
@pytest.mark.parametrize("part", [0.1, 0.5, 0.95])
def test_the_speed_at_first_touch_lies_between_two_instants(
    acceleration: float, part: float
) -> None:
    """Under an even acceleration a, v^2 = v_0^2 + 2 a s; the gap is a part of the way."""
    start, way = 1.0, 1e-5
    gap = part * way
    end = math.sqrt(start**2 + 2.0 * acceleration * way)
    touch = math.sqrt(start**2 + 2.0 * acceleration * gap)
    approach = Approach()
    assert approach.speed(-gap, start) == start
    approach.accept()
    assert approach.speed(way - gap, end) == pytest.approx(touch, rel=1e-12)
    approach.accept()
    assert approach.speed(way, 0.3 * end) == pytest.approx(touch, rel=1e-12)  # kept in contact
