"""Closed forms of the linkages with slides between moving bodies, as they are shipped."""

from dataclasses import replace

import numpy as np
import pytest
from refused import refused

from exu_press import Scene, simulate
from exu_press.mechanism import Output, shipped_mechanism
from exu_press.mechanism.examine import examine
from exu_press.quantities import quantities_of

ANGLE = np.radians(np.arange(0.0, 360.0, 7.0))
UP = 0.5 * np.pi


def swung(crank, shaft):
    """Angle of an arm on a pivot in the origin, on which a crank's pin slides."""
    pin = shaft * 1j + crank * np.exp(1j * (ANGLE + UP))
    return np.unwrap(np.angle(pin))


def ram_of(end, length, height, side):
    """Place of a ram at a height on a rod from an end."""
    return end.real + side * np.sqrt(length**2 - (end.imag - height) ** 2)


def whitworth():
    arm = swung(0.12, 0.05)
    return ram_of(-0.1 * np.exp(1j * arm), np.hypot(0.34, 0.1), 0.0, 1.0)


def crank_shaper():
    arm = swung(0.1, 0.4)
    return ram_of(0.75 * np.exp(1j * arm), np.hypot(0.2, 0.04), 0.71, -1.0)


def oscillating_cylinder():
    pin = 0.06j * np.exp(1j * ANGLE)
    along = pin + 0.3j
    return (pin - 0.16 * along / abs(along)).imag


def inverted_slider_crank():
    pin = 0.05j * np.exp(1j * ANGLE) - complex(0.03, -0.15)
    on_arm = -0.03 + 1j * np.sqrt(abs(pin) ** 2 - 0.03**2)
    return np.angle(pin / on_arm)


def oldham():
    return 0.01 * np.sin(2.0 * ANGLE)


LINKAGES = [whitworth, crank_shaper, oscillating_cylinder, inverted_slider_crank, oldham]


@pytest.mark.parametrize("form", LINKAGES)
def test_slides_between_moving_bodies_follow_their_closed_forms(form):
    mechanism = shipped_mechanism(form.__name__)
    position = mechanism.ideal_slider(ANGLE, 1.0)[0]
    stroke = examine(mechanism).stroke.length
    assert position == pytest.approx(form(), abs=1e-9 * stroke)


@pytest.mark.parametrize("name", ["whitworth", "crank_shaper"])
def test_forces_of_slides_keep_momentum_and_energy(name):
    result = simulate(Scene(mechanism=name, revolutions=0.5, gravity=0.0))
    shaking = result["shaking_force"]
    assert result["frame_force"] == pytest.approx(shaking, abs=1e-5 * np.abs(shaking).max())
    assert result.quantity("energy.residual").value < 1e-3


def test_an_arm_gives_the_transmission_angle_of_its_block():
    """90 deg where the slide points to the pivot: the block presses square to the arm."""
    angles = examine(shipped_mechanism("whitworth")).transmission["block"]
    assert np.degrees(angles) == pytest.approx(90.0, abs=1e-4)


def test_an_output_that_turns_around_has_no_dead_centres():
    drawn = replace(shipped_mechanism("oldham"), output=Output("driven_hub", rotation=True))
    assert drawn.ideal_slider(ANGLE, 1.0)[0] == pytest.approx(ANGLE, abs=1e-12)
    assert not examine(drawn).stroke.dead_centres
    assert "swing" not in quantities_of(Scene(mechanism=drawn))


def test_an_output_that_rotates_has_the_figures_of_a_rotation():
    result = simulate(Scene(mechanism="inverted_slider_crank", revolutions=1.0))
    swing = result.quantity("swing")
    examined = examine(shipped_mechanism("inverted_slider_crank"))
    assert (swing.value, swing.unit) == (pytest.approx(examined.stroke.length, rel=1e-6), "rad")
    assert result.units["slider_acceleration"] == "rad/s^2"
    assert "stroke" not in result.summary()["quantities"]
    assert [centre.top for centre in examined.stroke.dead_centres] == [True, False]


def test_a_rotation_has_no_height_for_a_load():
    spring = {"kind": "spring", "height": 0.01, "travel": [0.0, 0.1], "force": [0.0, 1.0]}
    message = refused(Scene, mechanism="inverted_slider_crank", load={"cushion": spring})
    assert message.startswith("load.cushion: acts over the output's height")


def test_a_body_that_a_guide_holds_upright_does_not_rotate():
    drawn = shipped_mechanism("whitworth")
    message = refused(replace, drawn, output=Output("ram", rotation=True))
    assert message.startswith("output.rotation = true: guides.ram holds the angle of ram")
