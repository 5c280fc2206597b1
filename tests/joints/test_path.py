"""What a step misses of a journal's way, and what of it is taken out of a penetration."""

import math

import pytest

from exu_press.joints.path import SMALL_DRIFT, Path

STEP = 1e-3
FOR_EVER = math.inf


def cubic(time):
    """Place and velocity of a motion that the corrected trapezoidal rule integrates exactly."""
    place = 1.0 + 2.0 * time - 3.0 * time**2 + 4.0 * time**3, 0.5 * time**3
    return place, (2.0 - 6.0 * time + 12.0 * time**2, 1.5 * time**2)


def path_of(motion, steps):
    path = Path()
    for i in range(steps):
        path.go_on(*motion(i * STEP), STEP, depth=0.0, memory=FOR_EVER)
    return path


def test_a_way_of_third_degree_is_followed_exactly():
    path = path_of(cubic, 3)
    assert path.quadrature_error(*cubic(3 * STEP), STEP) == pytest.approx((0.0, 0.0), abs=1e-14)


def test_the_trapezoidal_rule_drifts_on_a_circle_and_the_drift_is_taken_out():
    """A journal that swings along its bearing: its distance drifts by h^3 v a / 4 a step."""
    radius, speed, rate = 1e-4, 0.05, 40.0

    def swinging(distance, time):
        angle = (speed * time + 0.5 * rate * time**2) / radius
        along = speed + rate * time
        place = distance * math.cos(angle), distance * math.sin(angle)
        return place, (-along * math.sin(angle), along * math.cos(angle))

    step, path, distance, drifted = 2e-5, Path(), radius, 0.0
    for i in range(40):
        time = i * step
        if i > 2:  # as Newmark's positions do
            drifted -= 0.25 * step**3 * (speed + rate * (time - 0.5 * step)) * rate / radius
        path.go_on(*swinging(distance + drifted, time), step, depth=1e-5, memory=FOR_EVER)
    assert path.drift == pytest.approx(drifted, rel=0.05)


def test_drift_ends_with_the_contact_and_is_not_believed_where_steps_are_coarse():
    path = path_of(lambda time: ((1.0, 0.0), (0.0, 0.0)), 3)
    path.go_on((1.0 + 1e-6, 0.0), (0.0, 0.0), STEP, 1e-4, FOR_EVER)
    assert path.drift == pytest.approx(1e-6)
    path.go_on((1.0 + 1e-6 + 2.0 * SMALL_DRIFT * 1e-4, 0.0), (0.0, 0.0), STEP, 1e-4, FOR_EVER)
    assert path.drift == pytest.approx(1e-6)
    path.go_on((1.0, 0.0), (0.0, 0.0), STEP, -1e-6, FOR_EVER)
    assert path.drift == 0.0


def test_drift_fades_with_the_memory_of_the_contact_not_with_steps():
    """Else finer steps forget it sooner: a press's peak was further off at 1e-5 than at 1e-4."""
    drifts = []
    for count in (10, 1000):
        path = path_of(lambda time: ((1.0, 0.0), (0.0, 0.0)), 3)
        path.go_on((1.0 + 1e-6, 0.0), (0.0, 0.0), STEP, 1e-4, FOR_EVER)
        for _ in range(count):
            path.go_on((1.0 + 1e-6, 0.0), (0.0, 0.0), 0.05 / count, 1e-4, memory=0.1)
        drifts.append(path.drift)
    assert drifts == pytest.approx([1e-6 * math.exp(-0.5)] * 2)
