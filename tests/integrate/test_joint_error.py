"""Penetrations are resolved against themselves, and what a film keeps does not add up."""

import math
from types import SimpleNamespace

import numpy as np
import pytest

from exu_press import Scene, Tuning, simulate
from exu_press.integrate.joint_error import JointError
from exu_press.joints.path import Path

CLEARANCE, LIMIT = 1e-4, 1e-9


def error_of(missed, *, place, reach=CLEARANCE, drift=math.inf, step=1e-4):
    """The error of a step in which a joint at rest is found `missed` away from its place."""
    path = Path()
    path.go_on(place, (0.0, 0.0), step, depth=0.0)
    there = tuple(p + m for p, m in zip(place, missed, strict=True))
    joint = SimpleNamespace(
        clearance=CLEARANCE,
        reach=reach,
        path=path,
        eccentricity=there,
        relative_velocity=(0.0, 0.0),
    )
    return JointError(joint, LIMIT, drift, 1e-14, Tuning()).error(step)


def test_a_penetration_counts_against_itself():
    deep = (CLEARANCE + 5e-6, 0.0)
    across = error_of((1e-10, 0.0), place=deep)
    assert across == pytest.approx(0.1 / (Tuning().penetration * 0.05), rel=1e-3)
    assert error_of((0.0, 1e-10), place=deep) == pytest.approx(0.1)
    assert error_of((1e-10, 0.0), place=(5e-5, 0.0)) == pytest.approx(0.1)


def test_in_a_film_alone_errors_count_over_time():
    in_film = {"place": (5e-5, 0.0), "drift": 1e-6}
    assert error_of((1e-10, 0.0), reach=math.inf, **in_film) == pytest.approx(1.0)
    assert error_of((1e-10, 0.0), **in_film) == pytest.approx(0.1)


def test_thin_films_follow_the_tolerance():
    """Errors of 0.1 and 0.01 at 1e-2 and 1e-3 while each step had its share of the clearance."""
    ratios = {}
    for tolerance in (1e-2, 1e-3, 1e-4):
        thin = {"crank_pin": {"kind": "lubricated", "clearance": 1e-5}}
        given = {"mechanism": "slider_crank", "joints": thin, "revolutions": 1.0}
        scene = Scene(solver={"tolerance": tolerance}, **given)
        run = simulate(scene)
        ratios[tolerance] = np.linalg.norm(run["crank_pin_eccentricity"], axis=1).max() / 1e-5
    for tolerance in (1e-2, 1e-3):
        assert abs(ratios[tolerance] - ratios[1e-4]) < 2.0 * tolerance
