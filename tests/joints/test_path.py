"""What a step misses of a journal's way, and what of it is taken out of a penetration."""

import itertools
import math

import numpy as np
import pytest

from exu_press.joints.path import SMALL_DRIFT, Path

STEP = 1e-3
FOR_EVER = math.inf
FAR = 1e3


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


def amplification(turned, ratio, radius, memory):
    """Largest factor by which a vibration in contact grows in a step with its correction.

    Generalized-alpha with (q, v, a, q_tt, drift, last change of v) after a step of size 1, of
    q_tt = -omega^2 (q - drift) - 2 ratio omega v.

    Args:
        turned: omega times the step.
        ratio: of the damping, to the critical one.
        radius: spectral radius at infinity.
        memory: of the contact that the correction is given, over the step.
    """
    alpha_m, alpha_f = (2.0 * radius - 1.0) / (radius + 1.0), radius / (radius + 1.0)
    gamma = 0.5 - alpha_m + alpha_f
    beta = 0.25 * (1.0 - alpha_m + alpha_f) ** 2
    stiffness, damping = turned**2, 2.0 * ratio * turned
    columns = []
    for q, v, a, pushed, drift, before in np.eye(6):
        ahead, faster = q + v + (0.5 - beta) * a, v + (1.0 - gamma) * a
        force = -stiffness * (ahead - drift) - damping * faster
        right = (1.0 - alpha_f) * force + alpha_f * pushed - alpha_m * a
        give = beta * stiffness + gamma * damping
        a_1 = right / (1.0 - alpha_m + (1.0 - alpha_f) * give)
        q_1, v_1 = ahead + beta * a_1, faster + gamma * a_1
        path = Path()
        path.eccentricity, path.velocity, path.acceleration = (FAR + q,), (v,), (before,)
        path.drift = drift
        path.go_on((FAR + q_1,), (v_1,), 1.0, 1e9, memory)
        pushed = -stiffness * (q_1 - drift) - damping * v_1
        columns.append([q_1, v_1, a_1, pushed, path.drift, v_1 - v])
    return np.abs(np.linalg.eigvals(np.transpose(columns))).max()


def test_no_step_amplifies_a_vibration_in_contact():
    """A watch's four-bar: its shaft, pressed by 0.1 nN, was shaken up to 2 nN by the correction."""
    for turned, ratio, radius in itertools.product(
        (0.1, 0.5, 1.0, 2.0, 4.0, 20.0), (1e-4, 1e-2, 0.1, 1.0, 10.0), (0.5, 0.8, 0.95)
    ):
        assert amplification(turned, ratio, radius, 2.0 * ratio / turned) <= 1.0 + 1e-9
