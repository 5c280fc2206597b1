"""Any Exudyn system with a tolerance: its error follows it, whatever the system's size is.

Runs that stop early say when, where and what to try.
"""

import itertools
import json
import os
import re
import subprocess
import sys

import exudyn as exu
import exudyn.utilities as items
import numpy as np
import pytest
from exudyn.utilities import AngularVelocity2EulerParameters_t
from patched import PATCHED
from scipy.integrate import solve_ivp
from scipy.linalg import expm

from exu_press import (
    InputError,
    Result,
    Scene,
    SolverStatus,
    add_dry_revolute,
    add_lubricated_revolute,
    simulate,
    solve_dynamic,
)
from exu_press.cli import main
from exu_press.laws.contact import hertz, hunt_crossley, hysteretic
from exu_press.laws.film import pinkus
from exu_press.laws.friction import no_friction
from exudyn_examples import EXAMPLES
from exudyn_examples.flexible import cables, hold, weight
from exudyn_examples.other import arm_on_cylinder, first_order, mass_1d, stick_slip
from exudyn_examples.planar import bar, pin

POSITION = exu.OutputVariableType.Coordinates
TOLERANCES = [1e-2, 1e-3, 1e-4, 1e-5]


def settings(end, steps=100):
    chosen = exu.SimulationSettings()
    chosen.timeIntegration.endTime, chosen.timeIntegration.numberOfSteps = end, steps
    chosen.timeIntegration.generalizedAlpha.spectralRadius = 0.8
    chosen.solution.file.write = False
    return chosen


def pendulum(length=1.0, mass=1.0, joint="ideal", gravity=9.81, force=1.0):
    """A rod let go while horizontal, its centre of mass a length from the joint."""
    mbs = exu.SystemContainer().AddSystem()
    ground = mbs.AddObject(items.ObjectGround())
    node = mbs.AddNode(items.NodeRigidBody2D(referenceCoordinates=[length, 0.0, 0.0]))
    inertia = mass * length**2 / 12.0
    rod = mbs.AddObject(items.ObjectRigidBody2D(nodeNumber=node, mass=mass, inertia=inertia))
    ends = (rod, (-length, 0.0)), (ground, (0.0, 0.0))
    size = {"radius": 0.02 * length, "clearance": 2e-4 * length}
    if joint == "ideal":
        markers = [
            mbs.AddMarker(items.MarkerBodyRigid(bodyNumber=body, localPosition=[*point, 0.0]))
            for body, point in reversed(ends)
        ]
        mbs.AddObject(items.ObjectJointRevolute2D(markerNumbers=markers))
    elif joint == "dry":
        slowest = 1e-3 * (length * gravity / 9.81) ** 0.5
        stiffness = hertz(1e10 * force / length**1.5)
        contact = hysteretic(stiffness, 0.5, lambda e: 1.5 * (1.0 - e), slowest_impact=slowest)
        add_dry_revolute(mbs, *ends, **size, contact=contact, friction=no_friction())
    else:
        viscosity = 1.0 * force * (9.81 * length / gravity) ** 0.5 / length**2
        width = {"length": size["radius"], "law": pinkus()}
        add_lubricated_revolute(mbs, *ends, **size, **width, viscosity=viscosity)
    at = mbs.AddMarker(items.MarkerBodyMass(bodyNumber=rod))
    mbs.AddLoad(items.LoadMassProportional(markerNumber=at, loadVector=[0.0, -gravity, 0.0]))
    mbs.Assemble()
    return mbs, node


@pytest.mark.parametrize("tolerance", TOLERANCES)
def test_a_pendulum_from_rest(tolerance):
    """Angular velocity after 3 s, against the largest one of 4.6 rad/s."""
    expected = solve_ivp(
        lambda _, y: [y[1], -9.81 * np.cos(y[0]) / (1.0 + 1.0 / 12.0)],
        (0.0, 3.0),
        [0.0, 0.0],
        "DOP853",
        rtol=1e-12,
        atol=1e-12,
    ).y[:, -1]
    mbs, node = pendulum()
    outcome = solve_dynamic(mbs, settings(3.0), tolerance=tolerance)
    assert outcome.status is SolverStatus.COMPLETED
    rate = mbs.GetNodeOutput(node, exu.OutputVariableType.Coordinates_t)[2]
    assert 0.1 < abs(rate - expected[1]) / 4.6 / tolerance < 5.0


SIZES = [(1e-6, 1e-18, 1e-3), (1e3, 1e9, 30.0), (1.0, 1e6, 1e-2), (1.0, 1e-6, 1e2)]
"""In length, mass and time: a watch, a crane, something heavy and fast, light and slow."""


def steps_of(joint, length, mass, time):
    unit = length / time**2
    mbs, _ = pendulum(length, mass, joint, gravity=9.81 * unit, force=mass * unit)
    chosen = settings((1.0 if joint == "ideal" else 0.1) * time)
    chosen.timeIntegration.minimumStepSize *= time
    outcome = solve_dynamic(mbs, chosen)
    assert outcome.status is SolverStatus.COMPLETED, outcome.reason
    return outcome.steps


@pytest.mark.parametrize("joint", ["ideal", "dry", "lubricated"])
def test_a_watch_and_a_crane_behave_alike(joint):
    """Scaled in length, mass and time: the same steps, but for rounding."""
    usual = steps_of(joint, 1.0, 1.0, 1.0)
    assert [steps_of(joint, *size) for size in SIZES] == pytest.approx([usual] * 4, rel=0.02, abs=2)


@pytest.mark.parametrize("tolerance", TOLERANCES[1:])
def test_a_body_that_rotates_in_space(tolerance):
    """Euler's equations, about the middle axis, where errors grow by exp(5.8 t): 18 in 0.5 s."""
    inertia, spin = np.array([1.0, 2.0, 3.0]), [0.1, 10.0, 0.1]
    expected = solve_ivp(
        lambda _, w: -np.cross(w, inertia * w) / inertia,
        (0.0, 0.5),
        spin,
        "DOP853",
        rtol=1e-12,
        atol=1e-12,
    ).y[:, -1]
    mbs = exu.SystemContainer().AddSystem()
    start = [1.0, 0.0, 0.0, 0.0]
    node = mbs.AddNode(
        items.NodeRigidBodyEP(
            referenceCoordinates=[0.0, 0.0, 0.0, *start],
            initialVelocities=[0.0, 0.0, 0.0, *AngularVelocity2EulerParameters_t(spin, start)],
        )
    )
    mbs.AddObject(items.ObjectRigidBody(nodeNumber=node, mass=1.0, inertia=[*inertia, 0, 0, 0]))
    mbs.Assemble()
    assert solve_dynamic(mbs, settings(0.5), tolerance=tolerance).status is SolverStatus.COMPLETED
    spin = mbs.GetNodeOutput(node, exu.OutputVariableType.AngularVelocityLocal)
    assert np.abs(spin - expected).max() / 10.0 < 18.0 * tolerance


@pytest.mark.parametrize("tolerance", TOLERANCES)
def test_first_order_coordinates(tolerance):
    """A damped oscillator as two first-order equations, whose rates Exudyn starts from zero."""
    matrix = [[0.0, 1.0], [-1.0, -0.1]]
    mbs = exu.SystemContainer().AddSystem()
    node = first_order(mbs, [1.0, 0.0])
    mbs.AddObject(
        items.ObjectGenericODE1(nodeNumbers=[node], systemMatrix=matrix, rhsVector=[0.0, 0.0])
    )
    mbs.Assemble()
    assert solve_dynamic(mbs, settings(10.0), tolerance=tolerance).status is SolverStatus.COMPLETED
    expected = expm(10.0 * np.array(matrix)) @ [1.0, 0.0]
    assert np.abs(mbs.GetNodeOutput(node, POSITION) - expected).max() < 5.0 * tolerance


def test_friction_of_exudyns_own_with_its_switching():
    """A mass on a spring comes to rest: Coulomb's friction takes 2 F/k of amplitude a swing."""
    ends = []
    for tolerance in (1e-3, 1e-5):
        mbs = exu.SystemContainer().AddSystem()
        stick_slip(mbs)
        mbs.Assemble()
        outcome = solve_dynamic(mbs, settings(2.0), tolerance=tolerance)
        assert outcome.status is SolverStatus.COMPLETED
        ends.append(float(mbs.GetNodeOutput(0, POSITION)))
    assert abs(ends[1]) < 8.0 / 100.0, "it rests where friction holds the spring"
    assert ends[0] == pytest.approx(ends[1], abs=3e-4)  # of 0.4 m


def rebound(start, stiffness, time):
    """Speed of a mass that falls by `start` onto an elastic support, before its second impact."""
    speed, root = (2.0 * 9.81 * start) ** 0.5, stiffness**0.5
    sag = 9.81 / stiffness
    lasts = (2.0 * np.pi - 2.0 * np.arctan(speed / (9.81 / root))) / root
    assert abs(sag * (1.0 - np.cos(root * lasts)) + speed / root * np.sin(root * lasts)) < 1e-12
    return speed - 9.81 * (time - speed / 9.81 - lasts)


@pytest.mark.parametrize("tolerance", [1e-2, 1e-3, 1e-4])
def test_general_contact_of_exudyns_own_lets_go(tolerance):
    """It counts a switch as 1, and with Exudyn's own limit of 1 the spheres went on to pull."""
    mbs = exu.SystemContainer().AddSystem()
    contact = mbs.AddGeneralContact()
    contact.SetFrictionPairings(np.zeros((1, 1)))
    contact.SetSearchTreeCellSize([2, 2, 2])
    nodes = [
        mbs.AddNode(items.NodePointGround()),
        mbs.AddNode(items.NodePoint(referenceCoordinates=[0.0, 0.25, 0.0])),
    ]
    mbs.AddObject(items.ObjectMassPoint(nodeNumber=nodes[1], mass=1.0))
    markers = [mbs.AddMarker(items.MarkerNodePosition(nodeNumber=node)) for node in nodes]
    mbs.AddLoad(items.LoadForceVector(markerNumber=markers[1], loadVector=[0.0, -9.81, 0.0]))
    for marker in markers:
        contact.AddSphereWithMarker(
            marker, radius=0.1, contactStiffness=1e4, contactDamping=0.0, frictionMaterialIndex=0
        )
    mbs.Assemble()
    assert solve_dynamic(mbs, settings(0.2), tolerance=tolerance).status is SolverStatus.COMPLETED
    speed = mbs.GetNodeOutput(nodes[1], exu.OutputVariableType.Velocity)[1]
    expected = rebound(0.05, 0.5e4, 0.2)  # two springs in series
    assert abs(speed - expected) < 3.0 * tolerance


def test_clearance_joints_in_a_system_of_ones_own():
    """A rod falls into its bearing and swings: it passes below with 5/2 of its weight at least."""
    mbs, _ = pendulum(0.5, 10.0, joint="dry", force=0.35)
    outcome = solve_dynamic(mbs, settings(0.2), tolerance=1e-3)
    assert outcome.status is SolverStatus.COMPLETED, outcome.reason
    assert outcome.law_evaluations > outcome.steps


def test_functions_and_settings_of_the_user_take_part_and_stay():
    mbs, _ = pendulum()
    called = {"before": 0, "after": 0}

    def before(mbs, time):
        called["before"] += 1
        return True

    def after(mbs, time):
        called["after"] += 1
        return time < 0.5

    mbs.SetPreStepUserFunction(before)
    mbs.SetPostStepUserFunction(after)
    chosen = settings(3.0)
    chosen.timeIntegration.newton.maxIterations = 17
    outcome = solve_dynamic(mbs, chosen, sample=0.0)
    assert called["before"] == 1 + outcome.steps + outcome.rejected_steps  # at the start too
    assert called["after"] == outcome.steps + 1  # at the start too, as Exudyn does
    assert 0.5 <= outcome.end_time < 0.7
    assert outcome.status is SolverStatus.INTERRUPTED
    assert chosen.timeIntegration.newton.maxIterations == 17
    mbs.SolveDynamic(chosen)
    assert called["after"] > outcome.steps + 2, "it is still there"


def test_a_load_that_jumps_at_a_tight_tolerance():
    """Steps of 20 ns ended in what rounded positions make alternate."""
    mbs = exu.SystemContainer().AddSystem()
    EXAMPLES["four-bar"].build(mbs)
    at = mbs.AddMarker(items.MarkerBodyRigid(bodyNumber=1))
    mbs.AddLoad(
        items.LoadTorqueVector(
            markerNumber=at,
            loadVector=[0.0, 0.0, 1.0],
            loadVectorUserFunction=lambda mbs, time, load: [0, 0, 0.5 if time > 0.1 else -0.3],
        )
    )
    mbs.Assemble()
    outcome = solve_dynamic(mbs, settings(0.12), tolerance=1e-6)
    assert outcome.status is not SolverStatus.STEP_TOO_SMALL, outcome.reason


def test_behind_a_load_that_reaches_a_mass_through_a_filter_steps_grow_again():
    """The jump of the rate of accelerations was taken for a part of a vibration's cycle."""
    mbs = exu.SystemContainer().AddSystem()
    ends = mass_1d(mbs, 1.0, place=0.1)
    filtered = first_order(mbs, [0.0])
    mbs.AddObject(
        items.ObjectGenericODE1(
            nodeNumbers=[filtered],
            rhsUserFunction=lambda mbs, time, item, state: [(float(time > 0.7) - state[0]) / 0.01],
        )
    )
    mbs.AddObject(
        items.ObjectConnectorCoordinateSpringDamper(
            markerNumbers=ends, stiffness=400.0, damping=4.0
        )
    )
    mbs.AddLoad(
        items.LoadCoordinate(
            markerNumber=ends[1],
            load=0.0,
            loadUserFunction=lambda mbs, time, load: 100.0 * mbs.GetNodeOutput(filtered, POSITION),
        )
    )
    mbs.Assemble()
    outcome = solve_dynamic(mbs, settings(2.0), tolerance=1e-5, max_steps=20_000)
    assert outcome.status is SolverStatus.COMPLETED, outcome.reason


def hanging(mbs):
    """Two bars below each other."""
    before, place = mbs.AddObject(items.ObjectGround()), (0.0, 0.0)
    for i in range(2):
        body, half, _ = bar(mbs, (0.0, -i), (0.0, -i - 1.0), 1.0)
        pin(mbs, before, place, body, (-half, 0.0))
        before, place = body, (half, 0.0)
    mbs.Assemble()


def sagging(mbs):
    """A stiff clamped cable in its static equilibrium."""
    nodes, bodies = cables(mbs, 2.1e8, 1e-3, 1e-3)
    for body in bodies:
        weight(mbs, body)
    hold(mbs, nodes[0], (0, 1, 3))
    mbs.Assemble()
    mbs.SolveStatic(settings(1.0), updateInitialValues=True)


def held(mbs):
    """An arm on a hydraulic cylinder that carries it: 1e-15 m/s^2 made steps of a microsecond."""
    ground = mbs.AddObject(items.ObjectGround())
    oil = {"hoseVolume0": 0.01, "hoseVolume1": 0.01, "oilBulkModulus": 1e8}
    arm_on_cylinder(mbs, ground, 1.1, 100.0, **oil, actuatorDamping=1e4)
    mbs.Assemble()


@pytest.mark.parametrize("system", [hanging, sagging, held])
@pytest.mark.parametrize("tolerance", [1e-2, 1e-4, 1e-5])
def test_an_equilibrium_is_at_rest(system, tolerance):
    """Rounded forces were to be balanced to a part of the next to nothing that they accelerate."""
    mbs = exu.SystemContainer().AddSystem()
    system(mbs)
    outcome = solve_dynamic(mbs, settings(1.0), tolerance=tolerance)
    assert outcome.status is SolverStatus.COMPLETED, outcome.reason
    assert outcome.steps < 200 and outcome.rejected_steps < 5
    assert np.abs(mbs.systemData.GetODE2Coordinates_t()).max() < 1e-9


def oscillator(kind, place, speed, frequency, duration, beside=False):
    """Error of the speed, over its largest value, at the end of a vibration from a place."""
    mbs = exu.SystemContainer().AddSystem()
    if beside:
        still = mbs.AddNode(items.NodePoint(referenceCoordinates=[1.0, 0.0, 0.0]))
        mbs.AddObject(items.ObjectMassPoint(nodeNumber=still, mass=1.0))
    node = mbs.AddNode(items.Node1D(referenceCoordinates=[place], initialVelocities=[speed]))
    mbs.AddObject(kind(node))
    ends = [
        mbs.AddMarker(items.MarkerNodeCoordinate(nodeNumber=number, coordinate=0))
        for number in (mbs.AddNode(items.NodePointGround()), node)
    ]
    stiffness = (2.0 * np.pi * frequency) ** 2
    mbs.AddObject(
        items.ObjectConnectorCoordinateSpringDamper(markerNumbers=ends, stiffness=stiffness)
    )
    mbs.Assemble()
    chosen = settings(duration)
    chosen.timeIntegration.minimumStepSize = 1e-6 * duration
    outcome = solve_dynamic(mbs, chosen)
    assert outcome.status is SolverStatus.COMPLETED, outcome.reason
    end = mbs.GetNodeOutput(node, exu.OutputVariableType.Coordinates_t)
    return abs(end / speed - np.cos(2.0 * np.pi * frequency * duration))


def sliding(node):
    return items.ObjectMass1D(mass=1.0, nodeNumber=node)


def turning(node):
    return items.ObjectRotationalMass1D(inertia=1.0, nodeNumber=node)


def test_small_and_fast_motions_are_not_at_rest():
    """Those of nanometres, of a system whose size the coordinates do not tell, and of a rotor."""
    assert oscillator(sliding, 0.5, 1e-6, 500.0, 0.02) < 1e-2
    assert oscillator(sliding, 0.0, 1e-5, 1.1e8, 1e-7) < 1e-2, "Exudyn ends it 1e-10 s early"
    assert oscillator(turning, 0.0, 3.0, 5.3, 2.0, beside=True) < 1e-2


def triangle(mbs):
    """A bar between two pins on the ground, which hold its length twice."""
    ground, (body, half, _) = mbs.AddObject(items.ObjectGround()), bar(mbs, (0, 0), (1, 0), 1.0)
    pin(mbs, ground, (0.0, 0.0), body, (-half, 0.0))
    pin(mbs, body, (half, 0.0), ground, (1.0, 0.0))


def bricard(mbs):
    """Its joints say nothing of their free axes, in rows of their own."""
    EXAMPLES["Bricard"].build(mbs)


def pushed(force, mass=1.0):
    def build(mbs):
        node = mbs.AddNode(items.Node1D(referenceCoordinates=[0.0], name="ram"))
        mbs.AddObject(items.ObjectMass1D(mass=mass, nodeNumber=node))
        at = mbs.AddMarker(items.MarkerNodeCoordinate(nodeNumber=node, coordinate=0))
        mbs.AddLoad(items.LoadCoordinate(markerNumber=at, load=1.0, loadUserFunction=force))

    return build


@pytest.mark.parametrize(
    ("build", "reason"),
    [
        (triangle, "at t = 0 s: 1 constraint says the same as others"),
        pytest.param(
            bricard,
            "1 constraint says the same as others.*ignoreSingularJacobian",
            marks=pytest.mark.long,
        ),
        (pushed(lambda mbs, time, load: np.nan if time > 0.1 else 1.0), "t = 0.1 s.* on ram"),
        (pushed(lambda mbs, time, load: 1.0, mass=0.0), r"without mass \(ram\)"),
    ],
)
def test_what_keeps_newtons_method_from_converging_is_named(build, reason):
    """It was a smaller tolerance that was to be tried."""
    mbs = exu.SystemContainer().AddSystem()
    build(mbs)
    mbs.Assemble()
    outcome = solve_dynamic(mbs, settings(0.3))
    # rounding decides how far redundant constraints let a run get
    assert outcome.status in (SolverStatus.NOT_CONVERGED, SolverStatus.STEP_TOO_SMALL)
    assert re.search(reason, outcome.reason), outcome.reason


def unassembled():
    mbs = exu.SystemContainer().AddSystem()
    mbs.AddNode(items.NodePoint())
    return mbs


def lie_group():
    mbs = exu.SystemContainer().AddSystem()
    node = mbs.AddNode(items.NodeRigidBodyRotVecLG(referenceCoordinates=[0.0] * 6))
    mbs.AddObject(items.ObjectRigidBody(nodeNumber=node, mass=1, inertia=[1, 1, 1, 0, 0, 0]))
    mbs.Assemble()
    return mbs


def with_settings(**changes):
    chosen = settings(1.0)
    for name, value in changes.items():
        *parts, last = name.split("__")
        part = chosen.timeIntegration
        for inner in parts:
            part = getattr(part, inner)
        setattr(part, last, value)
    return chosen


def dry_journal(eccentricity):
    mbs = exu.SystemContainer().AddSystem()
    ground = mbs.AddObject(items.ObjectGround())
    node = mbs.AddNode(items.NodeRigidBody2D(referenceCoordinates=[1.0 + eccentricity, 0.0, 0.0]))
    rod = mbs.AddObject(items.ObjectRigidBody2D(nodeNumber=node, mass=1.0, inertia=0.1))
    laws = {"contact": hunt_crossley(hertz(1e10), restitution=0.5), "friction": no_friction()}
    ends = (rod, (-1.0, 0.0)), (ground, (0.0, 0.0))
    add_dry_revolute(mbs, *ends, radius=0.02, clearance=1e-4, **laws)
    mbs.Assemble()
    return mbs


def state_of(mbs):
    """All coordinates, the user functions and what the solver leaves behind."""
    if not mbs.systemIsConsistent:
        return None
    data, where = mbs.systemData, exu.ConfigurationType.Current
    of = data.GetODE2Coordinates, data.GetODE2Coordinates_t, data.GetODE2Coordinates_tt
    functions = mbs.GetPreStepUserFunction(), mbs.GetPostNewtonUserFunction()
    return [part(where).tolist() for part in of], functions, dict(mbs.sys)


@pytest.mark.parametrize(
    "keys",
    [
        {"solverType": exu.DynamicSolverType.TrapezoidalIndex2},
        {"generalizedAlpha__useNewmark": True},
    ],
)
def test_another_implicit_method_is_switched_to_generalized_alpha_with_a_warning(keys):
    mbs, node = pendulum()
    solve_dynamic(mbs, settings(0.2))
    expected = mbs.GetNodeOutput(node, exu.OutputVariableType.Coordinates)
    mbs, node = pendulum()
    chosen = with_settings(**keys)
    chosen.timeIntegration.endTime = 0.2
    before = chosen.timeIntegration.generalizedAlpha.useNewmark
    with pytest.warns(UserWarning, match="solved with GeneralizedAlpha"):
        assert solve_dynamic(mbs, chosen).status is SolverStatus.COMPLETED
    assert mbs.GetNodeOutput(node, exu.OutputVariableType.Coordinates).tolist() == expected.tolist()
    assert chosen.timeIntegration.generalizedAlpha.useNewmark == before


def test_a_spectral_radius_of_one_gives_way_to_one_that_damps():
    mbs, node = pendulum()
    solve_dynamic(mbs, with_settings(generalizedAlpha__spectralRadius=0.9, endTime=0.2))
    expected = mbs.GetNodeOutput(node, exu.OutputVariableType.Coordinates)
    mbs, node = pendulum()
    chosen = with_settings(generalizedAlpha__spectralRadius=1.0, endTime=0.2)
    with pytest.warns(UserWarning, match="spectralRadius = 1: solved with 0.9"):
        solve_dynamic(mbs, chosen)
    assert mbs.GetNodeOutput(node, exu.OutputVariableType.Coordinates).tolist() == expected.tolist()
    assert chosen.timeIntegration.generalizedAlpha.spectralRadius == 1.0


def test_behind_a_stiff_stop_steps_grow_again_whatever_the_spectral_radius():
    """Two rods, the outer of which runs against it: with 1.0 what alternates stopped the run."""
    mbs = exu.SystemContainer().AddSystem()
    last, at = mbs.AddObject(items.ObjectGround()), (0.0, 0.0)
    for start in (0.0, 1.0):
        rod, half, node = bar(mbs, (start, 0.0), (start + 1.0, 0.0), 1.0)
        pin(mbs, last, at, rod, (-half, 0.0))
        last, at = rod, (half, 0.0)
    ground = mbs.AddMarker(
        items.MarkerNodeCoordinate(nodeNumber=mbs.AddNode(items.NodePointGround()), coordinate=0)
    )
    angle = mbs.AddMarker(items.MarkerNodeCoordinate(nodeNumber=node, coordinate=2))

    def stop(mbs, time, item, angle, speed, *given):
        deep = angle + 0.6
        return 1e6 * deep + 1e4 * speed if deep < 0.0 else 0.0

    mbs.AddObject(
        items.ObjectConnectorCoordinateSpringDamper(
            markerNumbers=[ground, angle], springForceUserFunction=stop
        )
    )
    mbs.Assemble()
    with pytest.warns(UserWarning, match="spectralRadius = 1: solved with 0.9"):
        outcome = solve_dynamic(mbs, with_settings(generalizedAlpha__spectralRadius=1.0))
    assert outcome.status is SolverStatus.COMPLETED
    assert outcome.steps + outcome.rejected_steps < 8000


@pytest.mark.parametrize(
    ("system", "chosen", "tolerance", "message"),
    [
        (unassembled, settings(1.0), 1e-3, "not assembled"),
        (lie_group, settings(1.0), 1e-3, "RotVecLG"),
        (lambda: pendulum()[0], with_settings(endTime=0.0), 1e-3, "endTime = 0.0"),
        (lambda: pendulum()[0], settings(1.0), 0.5, "tolerance = 0.5: allowed is"),
        (
            lambda: pendulum()[0],
            with_settings(solverType=exu.DynamicSolverType.RK44),
            1e-3,
            "solverType = RK44",
        ),
        (
            lambda: pendulum()[0],
            with_settings(generalizedAlpha__spectralRadius=0.0),
            1e-3,
            "spectralRadius = 0.0",
        ),
        (lambda: pendulum()[0], with_settings(endTime=np.inf), 1e-3, "endTime = inf"),
        (lambda: pendulum()[0], with_settings(endTime=1e-8), 1e-3, "a run of 1e-07 s or more"),
        (lambda: pendulum()[0], settings(1.0), "1e-3", "tolerance = '1e-3': allowed is"),
        (lambda: pendulum()[0], settings(1.0), np.nan, "tolerance = nan: allowed is"),
        (lambda: dry_journal(0.01), settings(1.0), 1e-3, "eccentricity of 0.01 m"),
    ],
)
def test_what_cannot_be_solved_is_refused_by_name(system, chosen, tolerance, message):
    mbs = system()
    before = state_of(mbs)
    with pytest.raises(InputError, match=message):
        solve_dynamic(mbs, chosen, tolerance=tolerance)
    assert state_of(mbs) == before


def test_a_system_of_hundreds_of_coordinates():
    """Exudyn 1.13.6 crashed when it was asked for all coordinates at the start."""
    mbs = exu.SystemContainer().AddSystem()
    for i in range(200):
        node = mbs.AddNode(items.NodePoint(referenceCoordinates=[0.01 * i, 0.0, 0.0]))
        mbs.AddObject(items.ObjectMassPoint(nodeNumber=node, mass=1.0))
        at = mbs.AddMarker(items.MarkerNodePosition(nodeNumber=node))
        mbs.AddLoad(items.LoadForceVector(markerNumber=at, loadVector=[0.0, -9.81, 0.0]))
    mbs.Assemble()
    chosen = settings(0.1)
    assert solve_dynamic(mbs, chosen).status is SolverStatus.COMPLETED
    fall = mbs.GetNodeOutput(node, exu.OutputVariableType.Displacement)[1]
    assert fall == pytest.approx(-0.5 * 9.81 * 0.1**2, rel=1e-6)


@pytest.mark.parametrize("mechanism", ["slider_crank", "press"])
def test_velocities_of_an_ideal_mechanism_follow_the_tolerance(mechanism):
    errors = []
    for tolerance in (1e-4, 1e-5, 2e-6):
        scene = Scene(
            mechanism=mechanism, joints={}, revolutions=0.5, solver={"tolerance": tolerance}
        )
        run = simulate(scene)
        assert run.completed
        motion = scene.build().mechanism.ideal_slider(run["crank_angle"], scene.angular_speed)
        errors.append(np.abs(run["slider_velocity"] - motion[1]).max() / scene.pin_speed)
    for error, tolerance in zip(errors, (1e-4, 1e-5, 2e-6), strict=True):
        assert 0.05 * tolerance < error < 2.0 * tolerance


THIN_OIL = {
    "mechanism": "slider_crank",
    "joints": {"crank_pin": "lubricated"},
    "revolutions": 1.0,
    "film": {"viscosity": 1e-7},
    "solver": {"step": 1e-4},
}
BREAKDOWN = re.compile(
    r"film broke down at t = (\S+) s, crank angle (\S+) deg, eccentricity ratio (\S+) "
    r"\(crank_pin\); try another value.*: film\.viscosity = 1e-07 Pa s is below .*"
)


@pytest.fixture(scope="module", params=["slider_crank", "press"])
def broken(request):
    return simulate(Scene.from_dict({**THIN_OIL, "mechanism": request.param}))


def test_film_that_breaks_down_says_when_and_where(broken):
    assert broken.info["status"] == "film broke down"
    match = BREAKDOWN.fullmatch(broken.info["reason"])
    assert match, broken.info["reason"]
    when, angle, ratio = map(float, match.groups())
    assert when == pytest.approx(broken.info["end_time"], rel=1e-4)
    assert angle == pytest.approx(360.0 * 4.0 * when, abs=0.02)
    assert ratio >= 1.0


def test_what_was_computed_before_the_breakdown_is_kept(broken):
    assert not broken.completed
    assert 0.0 < broken.time[-1] < 0.25
    assert broken.time[-1] == pytest.approx(broken.info["end_time"], rel=1e-9)
    assert broken.info["steps"] == len(broken.time) - 1 > 10
    ratio = np.linalg.norm(broken["crank_pin_eccentricity"], axis=1) / 1e-4
    assert ratio.max() < 1.0, "no accepted state lies outside the film"
    assert ratio[-1] > 0.9, "and the last one is close to its end"
    for name in broken:
        assert np.all(np.isfinite(broken[name])), name


def test_summary_of_a_breakdown_is_complete(broken):
    summary = broken.summary()
    assert summary["status"] == "film broke down"
    assert summary["reason"] == broken.info["reason"]
    assert summary["cost"]["rejected_steps"] > 0, "the step was halved before giving up"
    assert 0.9 < summary["quantities"]["joints.crank_pin.max_eccentricity_ratio"]["value"] < 1.0
    json.dumps(summary, allow_nan=False)


def test_film_that_holds_completes():
    result = simulate(Scene.from_dict({**THIN_OIL, "film": {"viscosity": 0.4}}))
    assert result.info["status"] == "completed"
    assert result.info["reason"] == ""


def test_command_that_stops_early_exits_with_3_and_keeps_everything(tmp_path):

    path = tmp_path / "scene.toml"
    path.write_text(
        'mechanism = "slider_crank"\n[film]\nviscosity = 1e-7\n[solver]\nstep = 1e-4\n',
        encoding="utf-8",
    )
    out = tmp_path / "out"
    assert main(["run", str(path), "--out", str(out), "--quiet", "--no-pictures"]) == 3
    summary = json.loads((out / "summary.json").read_text(encoding="utf-8"))
    assert summary["status"] == "film broke down"
    assert Result.load(out / "run.nc").info["reason"] == summary["reason"]


CTRL_C = """
import os, signal, sys, threading, time

def press_ctrl_c():
    while signal.getsignal(signal.SIGINT) in (signal.default_int_handler, signal.SIG_DFL):
        time.sleep(0.01)  # until the run listens
    time.sleep(0.3)
    os.kill(os.getpid(), signal.SIGINT)

threading.Thread(target=press_ctrl_c, daemon=True).start()
"""
LONG_RUN = """
from exu_press import Scene, simulate
simulate(Scene.from_dict({
    "mechanism": "slider_crank", "revolutions": 100.0, "solver": {"step": 1e-5}})).save(sys.argv[1])
assert signal.getsignal(signal.SIGINT) is signal.default_int_handler, "as before the run"
"""
LONG_COMMAND = """
from exu_press.cli import main
raise SystemExit(main(["run", "slider_crank", "--set", "revolutions=100", "--set",
                       "solver.step=1e-5", "--no-pictures", "--out", sys.argv[1]]))
"""
POSIX = pytest.mark.skipif(os.name != "posix", reason="SIGINT to a process")


def interrupted(code, argument):
    command = [sys.executable, "-c", CTRL_C + code, str(argument)]
    return subprocess.run(command, capture_output=True, text=True, timeout=60)


@POSIX
def test_interrupt_keeps_what_was_computed(tmp_path):
    done = interrupted(LONG_RUN, tmp_path / "run.nc")
    assert done.returncode == 0, done.stderr
    result = Result.load(tmp_path / "run.nc")
    assert result.info["status"] == "interrupted"
    where = r"interrupted at t = \S+ s, crank angle \S+ deg"
    assert re.fullmatch(where, result.info["reason"]), result.info["reason"]
    assert 10 < result.info["steps"] == len(result.time) - 1 < 2_500_000
    assert result.time[-1] == pytest.approx(result.info["end_time"], rel=1e-9)
    assert np.all(np.isfinite(result["slider_position"]))
    assert result.info["rejected_steps"] <= 1  # a film's first step is taken twice


@POSIX
def test_interrupted_command_exits_with_3(tmp_path):
    """Summary and run.nc are written, the reason is told in one line, no traceback."""
    done = interrupted(LONG_COMMAND, tmp_path)
    assert done.returncode == 3, done.stderr
    assert "Traceback" not in done.stderr
    assert "stopped early: interrupted at t = " in done.stderr
    summary = json.loads((tmp_path / "summary.json").read_text(encoding="utf-8"))
    assert summary["status"] == "interrupted"
    assert summary["cost"]["steps"] > 10
    assert Result.load(tmp_path / "run.nc").info["steps"] == summary["cost"]["steps"]


DRY = {"mechanism": "slider_crank", "joints": {"crank_pin": "dry"}, "revolutions": 0.1}


def run(**changes):
    return simulate(Scene.from_dict(DRY).replace(changes))


@pytest.mark.parametrize("setting", [{"solver.tolerance": 1e-4}, {"solver.step": 1e-5}], ids=str)
def test_a_budget_of_steps_ends_the_run_and_keeps_it(setting):
    result = run(**{"solver.max_steps": 100, **setting})
    assert result.info["status"] == "too many steps"
    assert re.fullmatch(
        r"100 steps were used up at t = \S+ s, crank angle \S+ deg, \S+% of the run; try fewer "
        r"revolutions, a larger solver\.(step|tolerance) or solver\.max_steps",
        result.info["reason"],
    ), result.info["reason"]
    assert not result.completed
    tries = result.info["steps"] + result.info["rejected_steps"]
    assert 100 <= tries < 110  # the step under way is finished, however often it is repeated
    assert len(result.time) == result.info["steps"] + 1
    json.dumps(result.summary(), allow_nan=False)


@PATCHED
def test_an_error_in_a_law_is_not_told_as_one_of_newton():
    model = Scene.from_dict(DRY).build()
    joint = model.clearance_joints["crank_pin"]
    right, calls = joint.add_force, itertools.count()

    def breaks(*state):
        if next(calls) > 50:
            raise ZeroDivisionError("in a law")
        right(*state)

    joint.add_force = breaks
    with pytest.raises(exu.ExudynError, match="USER FUNCTION"):
        model.solve()


def test_a_run_ends_where_what_watches_it_says_why():
    """What was computed until then is kept."""
    mbs, _ = pendulum()

    def late(time):
        return "late" if time >= 0.3 else ""

    outcome = solve_dynamic(mbs, settings(1.0), watch=late)
    assert (outcome.status, outcome.reason) == (SolverStatus.STALLED, "late")
    assert 0.3 <= outcome.end_time < 0.35


def test_a_script_that_looks_at_no_outcome_is_warned():
    with pytest.warns(UserWarning, match="too many steps: 20 steps were used up"):
        solve_dynamic(pendulum()[0], settings(1.0), max_steps=20)


def test_vibrations_below_an_absolute_tolerance_are_not_followed():
    """Beside a falling mass, at 1 m/s, another one vibrates at 5 mm/s and 300 Hz."""

    def run(absolute):
        mbs = exu.SystemContainer().AddSystem()
        falling = mbs.AddNode(items.NodePoint(initialVelocities=[0.0, -1.0, 0.0]))
        mbs.AddObject(items.ObjectMassPoint(nodeNumber=falling, mass=1.0))
        ends = mass_1d(mbs, 1.0, velocity=5e-3)
        stiffness = (2.0 * np.pi * 300.0) ** 2
        mbs.AddObject(
            items.ObjectConnectorCoordinateSpringDamper(markerNumbers=ends, stiffness=stiffness)
        )
        mbs.Assemble()
        outcome = solve_dynamic(mbs, settings(0.3), tolerance=1e-3, absolute=absolute).check()
        return outcome.steps, mbs.GetNodeOutput(falling, exu.OutputVariableType.Velocity)[1]

    followed, exact = run(0.0)
    steps, speed = run(0.1)
    assert steps < 0.05 * followed
    assert speed == pytest.approx(exact, rel=1e-3)


def test_a_motion_below_rounding_is_followed():
    """A mass a metre away vibrates at 1e-12 m/s and 5 Hz, which was taken for a rest."""

    def run(tolerance, steps):
        mbs = exu.SystemContainer().AddSystem()
        far = mbs.AddNode(items.NodePoint(referenceCoordinates=[1.0, 0.0, 0.0]))
        mbs.AddObject(items.ObjectMassPoint(nodeNumber=far, mass=1.0))
        node = mbs.AddNode(items.Node1D(referenceCoordinates=[0.0], initialVelocities=[1e-12]))
        mbs.AddObject(items.ObjectMass1D(mass=1.0, nodeNumber=node))
        ends = [
            mbs.AddMarker(items.MarkerNodeCoordinate(nodeNumber=number, coordinate=0))
            for number in (mbs.AddNode(items.NodePointGround()), node)
        ]
        stiffness = (2.0 * np.pi * 5.0) ** 2
        mbs.AddObject(
            items.ObjectConnectorCoordinateSpringDamper(markerNumbers=ends, stiffness=stiffness)
        )
        mbs.Assemble()
        solve_dynamic(mbs, settings(2.0, steps=steps), tolerance=tolerance)
        return mbs.GetNodeOutput(node, exu.OutputVariableType.Coordinates_t) / 1e-12

    assert run(1e-3, 20) == pytest.approx(1.0, abs=0.01)
    assert run(None, 4000) == pytest.approx(1.0, abs=0.02)
