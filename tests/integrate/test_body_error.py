"""What a step misses, told from the accelerations at three instants."""

import math

import pytest

from exu_press.integrate.body_error import BodyError
from exu_press.integrate.scales import FoundScales, Scales
from exu_press.integrate.share import Share
from exu_press.integrate.tuning import Tuning

TUNING = Tuning()
RADIUS = 0.8


def errors(velocity_limit=1e-3, masses=(2.0,)):
    """Errors of bodies that rest at first; each of one mass and a moment of inertia of 0.5."""
    scales = FoundScales(Scales(speed=1.0, force=1.0), length=1.0)
    rest = [0.0] * 3 * len(masses)
    scales.begin(
        starts=[3 * i for i in range(len(masses))],
        inertias=[value for mass in masses for value in (mass, mass, 0.5)],
        masses=list(masses),
        velocities=rest,
        accelerations=rest,
        places=rest,
        longest=1.0,
        widest=0.0,
    )
    return BodyError(
        rest,
        share=Share(velocity_limit),
        scales=scales,
        tuning=TUNING,
        spectral_radius=RADIUS,
    )


def test_accelerations_that_change_at_one_rate_are_followed_exactly():
    error = errors()
    error.tried([1.0, 2.0, 3.0], 0.1)
    error.accept()
    assert error.tried([2.0, 4.0, 6.0], 0.1) == 0.0


def test_velocities_are_off_by_the_cube_of_the_step():
    """a = b t^2: its second derivative is 2 b."""
    b, h = 3.0, 0.01
    error = errors()
    error.tried([1e6, 0.0, 0.0], h)
    error.accept()
    error.tried([0.0, 0.0, 0.0], h)
    error.accept()
    error.tried([0.0, b * h * h, 0.0], h)
    error.accept()
    value = error.tried([0.0, 4.0 * b * h * h, 0.0], h)
    assert value == pytest.approx(h**3 * 2.0 * b / 6.0 / 1e-3)


def test_rotations_count_by_their_energy():
    """An angular acceleration counts sqrt(J/m) of it."""
    turning, moving = errors(), errors()
    value = turning.tried([0.0, 0.0, 4.0], 0.01)
    assert value == pytest.approx(moving.tried([4.0 * math.sqrt(0.5 / 2.0), 0.0, 0.0], 0.01))


def test_what_has_no_say_and_what_rounding_makes():
    assert errors(masses=(math.inf,)).tried([1e3, 1e3, 0.0], 0.01) == 0.0
    step = 1e-8
    rounding = 0.99 * TUNING.rounding / (1.0 - RADIUS) ** 2 / step**2
    assert errors(velocity_limit=1e-30).tried([rounding, 0.0, 0.0], step) < 1.0


def test_jumps_are_told_by_body():
    error = errors(masses=(2.0, 8.0))
    error.tried([3.0, 4.0, 0.0, 0.0, 0.0, 4.0], 0.01)
    assert error.of_jump() == pytest.approx(5.0)
