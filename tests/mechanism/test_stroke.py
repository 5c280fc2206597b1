"""Stroke, dead centres and transmission angles against closed forms; mobility and faults."""

import math
from dataclasses import replace

import numpy as np
import pytest
from drawings import coupled_cranks, four_bar, slider_crank, stephenson

from exu_press import InputError, Scene
from exu_press.mechanism import (
    GROUND,
    Joint,
    Press,
    change_mechanism,
    mechanism_from_dict,
    mechanism_to_dict,
    press,
    shipped_mechanism,
)
from exu_press.mechanism.examine import examine, mobility_of
from exu_press.mechanism.stroke import stroke_of
from exu_press.mechanism.transmission import (
    group_equal_angles,
    least_transmission_angle,
    transmission_angles,
)

ANGLES = np.radians(np.arange(0.0, 361.0))
R, L = 0.1, 0.4


def test_an_offset_slider_crank_turns_back_where_rod_and_crank_are_in_line():
    """Stroke sqrt((l + r)^2 - e^2) - sqrt((l - r)^2 - e^2).

    The mechanical advantage is the crank's speed over the slider's.
    """
    offset, at = 0.05, 0.7
    found = stroke_of(slider_crank(offset=offset, crank=R, rod=L, at=at), ANGLES)
    far, near = (math.sqrt((L + sign * R) ** 2 - offset**2) for sign in (1, -1))
    assert found.length == pytest.approx(far - near, abs=1e-14)
    outer = math.asin(offset / (L + R))
    inner = math.asin(offset / (L - R)) + math.pi
    expected = sorted((angle - at) % (2 * math.pi) for angle in (outer, inner))
    assert [centre.angle for centre in found.dead_centres] == pytest.approx(expected, abs=1e-11)
    assert [centre.top for centre in found.dead_centres] == [False, True]
    product = found.mechanical_advantage * np.abs(found.velocity)
    assert product == pytest.approx(1.0, abs=1e-8)


def test_the_largest_velocity_lies_between_whole_degrees():
    """A trammel's tracer (0.03, 0.01): x = 0.03 cos - 0.01 sin of the crank's angle."""
    found = stroke_of(shipped_mechanism("elliptic_trammel"), ANGLES)
    assert found.peak_velocity == pytest.approx(math.hypot(0.03, 0.01), rel=1e-10)
    assert math.tan(found.peak_angle) == pytest.approx(-3.0, rel=1e-4)


@pytest.mark.parametrize("offset", [0.0, 0.05])
def test_transmission_angle_of_a_slider_crank(offset):
    """cos mu = (r sin theta - e) / l."""
    at = 0.7
    found = transmission_angles(slider_crank(offset=offset, crank=0.1, rod=0.4, at=at), ANGLES)
    (values,) = found.values()
    expected = np.arccos(np.abs(0.1 * np.sin(ANGLES + at) - offset) / 0.4)
    assert values == pytest.approx(expected, abs=1e-12)


def test_transmission_angle_of_a_four_bar():
    """The law of cosines over the distance of crank pin and pivot; least on the frame's line."""
    at, (crank, coupler, rocker, base) = np.radians(90.3), (0.1, 0.4, 0.3, 0.35)
    mechanism = four_bar(crank, coupler, rocker, base, at)
    found = transmission_angles(mechanism, ANGLES)
    assert list(found) == ["knuckle"]
    across = crank**2 + base**2 - 2 * crank * base * np.cos(ANGLES + at)
    cosine = (coupler**2 + rocker**2 - across) / (2 * coupler * rocker)
    values = found["knuckle"]
    assert values == pytest.approx(np.arccos(np.abs(cosine)), abs=1e-11)
    least, angle = least_transmission_angle(mechanism, "knuckle", ANGLES[values.argmin()])
    cosine = (coupler**2 + rocker**2 - (base - crank) ** 2) / (2 * coupler * rocker)
    assert least == pytest.approx(np.arccos(cosine), abs=1e-10) and least < values.min()
    assert angle == pytest.approx(2.0 * np.pi - at, abs=1e-5), "0.3 deg from a whole one"
    assert transmission_angles(stephenson(), ANGLES) == {}


def test_equal_transmission_angles_are_named_together_smallest_first():
    values = np.array([1.0, 0.5])
    found = group_equal_angles({"a": values + 0.1, "left": values, "right": values.copy()})
    assert [name for name, _ in found] == ["left, right", "a"]


@pytest.mark.parametrize("slope", [0.0, 30.0, -50.0])
def test_transmission_angle_of_a_slot_is_between_its_normal_and_that_of_the_guide(slope):
    yoke, along = mechanism_to_dict(shipped_mechanism("scotch_yoke")), np.radians(90.0 + slope)
    yoke = change_mechanism(yoke, {"slots.yoke_slot.direction": [np.cos(along), np.sin(along)]})
    values = transmission_angles(mechanism_from_dict(yoke), ANGLES)["yoke_slot"]
    assert np.degrees(values) == pytest.approx(90.0 - abs(slope))


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
