"""Forces for which no step has a solution, and what a run says of them."""

import itertools
import random

import exudyn as exu
import exudyn.utilities as items
import numpy as np
import pytest

from exu_press import InputError, SolverStatus, solve_dynamic
from exudyn_examples.other import mass_1d

STIFFNESS, FRICTION = 1e3, 10.0  # N/m, N
CALLS = itertools.count()


def run(mbs, end, tolerance, most):
    """Return how a run to an end (s) with so many steps at most went."""
    settings = exu.SimulationSettings()
    settings.timeIntegration.endTime, settings.solution.file.write = end, False
    settings.timeIntegration.numberOfSteps = 200
    return solve_dynamic(mbs, settings, tolerance=tolerance, max_steps=most)


def on_a_spring(force, tolerance=1e-3):
    """Run a kilogram on a spring, 0.1 m off, with a force (time, speed) of the user's own."""
    mbs = exu.SystemContainer().AddSystem()
    ends = mass_1d(mbs, 1.0, place=0.1)

    def spring(mbs, t, number, u, v, k, d, offset):
        return STIFFNESS * u + force(t, v)

    mbs.AddObject(
        items.ObjectConnectorCoordinateSpringDamper(
            markerNumbers=ends, springForceUserFunction=spring
        )
    )
    mbs.Assemble()
    return run(mbs, 1.0, tolerance, 2000)


@pytest.mark.parametrize("tolerance", [1e-2, 1e-3, 1e-4])
def test_friction_that_jumps_is_named_where_it_sticks(tolerance):
    """No speed balances it there: Newton's method fails in steps of any size."""
    with pytest.warns(UserWarning, match=r"force on node0 jumps .* sign\(v\)"):
        outcome = on_a_spring(lambda t, v: FRICTION * np.sign(v), tolerance)
    assert outcome.status == SolverStatus.NOT_CONVERGED
    assert outcome.end_time == pytest.approx(5.0 * np.pi / STIFFNESS**0.5, abs=1e-3)  # half swings
    assert "smaller tolerance" not in outcome.reason


def test_it_is_named_where_it_sticks_at_once():
    with pytest.warns(UserWarning, match="jumps"):
        outcome = on_a_spring(lambda t, v: 200.0 * np.sign(v))
    assert outcome.status == SolverStatus.NOT_CONVERGED
    assert outcome.end_time == 0.0


@pytest.mark.parametrize("tolerance", [1e-2, 1e-3, 1e-4])
def test_it_is_named_where_steps_are_used_up_on_it(tolerance):
    """Newton's method converges now and then in a joint in space, as rounding has it."""
    mbs = exu.SystemContainer().AddSystem()
    ground = mbs.CreateGround()
    rod = mbs.CreateRigidBody(
        inertia=items.InertiaCuboid(1000.0, [0.3, 0.05, 0.08]),
        referencePosition=[0.15, 0.0, 0.0],
        gravity=[0.0, -9.81, 0.0],
    )
    hinge = {"bodyNumbers": [ground, rod], "position": [0.0] * 3, "axis": [0.0, 0.0, 1.0]}
    mbs.CreateRevoluteJoint(**hinge, useGlobalFrame=True)
    mbs.CreateTorsionalSpringDamper(
        **hinge, springTorqueUserFunction=lambda mbs, t, i, angle, w, k, d, offset: np.sign(w)
    )
    mbs.Assemble()
    with pytest.warns(UserWarning, match=r"used up .* force on node0 jumps"):
        outcome = run(mbs, 2.0, tolerance, 1500)
    assert outcome.end_time == pytest.approx(0.547, abs=0.005)  # it sticks


@pytest.mark.parametrize("zone", [1e-2, 1e-6])
def test_the_cure_that_is_named_helps(zone):
    outcome = on_a_spring(lambda t, v: FRICTION * np.tanh(v / zone))
    assert outcome.status == SolverStatus.COMPLETED


@pytest.mark.parametrize(
    "force",
    [lambda t, v: random.Random().random(), lambda t, v: next(CALLS)],
    ids=["random", "counts"],
)
def test_a_force_that_differs_in_the_same_state_is_refused(force):
    with pytest.raises(InputError, match=r"force on node0 is another one .*pre-step function"):
        on_a_spring(force)


@pytest.mark.parametrize("tolerance", [1e-2, 1e-4])
def test_one_that_differs_later_is_named(tolerance):
    numbers = random.Random(0)
    with pytest.warns(UserWarning, match="force on node0 is another one"):
        outcome = on_a_spring(lambda t, v: 5.0 * (t > 0.1) * numbers.random(), tolerance)
    assert outcome.status != SolverStatus.COMPLETED
