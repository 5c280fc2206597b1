"""Constraints against differences of residuals, and drawings whose redundant parts disagree."""

from dataclasses import replace

import numpy as np
import pytest
from drawings import coupled_cranks, slider_crank
from refused import refused

from exu_press.mechanism.examine import mobility_of
from exu_press.mechanism.independent_constraints import independent_constraints
from exu_press.mechanism.planar_constraints import (
    Coincidence,
    PlanarConstraints,
    PointOnLine,
    RotationRatio,
)
from exu_press.mechanism.turning import require_turning

MOVING = PlanarConstraints(
    size=1.0,
    bodies=("a", "b"),
    drawn=(0.0,) * 6,
    constraints=(
        ("pin", Coincidence(0, 0.3 + 0.1j, 1, -0.2 + 0.5j)),
        ("pivot", Coincidence(2, 0.1j, 1, 0.4 + 0j)),
        ("slot", PointOnLine(0, 0.2 - 0.1j, 1, 0.3j, 0.6 + 0.8j)),
        ("slide", PointOnLine(1, 0j, 0, 0.1 + 0.2j, 1j)),
        ("slide", RotationRatio(1, 0, 1.0, 0.3)),
        ("gear", RotationRatio(0, 1, -2.0, 0.0)),
    ),
)
"""Every kind, between two moving bodies and with the frame."""

RANDOM = np.random.default_rng(1)


def test_jacobian_and_rates_are_derivatives_of_the_residuals():
    """Rates are the second derivative, at constant rates of the coordinates."""
    q, q_t = RANDOM.normal(size=(2, 5, 6))
    step = 1e-6
    difference = (MOVING.residuals(q + step * q_t) - MOVING.residuals(q - step * q_t)) / (2 * step)
    rate = (MOVING.jacobian(q) @ q_t[..., None])[..., 0]
    assert rate == pytest.approx(difference, abs=1e-8)
    step = 1e-4
    ahead, now, before = (MOVING.residuals(q + k * step * q_t) for k in (1, 0, -1))
    difference = (ahead - 2 * now + before) / step**2
    assert MOVING.rates(q, q_t) == pytest.approx(difference, abs=1e-6)


def moved(mechanism, name, shift):
    """A drawing with one joint moved along x, by a part of its size."""
    joints = tuple(
        replace(j, at=(j.at[0] + shift * mechanism.size, j.at[1])) if j.name == name else j
        for j in mechanism.joints
    )
    return replace(mechanism, joints=joints)


REDUNDANT = [
    (coupled_cranks(), "pin"),
    (coupled_cranks(), "axle"),
    (slider_crank(second_rod=True), "rod_big_end"),
]


@pytest.mark.parametrize(("mechanism", "joint"), REDUNDANT)
def test_redundant_parts_agree_to_the_drawings_precision(mechanism, joint):
    drawn = moved(mechanism, joint, 1e-7)
    require_turning(drawn)
    assert mobility_of(drawn).redundant == 1
    ideal = frozenset(j.name for j in drawn.joints)
    exact = independent_constraints(mechanism, ideal)
    assert independent_constraints(drawn, ideal).redundant == exact.redundant
    assert "do not agree" in refused(require_turning, moved(mechanism, joint, 1e-4))
