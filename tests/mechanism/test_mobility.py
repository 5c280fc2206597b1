"""Degrees of freedom of drawings that move, move too much, or not at all."""

from dataclasses import replace

import pytest
from drawings import coupled_cranks, four_bar, slider_crank

from exu_press.mechanism import GROUND, Joint, Press, press
from exu_press.mechanism.mobility import mobility_of


@pytest.mark.parametrize(
    ("mechanism", "redundant"),
    [
        (four_bar(), 0),
        (slider_crank(), 0),
        (slider_crank(second_rod=True), 1),
        (coupled_cranks(), 1),
        (press(Press()), 3),
    ],
    ids=["four-bar", "slider-crank", "doubled rod", "coupled cranks", "press"],
)
def test_one_degree_of_freedom_whatever_is_redundant(mechanism, redundant):
    found = mobility_of(mechanism)
    assert found.is_driven
    assert (found.degrees_of_freedom, found.redundant, found.gruebler_count) == (
        1,
        redundant,
        1 - redundant,
    )
    assert found.overconstraining == ()


def test_a_body_without_its_guide_is_loose():
    whole = slider_crank()
    found = mobility_of(replace(whole, guides=()))
    assert found.degrees_of_freedom == 3 == found.gruebler_count
    assert found.crank_turns
    assert set(found.loose_bodies) == {"rod", "slider"}


def test_a_link_held_by_one_joint_too_many_stops_the_crank():
    whole = four_bar()
    extra = Joint("extra", (0.2, 0.1), "coupler", GROUND)
    bodies = tuple(replace(body, inertia=0.1) for body in whole.bodies)
    found = mobility_of(replace(whole, bodies=bodies, joints=(*whole.joints, extra)))
    assert (found.degrees_of_freedom, found.crank_turns, found.gruebler_count) == (0, False, -1)
    assert "joints.extra" in found.overconstraining
    assert "joints.shaft" not in found.overconstraining
