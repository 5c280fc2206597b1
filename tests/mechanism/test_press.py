"""The press: published numbers, lengths and masses of Table 2."""

import math

import numpy as np
import pytest
from numpy.testing import assert_allclose

from exu_press import InputError, Scene
from exu_press.scene import mechanism_of

IDEAL = Scene.from_dict({"mechanism": "press", "joints": {}})
PRESS = mechanism_of(IDEAL)


def test_peak_velocities_and_bottom_dead_centre_are_the_papers():
    """0.441, 0.37 and 0.92 m/s at 240, 200 and 500 rpm; 470 mm at 180 deg, the lowest point."""
    angle = np.radians(np.arange(0.0, 360.0, 0.5))
    for speed_rpm, peak, digit in ((240.0, 0.441, 5e-4), (200.0, 0.37, 5e-3), (500.0, 0.92, 5e-3)):
        position, velocity, _ = PRESS.ideal_slider(angle, speed_rpm * math.pi / 30)
        assert np.abs(velocity).max() == pytest.approx(peak, abs=digit)
    assert position.argmin() == 360
    assert position.min() == pytest.approx(0.47, abs=1e-12)


def test_link_lengths_of_table_2():
    """Both joints of a link sit at its ends, so that closed joints mean a constant length."""
    lengths = {"linkage": 0.383, "counter_linkage": 0.275}
    for side in ("left", "right"):
        for link, length in (("link_5", 0.23), ("link_6", 0.24), ("link_7", 0.164)):
            lengths[f"{link}_{side}"] = length
    for body, length in lengths.items():
        ends = np.array(PRESS.points(body))
        assert ends[:, 1] == pytest.approx(0.0, abs=1e-15)
        assert np.abs(ends[:, 0]) == pytest.approx(length / 2, abs=1e-15)
        assert np.ptp(ends[:, 0]) == pytest.approx(length, abs=1e-15)


def test_masses_of_table_2():
    """Links per side (A-7), slide 60 kg (A-4)."""
    masses = {"crank": 217.6, "linkage": 184.5, "slide": 60.0, "slider": 1347.0}
    masses |= {"counter_linkage": 22.58, "counterweight": 1847.2}
    for side in ("left", "right"):
        masses |= {f"link_5_{side}": 22.72, f"link_6_{side}": 24.13}
        masses |= {f"link_7_{side}": 15.5, f"plunger_{side}": 155.3}
    assert {body.name: body.mass for body in PRESS.bodies} == masses


def test_links_are_uniform_rods():
    """A-6: inertia m l^2 / 12 about the middle."""
    inertia = {body.name: body.inertia for body in PRESS.bodies}
    assert inertia["linkage"] == pytest.approx(184.5 * 0.383**2 / 12)
    assert inertia["link_6_left"] == pytest.approx(24.13 * 0.24**2 / 12)


def test_links_out_of_all_proportion_are_refused():
    """Relative to their length the linkage does not move: already the drawing is singular."""
    with pytest.raises(InputError, match="no two connected links lie in one line"):
        Scene(press={"link_5_length": 23000.0})


def test_dead_centres_are_where_the_slider_stands_still_and_are_found_once():
    top, bottom = PRESS.dead_centres
    _, velocity, acceleration = PRESS.ideal_slider(np.array([top, bottom]), 1.0)
    assert_allclose(velocity, 0.0, atol=1e-9)
    assert acceleration[0] < 0.0
    assert acceleration[1] == pytest.approx(0.0, abs=1e-15)  # crank and knuckles are straight
    assert PRESS.ideal_slider(bottom + np.array([-0.01, 0.01]), 1.0)[0].min() > PRESS.bottom
    assert PRESS.dead_centres is PRESS.dead_centres
