"""What is wrong with a drawing is found where it is wrong."""

import math
from dataclasses import replace

import numpy as np
import pytest
from drawings import coupled_cranks, four_bar, slider_crank

from exu_press import InputError, Scene
from exu_press.mechanism import GROUND, Joint, Press, press
from exu_press.mechanism.examine import examine, mobility_of


def test_links_that_are_too_short_are_named_with_the_position_of_their_lock():
    """A rod of 0.15 with a crank of 0.2 and no offset locks where r sin theta = l."""
    whole = slider_crank(crank=0.2, rod=0.15, at=0.0)
    found = examine(whole)
    assert found.stroke is None
    assert set(found.wrong_bodies) == {"rod", "slider"}
    assert found.wrong_joints == ("rod_small_end",)
    lock = math.asin(0.15 / 0.2)
    assert found.error.angle == pytest.approx(lock, abs=1e-5)
    at = found.error.angle
    pin = 0.2 * np.array([math.cos(at), math.sin(at)])
    slider = found.error.poses["slider"]
    assert math.dist(pin, slider[:2]) == pytest.approx(0.15, abs=1e-12)


def test_a_body_that_nothing_holds_is_named():
    found = examine(replace(slider_crank(), guides=()))
    assert set(found.wrong_bodies) == {"rod", "slider"} == set(found.mobility.loose_bodies)
    assert found.mobility.degrees_of_freedom == 3 == found.mobility.gruebler_count
    said = (
        "2 degrees of freedom too many: with the crank held, rod, slider can still move, held by "
    )
    assert found.faults[1] == said + "joints.rod_big_end, joints.rod_small_end alone"
    with pytest.raises(InputError, match=said):
        Scene(mechanism=found.mechanism, joints={})


def test_one_degree_of_freedom_whatever_is_redundant():
    for mechanism, redundant in (
        (four_bar(), 0),
        (slider_crank(second_rod=True), 1),
        (coupled_cranks(), 1),
        (press(Press()), 3),
    ):
        found = mobility_of(mechanism)
        assert found.crank_turns and not found.loose_bodies and found.overconstraining == ()
        assert (found.degrees_of_freedom, found.redundant) == (1, redundant)
        assert found.gruebler_count == 1 - redundant


def test_a_link_held_by_one_joint_too_many_stops_the_crank():
    whole = four_bar()
    extra = Joint("extra", (0.2, 0.1), "coupler", GROUND)
    bodies = tuple(replace(body, inertia=0.1) for body in whole.bodies)
    found = mobility_of(replace(whole, bodies=bodies, joints=(*whole.joints, extra)))
    assert (found.degrees_of_freedom, found.crank_turns, found.gruebler_count) == (0, False, -1)
    assert "joints.extra" in found.overconstraining
    assert "joints.shaft" not in found.overconstraining
