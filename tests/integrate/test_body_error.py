"""What a step misses, told from the accelerations at three instants."""

import math

import pytest

from exu_press.integrate.body_error import BodyError
from exu_press.integrate.scales import FoundScales, Scales
from exu_press.integrate.share import Share
from exu_press.integrate.stepping import ORDER
from exu_press.integrate.tuning import Tuning

TUNING = Tuning()
RADIUS = 0.8


def errors(velocity_limit=1e-3, tolerance=1e-2, masses=(2.0,)):
    """Errors of bodies that rest at first; each of one mass and a moment of inertia of 0.5."""
    scales = FoundScales(Scales(speed=1.0, acceleration=1.0, force=1.0), length=1.0)
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
        tolerance=tolerance,
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
    """a = b t^2: its second derivative is 2 b; a body much faster before has no peak to miss."""
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


def test_a_peak_of_its_own_makes_steps_finer_up_to_a_limit():
    """Half a sine of 100 m/s^2: a step may miss a hundredth of it where velocities allow more."""
    loose, strict = errors(velocity_limit=1e3), errors(velocity_limit=1e3, tolerance=1e-9)
    h, duration = 1e-5, 1e-4
    for i in range(1, 6):
        now = [100.0 * math.sin(math.pi * i * h / duration), 0.0, 0.0]
        value, limited = loose.tried(now, h), strict.tried(now, h)
        loose.accept()
        strict.accept()
    curvature = 100.0 * (math.pi / duration) ** 2
    velocity = h**3 * curvature / 6.0 / 1e3
    assert limited == pytest.approx(TUNING.finer_for_peaks**3 * velocity, rel=0.1)
    expected = min(
        (h**2 * curvature / 8.0 / (1e-2 * 100.0)) ** 1.5, TUNING.finer_for_peaks**3 * velocity
    )
    assert value == pytest.approx(expected, rel=0.1)


def test_a_peak_is_met_however_loose_the_tolerance():
    """Where velocities ask for no finer step, and would let it be as fine as peaks need it."""
    loose, strict = (errors(velocity_limit=1.0, tolerance=t) for t in (0.1, TUNING.loosest_peak))
    assert loose.tried([1e3, 0.0, 0.0], 0.01) == strict.tried([1e3, 0.0, 0.0], 0.01)


@pytest.mark.parametrize(
    ("share", "counts"), [(1.1 * TUNING.near_peak, True), (0.9 * TUNING.near_peak, False)]
)
def test_only_near_a_peak_is_it_looked_for(share, counts):
    """The error is what the peak may be off by, or that of the velocity alone."""
    error = errors(velocity_limit=1e-3)
    for acceleration in (1.0, 0.0):
        error.tried([acceleration, 0.0, 0.0], 1e-3)
        error.accept()
    value = error.tried([share, 0.0, 0.0], 1e-3)
    of_velocity = 1e-3 * (share + 1.0) / 6.0 / 1e-3  # the rate changed by (share + 1) / h
    assert (value > 2.0 * of_velocity) == counts


def test_what_has_no_say_and_what_rounding_makes():
    assert errors(masses=(math.inf,)).tried([1e3, 1e3, 0.0], 0.01) == 0.0
    step = 1e-8
    rounding = 0.99 * TUNING.rounding / (1.0 - RADIUS) ** 2 / step**2
    assert errors(velocity_limit=1e-30, tolerance=1e-30).tried([rounding, 0.0, 0.0], step) < 1.0


def test_rounding_that_alternates_lets_steps_grow():
    """Steps after a film's start stood still at 0.13 us, where it was taken for an error."""
    step = 1e-7
    error = errors(velocity_limit=1e-5, tolerance=1e-3)
    for sign in (1.0, -1.0, 1.0):
        value = error.tried([17.8 + sign * 1e-14 / step**2, 0.0, 0.0], step)
        error.accept()
    assert 0.0 < value < TUNING.safety / TUNING.factor_max**ORDER


def test_jumps_are_told_by_body():
    error = errors(masses=(2.0, 8.0))
    error.tried([3.0, 4.0, 0.0, 0.0, 0.0, 4.0], 0.01)
    assert error.of_jump() == pytest.approx(5.0)
