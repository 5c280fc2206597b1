"""Forces that jump where the motion is slow: no step is as small as its tolerance asks for then."""

import math

import exudyn as exu
import exudyn.utilities as items
import pytest

from exu_press import SolverStatus, solve_dynamic

FORCE, JUMPS_AT = 100.0, 0.5  # N, s
FREQUENCY, DAMPING = 1e4, 0.05  # rad/s, of the critical one


def hit(how, speed, stiffness):
    """A kilogram at a speed (m/s), free or on a spring (N/m), until a force sets in."""
    mbs = exu.SystemContainer().AddSystem()
    node = mbs.AddNode(items.Node1D(referenceCoordinates=[0.0], initialVelocities=[speed]))
    mbs.AddObject(items.ObjectMass1D(nodeNumber=node, mass=1.0))
    ends = [
        mbs.AddMarker(items.MarkerNodeCoordinate(nodeNumber=number, coordinate=0))
        for number in (mbs.AddNode(items.NodePointGround()), node)
    ]
    spring = {"stiffness": stiffness, "damping": 2.0 * DAMPING * math.sqrt(stiffness)}
    mbs.AddObject(items.ObjectConnectorCoordinateSpringDamper(markerNumbers=ends, **spring))
    if how == "load":
        mbs.AddLoad(
            items.LoadCoordinate(
                markerNumber=ends[1],
                load=FORCE,
                loadUserFunction=lambda mbs, time, load: load if time >= JUMPS_AT else 0.0,
            )
        )
    else:
        load = mbs.AddLoad(items.LoadCoordinate(markerNumber=ends[1], load=0.0))

        def before_step(mbs, time):
            if how == "start" or time > JUMPS_AT + 1e-9:
                mbs.SetLoadParameter(load, "load", FORCE)
            return True

        mbs.SetPreStepUserFunction(before_step)
    mbs.Assemble()
    return mbs


def speeds(mbs, tolerance):
    """All of them, m/s, in a second."""
    settings = exu.SimulationSettings()
    settings.timeIntegration.endTime, settings.solution.file.write = 1.0, False
    settings.timeIntegration.numberOfSteps = 100
    found = []

    def watch(time):
        found.append(float(mbs.systemData.GetODE2Coordinates_t()[0]))
        return ""

    outcome = solve_dynamic(mbs, settings, tolerance=tolerance, watch=watch)
    assert outcome.status is SolverStatus.COMPLETED, outcome.reason
    return found


@pytest.mark.parametrize("how", ["load", "before the step", "start"])
@pytest.mark.parametrize("speed", [0.0, 1e-4])
@pytest.mark.parametrize("tolerance", [1e-3, 1e-4])
def test_a_slow_mass_follows_a_force_that_jumps(how, speed, tolerance):
    gained = FORCE * (1.0 if how == "start" else 1.0 - JUMPS_AT)
    assert speeds(hit(how, speed, 0.0), tolerance)[-1] == pytest.approx(gained, rel=tolerance)


@pytest.mark.parametrize("how", ["load", "before the step", "start"])
def test_a_stiff_spring_answers_a_force_that_jumps(how):
    """The largest speed is F/w e^(-zeta w t) sin(w t), where tan(w t) = sqrt(1 - zeta^2) / zeta."""
    of_waves = FREQUENCY * math.sqrt(1.0 - DAMPING**2)
    phase = math.atan2(of_waves, DAMPING * FREQUENCY)
    decay = math.exp(-DAMPING * FREQUENCY * phase / of_waves)
    largest = FORCE / of_waves * decay * math.sin(phase)
    found = max(speeds(hit(how, 1e-4, FREQUENCY**2), 1e-3))
    assert found == pytest.approx(largest, rel=2e-2)  # steps of a twentieth of a period
