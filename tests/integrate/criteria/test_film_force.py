"""Interpolation error of a film's force while it turns, and what that costs."""

import math
from types import SimpleNamespace

import pytest
from patched import PATCHED

from exu_press.integrate.criteria.film_force import FilmForceError
from exu_press.integrate.task import SolverTuning

pytestmark = PATCHED

TOLERANCE = 1e-3
SMALLEST = 1e-8
TASK = SimpleNamespace(tolerance=TOLERANCE, shortest_first=10.0 * SMALLEST, tuning=SolverTuning())


def error_of(before, after, step=1e-4):
    joint = SimpleNamespace(force=before)
    film = FilmForceError(TASK, joint)
    assert film.error(step) == 0.0  # nothing is known before the first step
    film.accept_step()
    joint.force = after
    return film.error(step)


def test_a_force_that_turns_bulges_beside_the_line():
    angle = 0.02
    error = error_of((500.0, 0.0), (500.0 * math.cos(angle), 500.0 * math.sin(angle)))
    assert error == pytest.approx((angle**2 / 8.0 / TOLERANCE) ** 1.5, rel=1e-4)


@pytest.mark.parametrize(
    ("before", "after"),
    [
        ((0.0, 0.0), (900.0, 0.0)),  # an impact
        ((300.0, 400.0), (600.0, 800.0)),  # a load that grows
        ((300.0, 400.0), (0.0, 0.0)),
    ],
)
def test_a_force_that_keeps_its_direction_is_followed(before, after):
    assert error_of(before, after) == pytest.approx(0.0, abs=1e-9)


def test_a_force_is_held_against_the_largest_so_far():
    joint = SimpleNamespace(force=(1e6, 0.0))
    film = FilmForceError(TASK, joint)
    film.error(1e-4)
    film.accept_step()
    joint.force = (0.0, 300.0)
    film.error(1e-4)
    film.accept_step()
    joint.force = (0.0, -300.0)
    assert film.error(1e-4) == pytest.approx(0.15**1.5)


def test_steps_that_rounding_turns_forces_in_are_taken():
    assert error_of((500.0, 0.0), (-500.0, 0.0)) > 1.0
    assert error_of((500.0, 0.0), (-500.0, 0.0), step=5.0 * SMALLEST) == 0.0


def test_a_force_that_rings_from_step_to_step_is_taken():
    joint = SimpleNamespace(force=(500.0, 0.0))
    film = FilmForceError(TASK, joint)
    for force in ((-400.0, 10.0), (390.0, 0.0), (-380.0, 5.0)):
        film.error(1e-4)
        film.accept_step()
        joint.force = force
    assert film.error(1e-4) == 0.0
