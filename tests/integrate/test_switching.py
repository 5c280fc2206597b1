"""What functions of the user's own switch between two steps: constraints, forces, springs."""

import exudyn as exu
import exudyn.utilities as items
import numpy as np
import pytest
from patched import PATCHED

from exu_press import SolverStatus, solve_dynamic
from exu_press.integrate.beginnings import Beginnings
from exudyn_examples.example import GRAVITY
from exudyn_examples.flexible import hold
from exudyn_examples.other import mass_1d
from exudyn_examples.planar import rods

SWITCHED_AT = 0.3337  # s
MASSES, SPEED = (1.0, 2.0), 5.0


def settings(steps=100):
    chosen = exu.SimulationSettings()
    chosen.timeIntegration.endTime, chosen.timeIntegration.numberOfSteps = 1.0, steps
    chosen.timeIntegration.generalizedAlpha.spectralRadius = 0.8
    chosen.solution.file.write, chosen.solution.sensors.writePeriod = False, 0.01
    return chosen


def sliding(masses, speeds):
    """Masses on a line, and their nodes."""
    mbs = exu.SystemContainer().AddSystem()
    nodes = [
        mbs.AddNode(items.Node1D(referenceCoordinates=[0.0], initialVelocities=[speed]))
        for speed in speeds
    ]
    for node, mass in zip(nodes, masses, strict=True):
        mbs.AddObject(items.ObjectMass1D(nodeNumber=node, mass=mass))
    return mbs, nodes


def clutch(function, *, engaged=False):
    """Two masses on a line, the first of which moves, and what couples their velocities."""
    mbs, nodes = sliding(MASSES, (SPEED, 0.0))
    ends = [
        mbs.AddMarker(items.MarkerNodeCoordinate(nodeNumber=node, coordinate=0)) for node in nodes
    ]
    coupling = mbs.AddObject(
        items.ObjectConnectorCoordinate(
            markerNumbers=ends, velocityLevel=True, activeConnector=engaged
        )
    )

    def engage(mbs, time):
        mbs.SetObjectParameter(coupling, "activeConnector", time >= SWITCHED_AT)
        return True

    getattr(mbs, function)(engage)
    first = mbs.AddSensor(
        items.SensorNode(
            nodeNumber=nodes[0],
            storeInternal=True,
            outputVariableType=exu.OutputVariableType.Coordinates_t,
        )
    )
    mbs.Assemble()
    return mbs, first


@pytest.mark.parametrize("function", ["SetPreStepUserFunction", "SetPostStepUserFunction"])
@pytest.mark.parametrize("tolerance", [1e-2, 1e-3, 1e-4])
def test_a_clutch_keeps_the_momentum(function, tolerance):
    mbs, _ = clutch(function)
    outcome = solve_dynamic(mbs, settings(), tolerance=tolerance)
    assert outcome.status is SolverStatus.COMPLETED, outcome.reason
    together = MASSES[0] * SPEED / sum(MASSES)
    found = mbs.systemData.GetODE2Coordinates_t()
    assert found == pytest.approx([together, together], rel=1e-9)


def test_a_constraint_that_is_off_from_the_first_call_on_holds_nothing():
    """It is not what the start has to fit: the masses have their velocities from then on."""
    mbs, first = clutch("SetPreStepUserFunction", engaged=True)
    outcome = solve_dynamic(mbs, settings())
    assert outcome.status is SolverStatus.COMPLETED, outcome.reason
    time, speed = mbs.GetSensorStoredData(first).T
    assert speed[time < SWITCHED_AT - 0.01] == pytest.approx(SPEED, rel=1e-9)
    assert speed[-1] == pytest.approx(MASSES[0] * SPEED / sum(MASSES), rel=1e-9)


@pytest.mark.parametrize("slowed", [1e-1, 1e-2, 7e-3, 2e-3])
def test_a_brake_may_meet_a_slow_motion(slowed):
    """By so much that a step fails, or by a little more or less than it may miss."""
    mbs, nodes = sliding((1.0, 1.0), (SPEED, slowed * SPEED))
    (brake,) = hold(mbs, nodes[1], (0,), velocityLevel=True, activeConnector=False)

    def before_step(mbs, time):
        mbs.SetObjectParameter(brake, "activeConnector", time >= SWITCHED_AT)
        return True

    mbs.SetPreStepUserFunction(before_step)
    mbs.Assemble()
    outcome = solve_dynamic(mbs, settings())
    assert outcome.status is SolverStatus.COMPLETED, outcome.reason
    assert mbs.systemData.GetODE2Coordinates_t() == pytest.approx([SPEED, 0.0], abs=1e-3 * SPEED)


def test_a_function_that_switches_nothing_costs_nothing():
    """Where a step fails behind its call, and Newton's matrix is kept from step to step."""
    tries = []
    for function in (0, lambda mbs, time: True):
        mbs = exu.SystemContainer().AddSystem()
        _, _, (node,), _ = rods(mbs, (1.0,))
        ends = [
            mbs.AddMarker(items.MarkerNodeCoordinate(nodeNumber=number, coordinate=coordinate))
            for number, coordinate in ((mbs.AddNode(items.NodePointGround()), 0), (node, 2))
        ]

        def stop(mbs, time, item, angle, rate, *others):
            return 1e5 * min(angle + 0.5, 0.0) + 10.0 * rate * (angle < -0.5)

        spring = items.ObjectConnectorCoordinateSpringDamper
        mbs.AddObject(spring(markerNumbers=ends, springForceUserFunction=stop))
        mbs.SetPreStepUserFunction(function)
        mbs.Assemble()
        outcome = solve_dynamic(mbs, settings())
        assert outcome.status is SolverStatus.COMPLETED, outcome.reason
        tries.append(outcome.steps + outcome.rejected_steps)
    assert tries[1] < 1.2 * tries[0]


def breaks(mbs, ground, bodies, nodes, joints):
    """The joint between them."""
    return lambda mbs, late: mbs.SetObjectParameter(joints[1], "activeConnector", not late)


def locks(mbs, ground, bodies, nodes, joints):
    """The first one stands still from then on."""
    (lock,) = hold(mbs, nodes[0], (2,), velocityLevel=True, activeConnector=False)
    return lambda mbs, late: mbs.SetObjectParameter(lock, "activeConnector", late)


def latches(mbs, ground, bodies, nodes, joints):
    """The first one is held where it is by then."""
    (latch,) = hold(mbs, nodes[0], (2,), activeConnector=False)

    def catch(mbs, late):
        if late and not mbs.GetObjectParameter(latch, "activeConnector"):
            place = mbs.systemData.GetODE2Coordinates()[2]
            mbs.SetObjectParameter(latch, "offset", place)
            mbs.SetObjectParameter(latch, "activeConnector", True)

    return catch


def springs(mbs, ground, bodies, nodes, joints):
    """A spring holds the end of the second one from then on."""
    ends = [
        mbs.AddMarker(items.MarkerBodyPosition(bodyNumber=body, localPosition=place))
        for body, place in ((ground, [2.0, 1.0, 0.0]), (bodies[1], [0.5, 0.0, 0.0]))
    ]
    spring = items.ObjectConnectorSpringDamper(
        markerNumbers=ends, stiffness=200.0, damping=1.0, referenceLength=0.5, activeConnector=False
    )
    spring = mbs.AddObject(spring)
    return lambda mbs, late: mbs.SetObjectParameter(spring, "activeConnector", late)


def turns(mbs, ground, bodies, nodes, joints):
    """Their weights."""
    return lambda mbs, late: [
        mbs.SetLoadParameter(load, "loadVector", [0.0, GRAVITY if late else -GRAVITY, 0.0])
        for load in (0, 1)
    ]


@pytest.mark.filterwarnings("error::UserWarning")
@pytest.mark.parametrize("hold", [False, True])
@pytest.mark.parametrize(
    ("what", "most"), [(breaks, 120), (locks, 170), (latches, 130), (springs, 300), (turns, 125)]
)
def test_what_a_function_switches_costs_few_steps(what, most, hold):
    """Within ten of them; what it was before rings on in the accelerations otherwise."""
    speeds = []
    for tolerance in (1e-6, 1e-2):
        mbs = exu.SystemContainer().AddSystem()
        switch = what(mbs, *rods(mbs, (1.0, 1.0)))

        def before_step(mbs, time, switch=switch):
            switch(mbs, time >= SWITCHED_AT)
            return True

        mbs.SetPreStepUserFunction(before_step)
        mbs.Assemble()
        outcome = solve_dynamic(mbs, settings(), tolerance=tolerance, hold=hold)
        assert outcome.status is SolverStatus.COMPLETED, outcome.reason
        speeds.append(mbs.systemData.GetODE2Coordinates_t())
    assert outcome.steps + outcome.rejected_steps < most
    largest = np.abs(speeds[0]).max()
    assert speeds[1] == pytest.approx(speeds[0], abs=1e-2 * largest)


@PATCHED
def test_the_motion_begins_anew_from_the_end_of_the_last_step(monkeypatch):
    """Where the step that failed was longer, and so had begun with a shifted state."""
    mbs, ends, off = exu.SystemContainer().AddSystem(), [], []
    switch = springs(mbs, *rods(mbs, (1.0, 1.0)))
    fit_anew = Beginnings.fit_anew

    def state(mbs):
        data = mbs.systemData
        return np.array([data.GetODE2Coordinates(), data.GetODE2Coordinates_t()])

    def watched(beginnings, time):
        off.append(np.abs(state(mbs) - ends[-1]).max())
        return fit_anew(beginnings, time)

    def before_step(mbs, time):
        switch(mbs, int(time / 0.13) % 2 == 1)
        return True

    monkeypatch.setattr(Beginnings, "fit_anew", watched)
    mbs.SetPreStepUserFunction(before_step)
    mbs.SetPostStepUserFunction(lambda mbs, time: ends.append(state(mbs)) or True)
    mbs.Assemble()
    outcome = solve_dynamic(mbs, settings(10), tolerance=1e-2, sample=0.01)
    assert outcome.status is SolverStatus.COMPLETED, outcome.reason
    assert len(off) > 5 and max(off) == 0.0


def servo():
    """A bar in space that a stiff servo holds where a function asks for it, and as fast."""
    mbs = exu.SystemContainer().AddSystem()
    body = mbs.CreateRigidBody(
        inertia=items.InertiaCuboid(1000.0, [0.5, 0.05, 0.05]),
        referencePosition=[0.25, 0.0, 0.0],
        gravity=[0.0, 0.0, -GRAVITY],
    )
    ground = mbs.CreateGround()
    mbs.CreateRevoluteJoint(itemNumbers=[ground, body], axis=[0.0, 1.0, 0.0], position=[0, 0, 0])
    turned = np.array([[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]])  # about its z-axis
    ends = [
        mbs.AddMarker(
            items.MarkerBodyRigid(
                bodyNumber=number, localHT=exu.HT(rotation=turned, translation=[place, 0.0, 0.0])
            )
        )
        for number, place in ((ground, 0.0), (body, -0.25))
    ]
    data = items.NodeGenericData(initialCoordinates=[0.0], numberOfDataCoordinates=1)
    number = mbs.AddNode(data)
    holds = items.TorsionalSpringDamper(
        markerNumbers=ends, nodeNumber=number, stiffness=4e3, damping=40.0
    )
    holds = mbs.AddObject(holds)

    def ask(mbs, time):
        mbs.SetObjectParameter(holds, "offset", 1.0 - np.cos(4.0 * time))
        mbs.SetObjectParameter(holds, "velocityOffset", 4.0 * np.sin(4.0 * time))
        return True

    mbs.SetPreStepUserFunction(ask)
    mbs.Assemble()
    return mbs


def of_servo(steps=100):
    chosen = settings(steps)
    chosen.timeIntegration.endTime = 0.2
    return chosen


def test_servos_that_push_a_jump_at_every_call():
    """They follow a staircase.

    Positions that Newton's method leaves off the hinge by 1e-10 m would be a jolt beside steps as
    short as what a jump leaves takes to decay.
    """
    outcome = solve_dynamic(servo(), of_servo(), tolerance=1e-2, hold=True)
    assert outcome.status is SolverStatus.COMPLETED, outcome.reason
    assert outcome.steps + outcome.rejected_steps < 1500


@pytest.mark.filterwarnings("error::UserWarning")
@pytest.mark.parametrize("sample", [None, 0.0])
def test_servos_follow_a_trajectory_without_stairs(sample):
    """Where its function is called for the end of each step, and where numbers go over."""
    fine, run = servo(), servo()
    fine.SolveDynamic(of_servo(5_000))
    outcome = solve_dynamic(run, of_servo(), sample=sample)
    assert outcome.status is SolverStatus.COMPLETED, outcome.reason
    assert outcome.steps + outcome.rejected_steps < 700
    expected = fine.systemData.GetODE2Coordinates_t()
    largest = np.abs(expected).max()
    assert run.systemData.GetODE2Coordinates_t() == pytest.approx(expected, abs=1e-3 * largest)


def test_stairs_of_what_no_one_sees_are_told():
    """A spring's own function reads where a pre-step function wants its end."""
    mbs = exu.SystemContainer().AddSystem()
    ends = mass_1d(mbs, 1.0)

    def pull(mbs, time, item, place, rate, *others):
        return 1e4 * (place - mbs.variables["wanted"]) + 40.0 * rate

    spring = items.ObjectConnectorCoordinateSpringDamper
    mbs.AddObject(spring(markerNumbers=ends, springForceUserFunction=pull))
    mbs.variables["wanted"] = 0.0

    def ask(mbs, time):
        mbs.variables["wanted"] = 1.0 - np.cos(4.0 * time)
        return True

    mbs.SetPreStepUserFunction(ask)
    mbs.Assemble()
    with pytest.warns(UserWarning, match=r"in \d+ of 100 calls .* forces jump.*sample=0.0"):
        outcome = solve_dynamic(mbs, settings(), tolerance=1e-3)
    assert outcome.status is SolverStatus.COMPLETED, outcome.reason
