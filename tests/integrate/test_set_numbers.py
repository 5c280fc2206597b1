"""Numbers that a pre-step function sets go over from call to call."""

import warnings
from itertools import pairwise

import exudyn as exu
import exudyn.utilities as items
import numpy as np
import pytest

from exu_press import SolverStatus, solve_dynamic
from exudyn_examples.other import first_order

PERIOD = 0.05  # s
TABLE = [0.0, 1.0, 1.5, 1.0, -2.0, -4.0, -5.0, -5.5, -5.5, 0.0, 0.0, 0.0, 0.0, 3.0, 9.0, 18.0, 30.0]
"""Of forces, N, at multiples of the period."""

SETTERS = [f"Set{kind}Parameter" for kind in ("Object", "Load", "Node", "Marker")]


def settings(end=0.8):
    chosen = exu.SimulationSettings()
    chosen.timeIntegration.endTime, chosen.solution.file.write = end, False
    chosen.timeIntegration.numberOfSteps = round(end / PERIOD)
    return chosen


def mass():
    """A mass of a kilogram in space, and its load."""
    mbs = exu.SystemContainer().AddSystem()
    body = mbs.CreateMassPoint(mass=1.0)
    at = mbs.AddMarker(items.MarkerBodyPosition(bodyNumber=body))
    return mbs, mbs.AddLoad(items.LoadForceVector(markerNumber=at, loadVector=[0.0, 0.0, 0.0]))


def solve(mbs, before_step=0, after_step=0, end=1.0, **how):
    """Solve it with functions of the user's own."""
    mbs.SetPreStepUserFunction(before_step)
    mbs.SetPostStepUserFunction(after_step)
    mbs.Assemble()
    outcome = solve_dynamic(mbs, settings(end), **how)
    assert outcome.status is SolverStatus.COMPLETED, outcome.reason


def speed(mbs):
    return mbs.systemData.GetODE2Coordinates_t()[0]


def gained():
    """The integral over the table, by its trapezoids and bends; before, nothing pushes."""
    seconds = np.diff([0.0, 0.0, *TABLE], 2)
    bends = [min(pair, key=abs) if pair[0] * pair[1] > 0.0 else 0.0 for pair in pairwise(seconds)]
    return PERIOD * (np.trapezoid(TABLE) - sum(bends) / 12.0)


@pytest.mark.parametrize(
    "sets",
    [
        lambda mbs, load, force: mbs.SetLoadParameter(load, "loadVector", [force, 0.0, 0.0]),
        lambda mbs, load, force: mbs.SetLoadParameter(
            load, "loadVector", np.array([force, 0.0, 0.0])
        ),
        lambda mbs, load, force: mbs.SetLoadParameter(
            value=[int(2.0 * force) / 2, 0, 0], loadNumber=int(load), parameterName="loadVector"
        ),
        lambda mbs, load, force: [  # of two values in a call the second one counts
            mbs.SetLoadParameter(load, "loadVector", [value, 0.0, 0.0]) for value in (1e9, force)
        ],
        lambda mbs, load, force: (  # nothing is set where nothing changes
            mbs.GetLoadParameter(load, "loadVector")[0] == force
            or mbs.SetLoadParameter(load, "loadVector", [force, 0.0, 0.0])
        ),
    ],
)
@pytest.mark.parametrize("tolerance", [1e-3, 1e-5])
def test_a_force_is_the_table_interpolated(sets, tolerance):
    """Whichever way it is set; before each call it is what the last one has set."""
    mbs, load = mass()
    seen = []

    def before_step(mbs, time):
        seen.append(mbs.GetLoadParameter(load, "loadVector")[0])
        sets(mbs, load, TABLE[round(time / PERIOD)])
        return True

    solve(mbs, before_step, end=0.8, tolerance=tolerance)
    assert seen == TABLE[:-1]
    assert mbs.GetLoadParameter(load, "loadVector")[0] == TABLE[-1]
    assert speed(mbs) == pytest.approx(gained(), rel=tolerance)


def test_a_pressure_follows_what_its_valve_lets_in():
    """y' = t^2 / 2: exact, but for two intervals, as it might have been zero before."""
    mbs = exu.SystemContainer().AddSystem()
    node = first_order(mbs, [0.0])
    tank = mbs.AddObject(items.ObjectGenericODE1(nodeNumbers=[node], rhsVector=[0.0]))

    def before_step(mbs, time):
        mbs.SetObjectParameter(tank, "rhsVector", [0.5 * time * time])
        return True

    solve(mbs, before_step, tolerance=1e-6)
    first_two = (1.0 + 0.5) * PERIOD**3 / 12.0  # a straight line, and half of the bend
    found = mbs.systemData.GetODE1Coordinates()[0]
    assert found == pytest.approx(1.0 / 6.0 + first_two, rel=1e-6)


@pytest.mark.parametrize("sets", ["loadVector", "bodyFixed"])
def test_what_a_post_step_function_sets_stays(sets):
    """It takes the force away, or lets it turn with the body, within the first interval."""
    mbs, load = mass()

    def before_step(mbs, time):
        if time < 1.5 * PERIOD:
            mbs.SetLoadParameter(load, "loadVector", [1.0, 0.0, 0.0])
        return True

    def after_step(mbs, time):
        if time > 0.0:
            mbs.SetLoadParameter(load, sets, [0.0] * 3 if sets == "loadVector" else False)
        return True

    solve(mbs, before_step, after_step)
    stays = 0.0 if sets == "loadVector" else 1.0
    assert mbs.GetLoadParameter(load, "loadVector")[0] == stays


@pytest.mark.parametrize("often", [True, False])
def test_a_post_step_function_that_sets_numbers_is_told_of_where_it_often_does(often):
    """What it sets lags by a step: 20 sin(10 t) over a second is 0.05 off in 20 of them."""
    mbs, load = mass()

    def after_step(mbs, time):
        force = 20.0 * np.sin(10.0 * time) if often else 1.0
        mbs.SetLoadParameter(load, "loadVector", [force, 0.0, 0.0])
        return True

    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        solve(mbs, after_step=after_step)
    told = [each for each in caught if "steps a post-step function changed" in str(each.message)]
    assert len(told) == often
    if not often:
        assert speed(mbs) == pytest.approx(1.0, rel=1e-3)


def test_another_system_is_set_at_once():
    """As of one that the function solves itself."""
    mbs, _ = mass()
    other, load = mass()
    found = []

    def before_step(mbs, time):
        other.SetLoadParameter(load, "loadVector", [time, 0.0, 0.0])
        return True

    def after_step(mbs, time):
        found.append(other.GetLoadParameter(load, "loadVector")[0])
        return True

    solve(mbs, before_step, after_step)
    assert np.unique(found[1:]) == pytest.approx(PERIOD * np.arange(1, 21))


@pytest.mark.parametrize("raises", [False, True])
def test_exudyn_has_its_own_functions_back(raises):
    before = [getattr(exu.MainSystem, name) for name in SETTERS]
    mbs, load = mass()

    def before_step(mbs, time):
        mbs.SetLoadParameter(load, "no such number" if raises else "loadVector", [1.0, 0.0, 0.0])
        return True

    mbs.SetPreStepUserFunction(before_step)
    mbs.Assemble()
    if raises:
        with pytest.raises(exu.ExudynError, match="no such number"):
            solve_dynamic(mbs, settings())
    else:
        assert solve_dynamic(mbs, settings()).check()
    assert [getattr(exu.MainSystem, name) for name in SETTERS] == before
