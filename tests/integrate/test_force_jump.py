"""Forces that jump where the motion is slow: no step is as small as its tolerance asks for then."""

import math

import exudyn as exu
import exudyn.utilities as items
import pytest

from exu_press import SolverStatus, add_dry_revolute, add_lubricated_revolute, solve_dynamic
from exu_press.laws.contact import hertz, step_damping
from exu_press.laws.film import finite
from exu_press.laws.friction import no_friction
from exudyn_examples.other import mass_1d

FORCE, JUMPS_AT = 100.0, 0.5  # N, s
FREQUENCY, DAMPING = 1e4, 0.05  # rad/s, of the critical one


def sets_in(mbs, time, load):
    """Return a load's value over time."""
    return load if time >= JUMPS_AT else 0.0


def hit(how, speed, stiffness):
    """A kilogram at a speed (m/s), free or on a spring (N/m), until a force sets in."""
    mbs = exu.SystemContainer().AddSystem()
    ends = mass_1d(mbs, 1.0, velocity=speed)
    spring = {"stiffness": stiffness, "damping": 2.0 * DAMPING * math.sqrt(stiffness)}
    mbs.AddObject(items.ObjectConnectorCoordinateSpringDamper(markerNumbers=ends, **spring))
    if how == "load":
        force = {"load": FORCE, "loadUserFunction": sets_in}
        mbs.AddLoad(items.LoadCoordinate(markerNumber=ends[1], **force))
    else:
        load = mbs.AddLoad(items.LoadCoordinate(markerNumber=ends[1], load=0.0))

        def before_step(mbs, time):
            if how == "start" or time > JUMPS_AT + 1e-9:
                mbs.SetLoadParameter(load, "load", FORCE)
            return True

        mbs.SetPreStepUserFunction(before_step)
    mbs.Assemble()
    return mbs


def pendulum(bearing, torque):
    """Ten kilograms that hang and creep, until a torque sets in."""
    mbs = exu.SystemContainer().AddSystem()
    ground = mbs.AddObject(items.ObjectGround())
    creeping = {"initialVelocities": [0.5e-4, 0.0, 1e-4]}
    node = mbs.AddNode(items.NodeRigidBody2D(referenceCoordinates=[0.0, -0.5, 0.0], **creeping))
    body = mbs.AddObject(items.ObjectRigidBody2D(nodeNumber=node, mass=10.0, inertia=10.0 / 12.0))
    mass = mbs.AddMarker(items.MarkerBodyMass(bodyNumber=body))
    mbs.AddLoad(items.LoadMassProportional(markerNumber=mass, loadVector=[0.0, -9.81, 0.0]))
    ends = (body, (0.0, 0.5)), (ground, (0.0, 0.0))
    size = {"radius": 0.02, "clearance": 5e-5}
    if bearing == "lubricated":
        add_lubricated_revolute(mbs, *ends, **size, length=0.03, viscosity=0.1, law=finite(0.75))
    else:
        contact = step_damping(hertz(2.5e10), 2.5e6, 1e-5)
        add_dry_revolute(mbs, *ends, **size, contact=contact, friction=no_friction())
    turned = mbs.AddMarker(items.MarkerNodeCoordinate(nodeNumber=node, coordinate=2))
    moment = {"load": torque, "loadUserFunction": sets_in}
    mbs.AddLoad(items.LoadCoordinate(markerNumber=turned, **moment))
    mbs.Assemble()
    return mbs


def speeds(mbs, tolerance, end=1.0, coordinate=0):
    """All of them, m/s."""
    settings = exu.SimulationSettings()
    settings.timeIntegration.endTime, settings.solution.file.write = end, False
    settings.timeIntegration.numberOfSteps = 100
    found = []

    def watch(time):
        found.append(float(mbs.systemData.GetODE2Coordinates_t()[coordinate]))
        return ""

    outcome = solve_dynamic(mbs, settings, tolerance=tolerance, watch=watch, hold=True)
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


@pytest.mark.parametrize("bearing", ["dry", "lubricated"])
@pytest.mark.parametrize("torque", [1e2, 1e4])
def test_a_slow_pendulum_in_its_bearing_follows_a_torque_that_jumps(bearing, torque):
    """By less than a tenth of a radian; nor is the jump an impact that steps do not resolve."""
    inertia = 10.0 / 12.0 + 10.0 * 0.25
    time = math.sqrt(0.2 * inertia / torque)
    found = speeds(pendulum(bearing, torque), 1e-3, end=JUMPS_AT + time, coordinate=2)
    assert found[-1] == pytest.approx(torque / inertia * time, rel=3e-2)  # less its weight
