"""Geared shafts in drawings: ratios of angles, closed forms of paths, and what is refused."""

from dataclasses import replace

import numpy as np
import pytest

from exu_press import InputError
from exu_press.mechanism import shipped_mechanism
from exu_press.mechanism.examine import mobility_of
from exu_press.mechanism.gears import Gear
from exu_press.mechanism.turning import require_turning

TURN = np.linspace(0.0, 4.0 * np.pi, 333)


CLOSED_FORM = pytest.mark.validation(
    "closed form", "motion of geared presses", "trigonometry of their drawings", "equation"
)


def geared(name, **changes):
    mechanism = shipped_mechanism(name)
    (gear,) = mechanism.gears
    return replace(mechanism, gears=(replace(gear, **changes),))


@CLOSED_FORM
def test_a_planet_describes_a_hypocycloid(compare):
    """The rod's end at a exp(i t) + b exp(-2 i t) from the vertical, and the ram below it."""
    mechanism = shipped_mechanism("cycloidal_press")
    end = 1j * (0.08 * np.exp(1j * TURN) + 0.0276 * np.exp(-2j * TURN))
    point = mechanism.body("planet").local((0.0, 0.1076))
    path = mechanism.motion(TURN, 1.0)["planet"].point_motion(point).position
    for name, theirs, ours in (
        ("hypocycloid of the rod's end, x", end.real, path[:, 0]),
        ("hypocycloid of the rod's end, y", end.imag, path[:, 1]),
        (
            "height of the ram below a hypocycloid",
            end.imag - np.sqrt(0.6**2 - end.real**2),
            mechanism.ideal_slider(TURN, 1.0)[0],
        ),
    ):
        compare(name, theirs, ours, error=None, abs=1e-12, unit="m")


@CLOSED_FORM
def test_two_points_descend_alike(compare):
    mechanism = shipped_mechanism("two_point_press")
    slide = mechanism.motion(TURN, 1.0)["slide"].position
    arm = 0.05 * np.exp(1j * TURN)
    height = 0.8 + arm.real - np.sqrt(0.25 - arm.imag**2)
    compare("slide on two points", height, slide[:, 1], error=None, abs=1e-12, unit="m")
    assert np.abs(slide[:, [0, 2]]).max() < 1e-12
    mobility = mobility_of(mechanism)
    assert (mobility.degrees_of_freedom, mobility.redundant) == (1, 1)


@pytest.mark.parametrize(
    ("changes", "text"),
    [
        ({"body": "crank"}, r"gears\.planet: gears 'crank' to itself"),
        ({"body": "crank", "to": "rod"}, r"gears\.planet\.body = 'crank': is the crank"),
        ({"body": "frame"}, r"gears\.planet\.body = 'frame': unknown"),
        ({"ratio": 0}, r"gears\.planet\.ratio = 0: allowed is an integer, not 0"),
        ({"ratio": -1e20}, r"ratio = -1e\+20: allowed is an integer, not 0, of at most 1000"),
    ],
)
def test_refused(changes, text):
    with pytest.raises(InputError, match=text):
        geared("cycloidal_press", **changes)


def test_two_gears_that_disagree_are_told():
    mechanism = shipped_mechanism("two_point_press")
    doubled = replace(mechanism, gears=(*mechanism.gears, Gear("wrong", "second_crank", 2)))
    mobility = mobility_of(doubled)
    assert mobility.loose_bodies or not mobility.crank_turns
    assert {"gears.pair", "gears.wrong"} <= {*mobility.overconstraining}
    with pytest.raises(InputError, match="hold second_crank more than once and do not agree"):
        require_turning(doubled)
