"""Refined results against closed forms, with errors that cover them."""

import exudyn as exu
import exudyn.utilities as items
import numpy as np
import pytest
from exudyn_systems.models import rotor, settings
from stand_in_system import oscillator, recorded

from exu_press import SolverStatus
from exu_press.exudyn_systems import solve_dynamic


def rows_of(mbs, sensor):
    return np.array(mbs.GetSensorStoredData(sensor))


@pytest.mark.parametrize(("tolerance", "radius"), [(1e-2, 0.5), (1e-3, 1.0), (1e-4, 0.9)])
def test_an_oscillation_has_its_closed_form(tolerance, radius):
    mbs, _, sensor = oscillator(stiffness=100.0)
    given = settings(2.0, 100)
    given.timeIntegration.generalizedAlpha.spectralRadius = radius
    outcome = solve_dynamic(mbs, given, tolerance=tolerance)
    times, values = rows_of(mbs, sensor).T
    true = np.abs(values - np.cos(10.0 * times)).max()
    assert outcome.status is SolverStatus.COMPLETED
    assert true <= outcome.error.sensors[sensor][0] <= tolerance
    assert 0.5 * true <= outcome.error.motion <= tolerance  # over the change, from 1 to -1
    of_peak = outcome.error.peaks[sensor][0]
    assert abs(np.abs(values).max() - 1.0) <= of_peak + 1e-12
    assert of_peak < 0.5 * outcome.error.sensors[sensor][0]  # an error of phase


def test_steps_grow_by_the_order_of_the_method():
    steps = [
        solve_dynamic(oscillator()[0], settings(2.0, 100), tolerance=tolerance).steps
        for tolerance in (1e-3, 1e-5)
    ]
    assert 7.0 < steps[1] / steps[0] < 14.0  # sqrt(100), to the next multiple


def test_a_rotor_whose_steps_span_periods_does_not_deceive():
    """Levels of 25 to 200 steps agree on it, of which each spans periods; its angle hides the rest.

    Its centre answers the force of its unbalance and of its own vibration, each with a closed form.
    """
    mbs, node = rotor()
    sensor = recorded(mbs, node, "Coordinates")
    mbs.Assemble()
    outcome = solve_dynamic(mbs, settings(5.0, 50))
    assert outcome.status is SolverStatus.COMPLETED
    finer, node = rotor()
    sensor = recorded(finer, node, "Coordinates")
    finer.Assemble()
    finer.SolveDynamic(settings(5.0, 4 * outcome.steps))
    both = [rows_of(one, sensor) for one in (mbs, finer)]
    times = both[0][:, 0]
    for column in (1, 2):
        true = np.interp(times, both[1][:, 0], both[1][:, column])
        assert np.abs(both[0][:, column] - true).max() < 1e-3 * np.abs(true).max()


def test_what_rounding_alone_moves_counts_for_nothing():
    """Two masses fall side by side; the place between spring and damper keeps within 1e-11."""
    mbs = exu.SystemContainer().AddSystem()
    nodes = [
        mbs.AddNode(items.Node1D(referenceCoordinates=[0.0], initialVelocities=[-2.0]))
        for _ in range(2)
    ]
    for node, mass in zip(nodes, (3.0, 7.0), strict=True):
        mbs.AddObject(items.ObjectMass1D(nodeNumber=node, mass=mass))
        marker = mbs.AddMarker(items.MarkerNodeCoordinate(nodeNumber=node, coordinate=0))
        mbs.AddLoad(items.LoadCoordinate(markerNumber=marker, load=-9.81 * mass))
    inner = mbs.AddNode(
        items.NodeGenericODE1(
            referenceCoordinates=[0.0], initialCoordinates=[0.0], numberOfODE1Coordinates=1
        )
    )

    def rate(mbs, t, item, q):
        u = mbs.systemData.GetODE2Coordinates()
        return [5000.0 * (u[1] - u[0] - q[0]) / 180.0 + 1e-9 * np.sin(1e7 * t)]

    mbs.AddObject(items.ObjectGenericODE1(nodeNumbers=[inner], rhsUserFunction=rate))
    sensor = recorded(mbs, nodes[0], "Coordinates")
    mbs.Assemble()
    for tolerance in (1e-2, 1e-3):
        outcome = solve_dynamic(mbs, settings(0.4, 100), tolerance=tolerance)
        assert outcome.status is SolverStatus.COMPLETED
        assert rows_of(mbs, sensor)[-1, 1] == pytest.approx(-0.8 - 9.81 * 0.08, rel=1e-9)


GOALS = [0.0, 0.5, -0.3, 0.4, 0.0]


def reference(time):
    """Return where a servo is to be: rest to rest within each second."""
    i = min(int(time), 3)
    s = time - i
    return GOALS[i] + (GOALS[i + 1] - GOALS[i]) * (2 * s * s if s < 0.5 else 1 - 2 * (1 - s) ** 2)


def servo(steps):
    mbs, spring, _ = oscillator(stiffness=4e3, damping=120.0, start=0.0)
    sensor = recorded(mbs, 0, "Coordinates_t")
    mbs.Assemble()

    def sample(mbs, time):
        mbs.SetObjectParameter(spring, "offset", reference(time))
        return True

    mbs.SetPreStepUserFunction(sample)
    return mbs, sensor, settings(4.0, steps, period=0.04)


def test_a_sampled_input_is_refined_with_everything_else():
    """The offset that a pre-step function sets; at 100 steps it jumps every 0.04 s."""
    mbs, sensor, given = servo(100)
    outcome = solve_dynamic(mbs, given)
    finer, _, fine = servo(51_200)
    finer.SolveDynamic(fine)
    true, values = rows_of(finer, sensor)[:, 1], rows_of(mbs, sensor)
    assert outcome.status is SolverStatus.COMPLETED
    missed = np.abs(values[:, 1] - np.interp(values[:, 0], rows_of(finer, sensor)[:, 0], true))
    assert missed.max() < 1e-3 * np.abs(true).max()
    assert missed.max() < outcome.error.sensors[sensor][0]
