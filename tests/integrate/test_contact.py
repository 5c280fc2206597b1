"""Exudyn's own contacts: what they start from, and gaps that close exactly where a step ends."""

import exudyn as exu
import exudyn.utilities as items
import numpy as np
import pytest

from exu_press import SolverStatus, solve_dynamic
from exudyn_examples.other import mass_1d

SPEED = 10.0  # m/s, of every ball
RESTITUTION = 0.7
RADIUS, MASS = 0.1, 1.6  # m, kg


def balls(*gaps, speed=SPEED, stiffness=1e6, rotations=exu.NodeType.RotationEulerParameters):
    """Balls of 1.6 kg that fly down to fixed ones, from these gaps (m); all gaps are guessed."""
    mbs = exu.SystemContainer().AddSystem()
    nodes = []
    for i, gap in enumerate(gaps):
        still = mbs.AddNode(items.NodePointGround(referenceCoordinates=[i, -2.0 * RADIUS, 0.0]))
        ball = mbs.CreateRigidBody(
            referencePosition=[i, gap, 0.0],
            initialVelocity=[0.0, -speed, 0.0],
            inertia=items.InertiaSphere(MASS, RADIUS),
            nodeType=rotations,
        )
        nodes.append(mbs.GetObject(ball)["nodeNumber"])
        ends = [
            mbs.AddMarker(items.MarkerNodeRigid(nodeNumber=number)) for number in (still, nodes[-1])
        ]
        guess = [0.1, 0.0, 0.0, 0.0]
        data = mbs.AddNode(
            items.NodeGenericData(initialCoordinates=guess, numberOfDataCoordinates=4)
        )
        mbs.AddObject(
            items.ObjectContactSphereSphere(
                markerNumbers=ends,
                nodeNumber=data,
                spheresRadii=[RADIUS, RADIUS],
                contactStiffness=stiffness,
                impactModel=2 if speed else 0,
                restitutionCoefficient=RESTITUTION,
            )
        )
    mbs.Assemble()
    return mbs, nodes


def rebound(*gaps, end=0.1):
    """The speeds with which balls from these gaps rebound, m/s."""
    mbs, nodes = balls(*gaps)
    settings = exu.SimulationSettings()
    settings.timeIntegration.endTime, settings.solution.file.write = end, False
    settings.timeIntegration.numberOfSteps = 100
    outcome = solve_dynamic(mbs, settings, tolerance=1e-3)
    assert outcome.status is SolverStatus.COMPLETED, outcome.reason
    return [mbs.GetNodeOutput(n, exu.OutputVariableType.Velocity)[1] for n in nodes]


def test_a_ball_does_not_pass_a_contact_that_closes_exactly_where_a_step_ends():
    """The gap is then 0.0, which Exudyn takes for neither open nor closed."""
    assert rebound(0.5) == pytest.approx([RESTITUTION * SPEED], rel=2e-3)


@pytest.mark.parametrize(
    ("gaps", "told"), [([0.5, 0.0], [0.1, 0.1]), ([-1e-3], [pytest.approx(-1e-3)])]
)
def test_guesses_that_exudyn_mends_itself_are_left_alone(gaps, told):
    """By the change it tells with which speed surfaces meet; one ball touches to the last digit.

    One that is pressed in has its gap, as it pushes.
    """
    mbs, _ = balls(*gaps)
    started = []

    def look(mbs, time):
        started.append(mbs.systemData.GetDataCoordinates(exu.ConfigurationType.StartOfStep))
        return True

    mbs.SetPreStepUserFunction(look)
    settings = exu.SimulationSettings()
    settings.timeIntegration.endTime, settings.solution.file.write = 1e-3, False
    assert solve_dynamic(mbs, settings).status is SolverStatus.COMPLETED
    assert list(started[0][0::4]) == told


@pytest.mark.parametrize(
    "rotations", [exu.NodeType.RotationEulerParameters, exu.NodeType.RotationRxyz]
)
@pytest.mark.parametrize("tolerance", [1e-3, 1e-4, 1e-5])
def test_surfaces_that_are_pressed_together_push_from_the_start(rotations, tolerance):
    """Exudyn's first step has no force, and no step is short enough for what follows at 1e-5."""
    depth, stiffness = 1e-4, 1e9
    mbs, (node,) = balls(-depth, speed=0.0, stiffness=stiffness, rotations=rotations)
    settings = exu.SimulationSettings()
    settings.timeIntegration.endTime, settings.solution.file.write = 1e-3, False
    outcome = solve_dynamic(mbs, settings, tolerance=tolerance)
    assert outcome.status is SolverStatus.COMPLETED, outcome.reason
    velocity = mbs.GetNodeOutput(node, exu.OutputVariableType.Velocity)[1]
    expected = depth * (stiffness / MASS) ** 0.5
    assert velocity == pytest.approx(expected, rel=3.0 * tolerance)


@pytest.mark.parametrize(("stiffness", "tolerance"), [(1e7, 1e-5), (1e9, 1e-2), (1e10, 1e-3)])
def test_a_stiff_contact_opens_within_the_smallest_step(stiffness, tolerance):
    """Its force changes there by more than Exudyn leaves; it asked for steps that are too short."""
    for gap in (0.0123, 0.034, 0.0777):
        mbs, (node,) = balls(gap, stiffness=stiffness)
        settings = exu.SimulationSettings()
        settings.timeIntegration.endTime, settings.solution.file.write = 0.01, False
        outcome = solve_dynamic(mbs, settings, tolerance=tolerance)
        assert outcome.status is SolverStatus.COMPLETED, outcome.reason
        velocity = mbs.GetNodeOutput(node, exu.OutputVariableType.Velocity)[1]
        assert velocity == pytest.approx(RESTITUTION * SPEED, rel=tolerance + 1e-4)  # of its law
        assert settings.timeIntegration.discontinuous.useRecommendedStepSize


def swing_between_stops(mass):
    """Velocity after 1.5 s of a mass that swings against a stop, with forces that go with it."""
    mbs = exu.SystemContainer().AddSystem()
    ends = mass_1d(mbs, mass, place=0.1)
    spring = {"stiffness": 400.0 * mass, "damping": mass}
    mbs.AddObject(items.ObjectConnectorCoordinateSpringDamper(markerNumbers=ends, **spring))
    data = items.NodeGenericData(initialCoordinates=[0.0] * 3, numberOfDataCoordinates=3)
    mbs.AddObject(
        items.ObjectConnectorCoordinateSpringDamperExt(
            markerNumbers=ends,
            nodeNumber=mbs.AddNode(data),
            useLimitStops=True,
            limitStopsUpper=0.1,
            limitStopsLower=-0.04,
            limitStopsStiffness=1e5 * mass,
            limitStopsDamping=20.0 * mass,
        )
    )
    mbs.Assemble()
    settings = exu.SimulationSettings()
    settings.timeIntegration.endTime, settings.solution.file.write = 1.5, False
    settings.timeIntegration.numberOfSteps = 150
    outcome = solve_dynamic(mbs, settings, tolerance=1e-3)
    assert outcome.status is SolverStatus.COMPLETED, outcome.reason
    assert settings.timeIntegration.discontinuous.iterationTolerance == 1.0
    return float(mbs.systemData.GetODE2Coordinates_t()[0])


@pytest.mark.parametrize("mass", [1.0, 1e-3, 1e-6])
def test_contacts_of_light_bodies_switch_as_those_of_heavy_ones(mass):
    """Exudyn lets half a newton be: a gram at 40 mN was held by its stop, and off by 0.5 m/s."""
    assert swing_between_stops(mass) == pytest.approx(0.4734, abs=2e-2)  # ten tolerances of 2 m/s


def rolling(ignored=True):
    """A disc that slides at 1 m/s, until friction makes it roll at 2/3 m/s, and its settings."""
    mbs = exu.SystemContainer().AddSystem()
    stiffness = 1e5
    body = mbs.CreateRigidBody(
        referencePosition=[0.0, 0.0, RADIUS - 9.81 / stiffness],
        initialVelocity=[1.0, 0.0, 0.0],
        inertia=items.RigidBodyInertia(
            mass=1.0, inertiaTensor=np.diag([0.25, 0.5, 0.25]) * RADIUS**2
        ),
        gravity=[0.0, 0.0, -9.81],
    )
    mbs.CreateRollingDiscPenalty(
        bodyNumbers=[mbs.AddObject(items.ObjectGround()), body],
        axisPosition=[0.0, 0.0, 0.0],
        axisVector=[0.0, 1.0, 0.0],
        discRadius=RADIUS,
        discWidth=0.01,
        contactStiffness=stiffness,
        contactDamping=1e3,
        dryFriction=[0.4, 0.4],
    )
    mbs.Assemble()
    settings = exu.SimulationSettings()
    settings.timeIntegration.endTime, settings.solution.file.write = 0.2, False
    settings.timeIntegration.numberOfSteps = 20
    settings.timeIntegration.discontinuous.ignoreMaxIterations = ignored
    return mbs, body, settings


@pytest.mark.parametrize("tolerance", [1e-2, 1e-3])
def test_friction_that_does_not_settle_costs_small_steps_and_does_not_stop_a_run(tolerance):
    """A disc that rolls changes the sign of its friction in steps of any size."""
    mbs, body, settings = rolling()
    outcome = solve_dynamic(mbs, settings, tolerance=tolerance)
    assert outcome.status is SolverStatus.COMPLETED, outcome.reason
    velocity = mbs.GetObjectOutputBody(body, exu.OutputVariableType.Velocity)
    assert velocity[0] == pytest.approx(2.0 / 3.0, abs=0.2 * tolerance)
    assert outcome.steps < 4.0 / tolerance
    assert settings.timeIntegration.discontinuous.ignoreMaxIterations


def test_a_run_that_is_not_to_ignore_it_names_what_would():
    mbs, _, settings = rolling(ignored=False)
    with pytest.warns(UserWarning, match="not converged"):
        outcome = solve_dynamic(mbs, settings)
    assert outcome.status is SolverStatus.NOT_CONVERGED
    assert "dryFrictionProportionalZone" in outcome.reason
    assert "ignoreMaxIterations = True" in outcome.reason


def test_a_run_that_switches_all_the_time_says_so():
    mbs, _, settings = rolling()
    with pytest.warns(UserWarning, match="too many steps"):
        outcome = solve_dynamic(mbs, settings, tolerance=1e-5, max_steps=3000)
    assert "of Exudyn's switched in" in outcome.reason
    assert "frictionProportionalZone" in outcome.reason
