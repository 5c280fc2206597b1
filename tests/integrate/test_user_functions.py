"""Exudyn's calls reach the user's own functions, whose word counts; what is not followed is said.

Events, at which such functions act, are located.
"""

import exudyn as exu
import exudyn.utilities as items
import numpy as np
import pytest
from stand_in_system import mass_on_spring, pendulum, settings

from exu_press import InputError
from exu_press.integrate import SolverStatus, solve_dynamic

PERIOD = 0.02


def velocity(mbs):
    return mbs.systemData.GetODE2Coordinates_t()[0]


def free_mass(before_step=None, force=0.0):
    """A kilogram with a load, which a pre-step function may set."""
    mbs = exu.SystemContainer().AddSystem()
    node = mbs.AddNode(items.Node1D(referenceCoordinates=[0.0]))
    mbs.AddObject(items.ObjectMass1D(nodeNumber=node, mass=1.0))
    at = mbs.AddMarker(items.MarkerNodeCoordinate(nodeNumber=node, coordinate=0))
    load = mbs.AddLoad(items.LoadCoordinate(markerNumber=at, load=force))
    if before_step is not None:
        mbs.SetPreStepUserFunction(before_step(load))
    mbs.Assemble()
    return mbs


def test_all_of_the_users_functions_are_called_and_stay():
    mbs, calls = pendulum("dry", speed=1.0), {"step": 0, "residual": 0, "newton": 0, "end": 0}

    def called(name, answer):
        def function(mbs, *state):
            calls[name] += 1
            return answer

        return function

    mbs.SetPreStepUserFunction(called("step", True))
    mbs.SetPreNewtonResidualUserFunction(called("residual", None))
    mbs.SetPostNewtonUserFunction(called("newton", [0.0, -1.0]))
    mbs.SetPostStepUserFunction(called("end", True))
    functions = mbs.GetPreStepUserFunction(), mbs.GetPostNewtonUserFunction()
    with pytest.warns(UserWarning, match="what the pre-step function sets"):
        outcome = solve_dynamic(mbs, settings(0.1))
    tries = outcome.steps + outcome.rejected_steps
    assert calls["newton"] == calls["step"] == tries
    assert calls["residual"] >= outcome.newton_iterations
    assert calls["end"] == outcome.steps + 1  # at the start too, as Exudyn does
    assert (mbs.GetPreStepUserFunction(), mbs.GetPostNewtonUserFunction()) == functions


def test_a_step_that_the_user_wants_shorter_is_repeated():
    mbs, tried = pendulum("dry", speed=1.0), []

    def at_most(mbs, time):
        step = time - mbs.systemData.GetTime(exu.ConfigurationType.StartOfStep)
        tried.append(step)
        return [2.0, 1e-4] if step > 1.01e-4 else [0.0, -1.0]

    mbs.SetPostNewtonUserFunction(at_most)
    outcome = solve_dynamic(mbs, settings(0.02))
    assert outcome.status is SolverStatus.COMPLETED
    assert outcome.rejected_steps >= sum(step > 1.01e-4 for step in tried) > 0
    assert outcome.steps >= 200


def test_a_function_that_asks_to_stop_before_a_step_ends_the_run():
    mbs = mass_on_spring()
    mbs.SetPreStepUserFunction(lambda mbs, time: time < 0.05)
    with pytest.warns(UserWarning, match="pre-step"):
        outcome = solve_dynamic(mbs, settings(0.1))
    assert outcome.status is SolverStatus.INTERRUPTED
    assert outcome.reason.startswith("stopped by a user function at t = 0.0")


@pytest.mark.filterwarnings("error::UserWarning")
def test_a_controller_is_sampled_on_its_grid_and_its_output_is_held():
    """v' = 1 - K v(t_k): v_k+1 = v_k + T (1 - K v_k)."""
    called = []

    def controller(load):
        def control(mbs, time):
            called.append(time)
            mbs.SetLoadParameter(load, "load", 1.0 - 20.0 * velocity(mbs))
            return True

        return control

    mbs = free_mass(controller)
    chosen = settings(10.207, 20, startTime=10.007)
    outcome = solve_dynamic(mbs, chosen, tolerance=1e-4, sample=PERIOD)
    assert outcome.status is SolverStatus.COMPLETED, outcome.reason
    assert called == pytest.approx(10.007 + PERIOD * np.arange(1, 11))
    expected = 0.0
    for _ in called:
        expected += PERIOD * (1.0 - 20.0 * expected)
    assert velocity(mbs) == pytest.approx(expected, rel=1e-5)


def test_velocities_that_a_pre_step_function_sets_stay_where_its_step_is_repeated():
    """A speed of 1 and -1 m/s on a grid, with a spring: its jumps repeat steps."""
    mbs = mass_on_spring(frequency=1e1, position=0.0)

    def switch(mbs, time):
        mbs.systemData.SetODE2Coordinates_t([1.0 if round(time / PERIOD) % 2 else -1.0])
        return True

    mbs.SetPreStepUserFunction(switch)
    chosen = settings(7 * PERIOD, 1)
    outcome = solve_dynamic(mbs, chosen, tolerance=1e-4, sample=PERIOD)
    assert outcome.status is SolverStatus.COMPLETED, outcome.reason
    x, v, omega = 0.0, 0.0, 10.0
    c, s = np.cos(omega * PERIOD), np.sin(omega * PERIOD)
    for number in range(7):
        v = -1.0 if number % 2 else 1.0
        x, v = x * c + v / omega * s, v * c - x * omega * s
    assert velocity(mbs) == pytest.approx(v, abs=2e-2)


def test_velocities_that_a_post_step_function_sets_are_a_new_start():
    """A mass that a load pushes is stopped at an event; it goes on from rest."""
    mbs, stopped = free_mass(force=1.0), []

    def stop(mbs, time):
        if not stopped and mbs.systemData.GetODE2Coordinates()[0] >= 0.1:
            stopped.append(time)
            mbs.systemData.SetODE2Coordinates_t([0.0])
        return True

    mbs.SetPostStepUserFunction(stop)
    outcome = solve_dynamic(
        mbs,
        settings(),
        tolerance=1e-4,
        event=lambda mbs, time: mbs.systemData.GetODE2Coordinates()[0] - 0.1,
    )
    assert outcome.status is SolverStatus.COMPLETED, outcome.reason
    assert stopped == [pytest.approx(np.sqrt(0.2), abs=1e-6)]
    assert velocity(mbs) == pytest.approx(1.0 - np.sqrt(0.2), abs=2e-4)


def test_events_restart_nothing():
    """A mass on a spring passes its middle six times a second; restarts took 50 steps each."""
    plain = solve_dynamic(mass_on_spring(), settings()).check()
    passed = []

    def place(mbs, time):
        passed.append(time)
        return mbs.systemData.GetODE2Coordinates()[0]

    mbs = mass_on_spring()
    outcome = solve_dynamic(mbs, settings(), event=place).check()
    assert outcome.steps < plain.steps + 6 * 15
    zeros = (np.arange(6) + 0.5) * np.pi / 20.0
    assert all(np.abs(np.array(passed) - zero).min() < 1e-3 for zero in zeros)
    assert velocity(mbs) == pytest.approx(-20.0 * np.sin(20.0), abs=0.1)


@pytest.mark.parametrize("bearing", ["dry", "lubricated"])
def test_a_slow_pendulum_in_its_bearing_follows_a_torque_that_jumps(bearing):
    """By less than a tenth of a radian; nor is the jump an impact that steps do not resolve."""
    torque, jumps_at, inertia = 1e2, 0.1, 10.0 / 12.0 + 10.0 * 0.25
    mbs = pendulum(bearing, lambda mbs, time, load: torque if time >= jumps_at else 0.0, speed=1e-4)
    time = np.sqrt(0.2 * inertia / torque)
    outcome = solve_dynamic(mbs, settings(jumps_at + time))
    assert outcome.status is SolverStatus.COMPLETED, outcome.reason
    speed = mbs.systemData.GetODE2Coordinates_t()[2]
    assert speed == pytest.approx(torque / inertia * time, rel=3e-2)  # less its weight


def test_what_cannot_be_sampled_is_refused():
    for period in (-1.0, 0.0):
        with pytest.raises(InputError, match=f"sample = {period}"):
            solve_dynamic(free_mass(), settings(), sample=period)
    with pytest.raises(InputError, match="event: allowed with a tolerance"):
        solve_dynamic(free_mass(), settings(), tolerance=None, event=lambda mbs, time: 1.0)
