"""Local error of eccentricities and penetrations."""

import math
from types import SimpleNamespace

import pytest
from patched import PATCHED

from exu_press.integrate.criteria.eccentricity import EccentricityError
from exu_press.integrate.task import SolverTuning
from exu_press.joints.path import Path

pytestmark = PATCHED

CLEARANCE, ALLOWED = 1e-4, 1e-5
TUNING = SolverTuning(kept_steps=1.0)
IN_FILM = {"position": (5e-5, 0.0), "usual": 0.1}


def error_of(missed, position, *, contact_onset=CLEARANCE, usual=1.0, step=1e-4, roundoff=0.0):
    """The error of a step in which a joint at rest moves by `missed`."""
    path = Path()
    path.go_on(position, (0.0, 0.0), step, depth=0.0, memory=0.0)
    joint = SimpleNamespace(
        clearance=CLEARANCE,
        contact_onset=contact_onset,
        path=path,
        eccentricity=tuple(p + m for p, m in zip(position, missed, strict=True)),
        relative_velocity=(0.0, 0.0),
    )
    scales = SimpleNamespace(roundoff=1e-14)
    task = SimpleNamespace(tuning=TUNING, scales=scales, tolerance=1e-3, usual=usual)
    of_constraints = SimpleNamespace(roundoff_of_constraints=lambda: roundoff)
    return EccentricityError(task, joint, of_constraints, ALLOWED, TUNING.penetration).error(step)


def test_a_penetration_counts_against_itself():
    deep = (CLEARANCE + 5e-6, 0.0)
    across = error_of((1e-10, 0.0), deep)
    assert across == pytest.approx(0.1 / (TUNING.penetration * 0.05), rel=1e-3)
    assert error_of((0.0, 1e-10), deep) == pytest.approx(0.1)
    assert error_of((1e-10, 0.0), (5e-5, 0.0)) == pytest.approx(0.1)


def test_in_a_film_alone_errors_count_over_time():
    """1e-3 of the clearance in 0.1 s: 1e-6 m/s."""
    assert error_of((1e-10, 0.0), contact_onset=math.inf, **IN_FILM) == pytest.approx(1.0)
    assert error_of((1e-10, 0.0), **IN_FILM) == pytest.approx(0.1)


def test_what_rounded_constraints_move_is_no_error():
    far = (1e-8, 0.0)
    assert error_of(far, (5e-5, 0.0)) == pytest.approx(10.0)
    assert error_of(far, (5e-5, 0.0), roundoff=1e-7) == pytest.approx(0.1)
