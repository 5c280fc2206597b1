"""Constraints: their derivatives; of redundant ones as many as the rank of all."""

from dataclasses import replace

import numpy as np
import pytest
from drawings import coupled_cranks, four_bar, slider_crank

from exu_press import InputError, Scene, simulate
from exu_press.mechanism import Press, Spring, press
from exu_press.mechanism.independent_constraints import independent_constraints
from exu_press.mechanism.planar_constraints import (
    Coincidence,
    PlanarConstraints,
    PointOnLine,
    RotationRatio,
)

PRESS = press(Press())
BALLS = ("ball_left", "ball_right")


def holding(mechanism, *loose):
    """What holds it where some joints have clearance."""
    return independent_constraints(
        mechanism, frozenset(j.name for j in mechanism.joints) - {*loose}
    )


def elastic(mechanism):
    spring = Spring(1e9, 1e5)
    guides = [replace(g, lateral=spring, tilting=spring) for g in mechanism.guides]
    return replace(mechanism, guides=tuple(guides))


def kept(mechanism, *loose):
    """How many coordinates the mechanism keeps."""
    found = holding(mechanism, *loose)
    constraints = 2 * len(found.pivots) + 2 * len(found.sliding_bodies)
    constraints += 2 * len(found.joints) + len(found.single_axis)
    constraints += sum(map(sum, found.guides.values()))
    return 3 * len(mechanism.bodies) - constraints


def test_every_joint_with_clearance_frees_two_coordinates():
    """Unless guides hold them as well, as they do for three of the balls' four directions.

    Elastic guides free ten, but three were held by the balls as well.

    With both sides loose the slider's guide keeps them level: one coordinate less.
    """
    for mechanism in (PRESS, four_bar(), slider_crank(0.5), slider_crank(second_rod=True)):
        assert kept(mechanism) == 1
    assert kept(elastic(PRESS)) == 1 + 10 - 3
    assert kept(PRESS, "crank_pin") == 3
    assert kept(PRESS, "crank_pin", "knuckle_6_left", "pivot_right", "shaft") == 9 - 1
    assert kept(PRESS, "ball_left") == 1
    assert kept(PRESS, *BALLS) == 2


def test_two_balls_hold_the_slider_upright_and_share_its_load():
    found = holding(PRESS)
    assert set(found.single_axis) == set(BALLS)
    for half in found.single_axis.values():
        assert abs(np.sin(half.angle)) == pytest.approx(1.0)
    assert found.guides == {"slider": (True, False)}
    assert set(found.redundant) == {"slider", *BALLS}


def test_what_stands_on_the_frame_or_in_a_guide_needs_no_constraint():
    found = holding(PRESS)
    assert set(found.pivots) == {"crank", "link_6_left", "link_6_right"}
    assert found.sliding_bodies == {"slide", "plunger_left", "plunger_right", "counterweight"}
    oblique = holding(slider_crank(tilt=0.5))
    assert not oblique.sliding_bodies and oblique.guides == {"slider": (True, True)}
    assert holding(four_bar()).pivots["rocker"].journal == "frame"


def test_half_a_joint_holds_no_flexible_body():
    pytest.importorskip("ngsolve")
    drawn = slider_crank(crank=0.03, rod=0.383, second_rod=True)
    ends = dict(zip(("big", "small"), drawn.joints_of("other_rod"), strict=True))
    (x, y), (end_x, end_y) = (joint.at for joint in ends.values())
    part = {
        "flexible": "linkage", "modes": 0, "mesh_size": 0.1,
        "faces": {joint.name: f"{bore} bore" for bore, joint in ends.items()},
        "origin": [(x + end_x) / 2, (y + end_y) / 2],
        "angle_deg": np.degrees(np.arctan2(end_y - y, end_x - x)),
    }  # fmt: skip
    said = r"bodies\.other_rod: .*joints\.other_rod_.*_end"
    with pytest.raises(InputError, match=said):
        Scene(mechanism=drawn, joints={}, bodies={"other_rod": part}).build()


def test_coupled_cranks_are_held_by_both_rods():
    """In a dead centre of one rod the other one alone turns the follower."""
    found = holding(coupled_cranks())
    assert found.keeps_redundant and not found.single_axis
    assert set(found.joints) == {"pin", "far_pin", "other_pin", "other_far_pin"}
    assert not holding(slider_crank(second_rod=True)).keeps_redundant
    assert not holding(PRESS).keeps_redundant


@pytest.mark.parametrize("start", [0.0, 37.0, 90.0])
def test_coupled_cranks_go_through_their_dead_centres(start):
    scene = Scene(mechanism=coupled_cranks(), joints={}, start_angle_deg=start, revolutions=1.2)
    result = simulate(scene)
    assert result.completed, result.info["reason"]
    follower = result["body_position"][:, result.bodies.index("follower"), 2]
    assert np.abs(follower - result["crank_angle"]).max() < 1e-12
    rods = sum(result[f"{rod}_force"] for rod in ("far_pin", "other_far_pin"))
    assert np.abs(rods).max() < 100.0, "half the rods' centrifugal force and weight"
    assert result.quantity("energy.residual").value < 1e-3
    (told,) = result.summary()["warnings"]
    assert told.startswith("other_far_pin: other ideal joints hold the same")


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
