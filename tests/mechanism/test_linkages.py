"""Closed forms of the linkages with slides between moving bodies, as they are shipped."""

import numpy as np
import pytest

from exu_press import Scene, simulate
from exu_press.mechanism import shipped_mechanism
from exu_press.mechanism.examine import examine

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


def oldham():
    return 0.01 * np.sin(2.0 * ANGLE)


@pytest.mark.parametrize("form", [whitworth, crank_shaper, oscillating_cylinder, oldham])
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
