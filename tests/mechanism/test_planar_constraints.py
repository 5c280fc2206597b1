"""Constraints against differences of residuals, and drawings whose redundant parts disagree."""

from dataclasses import replace

import numpy as np
import pytest
from drawings import coupled_cranks, slider_crank
from refused import refused

from exu_press import Scene, simulate
from exu_press.mechanism.examine import mobility_of
from exu_press.mechanism.independent_constraints import independent_constraints
from exu_press.mechanism.parts import ROD
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


def test_the_jacobian_is_the_derivative_of_the_residuals():
    q, q_t = RANDOM.normal(size=(2, 5, 6))
    step = 1e-6
    difference = (MOVING.residuals(q + step * q_t) - MOVING.residuals(q - step * q_t)) / (2 * step)
    rate = (MOVING.jacobian(q) @ q_t[..., None])[..., 0]
    assert rate == pytest.approx(difference, abs=1e-8)


def test_rates_are_the_second_derivative_at_constant_rates_of_the_coordinates():
    q, q_t = RANDOM.normal(size=(2, 5, 6))
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
    for shift in (2.5e-9, 1e-7):
        drawn = moved(mechanism, joint, shift)
        require_turning(drawn)
        assert mobility_of(drawn).redundant == mobility_of(mechanism).redundant == 1
        ideal = frozenset(j.name for j in drawn.joints)
        assert (
            independent_constraints(drawn, ideal).redundant
            == independent_constraints(mechanism, ideal).redundant
        )
    assert "do not agree" in refused(require_turning, moved(mechanism, joint, 1e-4))


def test_two_joints_a_nanometre_apart_are_in_one_place():
    """A rod between two places, and a crank whose joints all lie on its shaft."""
    drawing = slider_crank(second_rod=True)
    end = next(joint for joint in drawing.joints if joint.name == "rod_small_end")
    twin = replace(end, name="twin", at=(end.at[0] + 1e-9, end.at[1]))
    rods = tuple(
        replace(body, inertia=ROD) if body.name == "rod" else body for body in drawing.bodies
    )
    found = replace(drawing, bodies=rods, joints=(*drawing.joints, twin))
    assert found.body("rod").inertia == pytest.approx(drawing.body("rod").inertia, rel=1e-7)
    on_shaft = [replace(j, at=(1e-9, 0.0)) if "big_end" in j.name else j for j in drawing.joints]
    assert "lie on its shaft" in refused(lambda: replace(drawing, joints=tuple(on_shaft)))


def test_coupled_cranks_drawn_with_a_nanometre_of_disagreement_run():
    exact, drawn = (
        simulate(Scene(mechanism=m, revolutions=0.3))
        for m in (coupled_cranks(), moved(coupled_cranks(), "pin", 2.5e-9))
    )
    assert drawn.info["status"] == "completed"
    peaks = [np.abs(run["drive_torque"]).max() for run in (exact, drawn)]
    assert peaks[1] == pytest.approx(peaks[0], rel=1e-3)
