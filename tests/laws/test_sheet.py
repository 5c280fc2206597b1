"""The sheet as a law: its curve, its unloading, its crack, and a spring that it releases."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from exu_press.laws.load_curve import LoadCurve
from exu_press.laws.sheet import PunchStroke, Sheet
from exu_press.quantities.sheet import released_work

CURVE = LoadCurve([0.0, 1e-4, 8e-4], [0.0, 8e4, 1e5])
SHEET = Sheet(CURVE, thickness=2e-3, crack_time=1e-4, stripping=1e4, fade=1e-3)


def stroke(cut, places, times):
    """Return the forces of a punch that is led along places."""
    rates = np.gradient(places, times)
    forces = []
    for state in zip(times.tolist(), places.tolist(), rates.tolist(), strict=True):
        forces.append(cut.force(*state))
        cut.accept(*state)
    return np.array(forces)


def test_the_work_up_to_fracture_is_the_area_under_the_curve():
    times = np.linspace(0.0, 1.0, 20001)
    places = -1e-4 + 3e-3 * times
    force = stroke(PunchStroke(SHEET), places, times)
    area = 0.5 * 1e-4 * 8e4 + 0.5 * 7e-4 * 1.8e5
    crack = 0.5 * 1e5 * 1e-4 * 3e-3
    assert np.trapezoid(force, places) == pytest.approx(area + crack, rel=1e-3)


def test_a_sheet_never_gives_back_more_than_its_elastic_work():
    times = np.linspace(0.0, 1.0, 20001)
    places = 3e-4 * (1.0 - np.cos(6.0 * np.pi * times)) * times
    assert places.max() < 8e-4
    force = stroke(PunchStroke(SHEET), places - 1e-12, times)
    done = np.concatenate([[0.0], np.cumsum(0.5 * (force[1:] + force[:-1]) * np.diff(places))])
    given = np.maximum.accumulate(done) - done
    assert given.max() < 1e5**2 / (2.0 * 8e8) * 1.01  # F^2 / 2k with k of the first line
    assert done[-1] > 0.0
    assert force.min() >= 0.0


def test_one_sheet_a_stroke():
    times = np.linspace(0.0, 3.0, 30001)
    places = -1e-3 * np.cos(2.0 * np.pi * times) - 1e-5
    force = stroke(PunchStroke(SHEET), places, times)
    fractures = np.flatnonzero((force[:-1] > 9e4) & (force[1:] < 9e4))
    assert len(fractures) == 3
    back = np.diff(places, append=places[-1]) < 0.0
    assert force[back & (places > 1e-4) & (places < 9e-4)].max() < 0.0  # stripping
    assert force.min() == pytest.approx(-1e4 * 0.99e-3 / 2e-3, rel=0.03)  # gripped over a half


def test_a_run_that_starts_in_the_sheet_starts_with_a_cut_one():
    cut = PunchStroke(SHEET)
    assert cut.force(0.0, 5e-4, 0.1) == 0.0
    cut.accept(0.0, 5e-4, 0.1)
    cut.accept(0.1, -1e-4, -0.1)
    assert cut.force(0.2, 5e-5, 0.1) == pytest.approx(4e4)


def test_memory_goes_on():
    cut, other = PunchStroke(SHEET), PunchStroke(SHEET)
    for state in ((0.0, -1e-4, 0.1), (0.1, 7e-4, 0.1), (0.2, 8.02e-4, 0.1)):
        cut.accept(*state)
    other.recall(cut.memory())
    assert other.force(0.20003, 8.2e-4, 0.1) == cut.force(0.20003, 8.2e-4, 0.1) > 0.0


def test_the_next_corner_is_the_fracture_and_then_the_end_of_the_crack():
    cut = PunchStroke(SHEET)
    cut.accept(0.0, -1e-4, 0.1)
    assert cut.next(0.0, -1e-4, 0.1) == pytest.approx(1e-3)
    cut.accept(0.01, 7e-4, 0.1)
    assert cut.next(0.01, 7e-4, 0.1) == pytest.approx(0.011)
    assert cut.next(0.011, 8e-4 - 1e-12, 0.1, close=1e-9) == pytest.approx(0.0111)
    cut.accept(0.011, 8e-4, 0.1)
    assert cut.next(0.01102, 8.1e-4, 0.1) == pytest.approx(0.0111)


def test_a_released_spring_gives_back_what_it_has_stored():
    """A mass on a spring, pressed down with F by a slow foundation; the crack takes no time."""
    stiffness, mass, pressed = 2e8, 400.0, 1e5
    sheet = Sheet(CURVE, 2e-3, 1e-9, 0.0, 1e-3)
    cut = PunchStroke(sheet)
    cut.accept(0.0, -1e-4, 0.1)
    cut.accept(1.0, 8e-4, 1e-9)
    start = pressed / stiffness  # above the place without force

    def motion(time, state):
        force = cut.force(1.0 + 1e-6 + time, 8e-4 + start - state[0], -state[1])
        return [state[1], (-stiffness * state[0] + force) / mass]

    period = 2.0 * np.pi * np.sqrt(mass / stiffness)
    times = np.linspace(0.0, 0.5 * period, 2001)
    found = solve_ivp(motion, (0.0, times[-1]), [start, 0.0], t_eval=times, rtol=1e-10, atol=1e-14)
    energy = released_work(times, -stiffness * found.y[0], found.y[1])
    assert energy == pytest.approx(pressed**2 / (2.0 * stiffness), rel=1e-4)
    coarse = released_work(np.arange(2.0), np.array([-2.0, 1.0]), np.full(2, -3.0))
    assert coarse == pytest.approx(3.0)  # the step within which it begins to pull counts
    assert found.y[1].min() == pytest.approx(-start * np.sqrt(stiffness / mass), rel=1e-4)
    assert -stiffness * found.y[0].min() == pytest.approx(pressed, rel=1e-4)  # all of it returns
