"""A step's first guess and Newton's matrix change only what a run costs; modes keep their pace."""

import math
from importlib.util import find_spec

import exudyn as exu
import exudyn.utilities as items
import numpy as np
import pytest
from patched import PATCHED

from exu_press import Scene, SolverStatus, SolverTuning, simulate, solve_dynamic
from exu_press.integrate import scheme
from exu_press.integrate.problem import modal_item
from exu_press.integrate.scheme import FlexibleJacobian, Newton, follow_modes
from exu_press.result import record
from exu_press.scene import flexible_press

NGSOLVE = pytest.mark.skipif(find_spec("ngsolve") is None, reason="flexible parts need NGSolve")


def tuned(scene, **numbers):
    model = scene.build()
    return record(model, model.solve(tuning=SolverTuning(**numbers)))


@PATCHED
@pytest.mark.parametrize("pin", ["lubricated", "dry"])
def test_expected_accelerations_save_iterations(pin, monkeypatch):
    scene = Scene(joints={"crank_pin": pin, "balls": "dry"}, revolutions=0.1, solver={"step": 5e-5})
    guided = simulate(scene)
    monkeypatch.setattr(Newton, "_advance", lambda guide, step: None)
    plain = simulate(scene)
    assert guided.info["newton_iterations"] < 0.7 * plain.info["newton_iterations"]
    apart = guided["slider_acceleration"] - plain["slider_acceleration"]
    assert np.abs(apart).max() < 1e-3 * np.abs(plain["slider_acceleration"]).max()


def test_what_rounding_leaves_is_not_iterated_on():
    """A film of 30 nm makes more of the last digit of a speed than the tolerance allows."""
    thin = Scene(
        film={"law": "pinkus"},
        joints={
            "crank_pin": {"kind": "lubricated", "clearance": 3e-8},
            "balls": {"kind": "dry", "clearance": 1e-4},
        },
        revolutions=0.02,
    )
    forgiving = simulate(thin)
    strict = tuned(thin, rounding=0.0)
    assert forgiving.completed
    assert not strict.completed


@NGSOLVE
def test_euler_parameters_are_expected_on_their_unit_sphere():
    """Else one iteration leaves something in the constraints, whose forces alternate."""
    run = simulate(
        Scene(
            bodies=flexible_press(modes=4),
            joints={"crank_pin": "ideal", "balls": "ideal"},
            revolutions=0.2,
        )
    )
    assert run.completed
    assert run.info["newton_iterations"] < 1.1 * run.info["steps"]
    force = np.linalg.norm(run.joints["counterweight_pin"].force, axis=1)
    assert np.abs(np.diff(force, 2)).max() < 0.02 * force.max()


@pytest.fixture
def flexible():
    return Scene(
        bodies=flexible_press(modes=4),
        joints={"crank_pin": "lubricated", "balls": "dry"},
        revolutions=0.1,
        solver={"tolerance": 0.01},
    )


@NGSOLVE
@PATCHED
def test_what_is_kept_differs_little_from_what_exudyn_differentiates(flexible, monkeypatch):
    """By what matters to Newton's method: the part of an error that its matrix would leave."""
    own, left = FlexibleJacobian._compute, []

    def compare(jacobian, solver, mbs, settings):
        size = solver.GetODE2size()
        mine = own(jacobian, solver, mbs, settings)
        matrix = np.array(solver.GetSystemJacobian())
        step = solver.it.currentStepSize
        by_q, by_q_t = solver.newmarkBeta * step**2, solver.newmarkGamma * step
        stiffness, damping = jacobian._bodies.reshape(2, size, size)
        with jacobian._joints.left_out():
            solver.ComputeJacobianODE2RHS(mbs, -by_q, -by_q_t)
        missing = np.zeros_like(matrix)
        missing[:size, :size] = by_q * stiffness + by_q_t * damping
        missing[:size, :size] -= np.array(solver.GetSystemJacobian())[:size, :size]
        solver.SetSystemJacobian(matrix)
        errors = np.linalg.eigvals(np.linalg.solve(matrix, missing))
        left.append(np.abs(errors).max())
        return mine

    monkeypatch.setattr(FlexibleJacobian, "_compute", compare)
    assert simulate(flexible).completed
    assert len(left) > 50
    assert max(left) < 0.02
    assert np.median(left) < 1e-4


@NGSOLVE
@PATCHED
def test_it_changes_the_cost_and_not_the_result(flexible, monkeypatch):
    kept = simulate(flexible)
    monkeypatch.setattr(scheme, "FlexibleJacobian", lambda task: None)
    stock = simulate(flexible)
    assert kept.completed and stock.completed
    peaks = [np.abs(run["slider_acceleration"]).max() for run in (kept, stock)]
    assert peaks[0] == pytest.approx(peaks[1], rel=0.02)
    iterations = [run.info["newton_iterations"] / run.info["steps"] for run in (kept, stock)]
    assert iterations[0] < 1.4 * iterations[1]


@NGSOLVE
def test_no_alternation_grows_from_what_newtons_method_leaves_in_the_constraints():
    """One iteration a step ends with the counterweight at +-11 m/s^2 about -10, and worse."""
    result = simulate(Scene(bodies=flexible_press(), joints={}, revolutions=0.55))
    assert result.completed, result.summary()["reason"]
    force = result["counterweight_pin_force"][:, 1]
    assert np.abs(np.diff(force, 2)).max() < 0.05 * np.abs(force).max()


@NGSOLVE
@PATCHED
def test_one_serves_several_steps_and_changes_no_answer(monkeypatch):
    made, own = [], FlexibleJacobian._compute

    def counted(*arguments):
        made[-1] += 1
        return own(*arguments)

    monkeypatch.setattr(FlexibleJacobian, "_compute", counted)
    runs = []
    for same in (-1.0, scheme.SAME):
        monkeypatch.setattr(scheme, "SAME", same)
        scene = Scene(bodies=flexible_press(modes=4), revolutions=0.15, solver={"tolerance": 3e-4})
        model = scene.build()
        made.append(0)
        runs.append(record(model, model.solve()))
    fresh, kept = runs
    assert made[0] >= fresh.info["steps"]
    assert made[1] < 0.6 * kept.info["steps"]
    assert kept.info["newton_iterations"] < 1.25 * fresh.info["newton_iterations"]
    forces = [np.abs(run.joints["crank_pin"].force).max() for run in runs]
    assert forces[1] == pytest.approx(forces[0], rel=2e-3)


OMEGA = np.array([2.0 * math.pi, 10.0 * math.pi])
STRAIGHT = np.eye(2)
TURN = np.array([[0.8, -0.6], [0.6, 0.8]])


def container(matrix):
    found = exu.MatrixContainer()
    found.SetWithDenseMatrix(matrix, useDenseMatrix=True)
    return found


def vibrating(basis, followed=True):
    """A free body with two modes that start bent, given in coordinates of a basis (2, 2)."""
    system = exu.SystemContainer()
    mbs = system.AddSystem()
    frame = mbs.AddNode(items.NodeRigidBodyEP(referenceCoordinates=[0, 0, 0, 1, 0, 0, 0]))
    start = np.linalg.solve(basis, [1e-3, 1e-3])
    modes = mbs.AddNode(
        items.NodeGenericODE2(
            referenceCoordinates=[0.0, 0.0],
            initialCoordinates=start.tolist(),
            initialCoordinates_t=[0.0, 0.0],
            numberOfODE2Coordinates=2,
        )
    )
    mbs.AddObject(
        items.ObjectFFRFreducedOrder(
            nodeNumbers=[frame, modes],
            massMatrixReduced=container(basis.T @ basis),
            stiffnessMatrixReduced=container(basis.T @ np.diag(OMEGA**2) @ basis),
            modeBasis=np.zeros((9, 2)),
            referencePositions=np.eye(3).ravel(),
            mass=1.0,
            inertia=np.eye(3),
            centerOfMass=[0.0, 0.0, 0.0],
            mPsiTildePsi=np.zeros((6, 2)),
            mPsiTildePsiTilde=np.zeros((6, 6)),
            mPhitTPsi=np.zeros((3, 2)),
            mPhitTPsiTilde=np.zeros((3, 6)),
            mXRefTildePsi=np.zeros((3, 2)),
            mXRefTildePsiTilde=np.zeros((3, 6)),
        )
    )
    if followed:
        follow_modes(mbs)
    sensor = mbs.AddSensor(
        items.SensorNode(
            nodeNumber=modes,
            storeInternal=True,
            outputVariableType=exu.OutputVariableType.Coordinates,
        )
    )
    mbs.Assemble()
    return mbs, sensor


def run(mbs, sensor, steps, tolerance=None, **numbers):
    """Time and the slow mode's coordinate over ten of its periods."""
    settings = exu.SimulationSettings()
    settings.timeIntegration.endTime = 10.0
    settings.timeIntegration.numberOfSteps = steps
    settings.timeIntegration.generalizedAlpha.spectralRadius = 0.8
    settings.solution.file.write, settings.solution.sensors.writePeriod = False, 0.0
    outcome = solve_dynamic(mbs, settings, tolerance=tolerance, tuning=SolverTuning(**numbers))
    assert outcome.status in (
        SolverStatus.COMPLETED,
        SolverStatus.UNDER_RESOLVED,
    )  # of the fast mode
    record = mbs.GetSensorStoredData(sensor)
    return record[:, 0], record[:, 1:]


def lag(steps, basis=STRAIGHT, **keys):
    """By how many radians the slow mode is behind in the last of ten periods."""
    mbs, sensor = vibrating(basis, keys.pop("followed", True))
    time, q = run(mbs, sensor, steps, **keys)
    slow = (q @ basis.T)[:, 0]
    late = time > 9.0
    angle = OMEGA[0] * time[late]
    columns = np.column_stack([np.cos(angle), np.sin(angle)])
    cosine, sine = np.linalg.lstsq(columns, slow[late], rcond=None)[0]
    return math.atan2(sine, cosine)


def test_generalized_alpha_alone_slows_modes_down():
    """By kappa (h omega)^2 / 2 with kappa = 1/6 + 3/4 / 81 at a spectral radius of 0.8."""
    x = 2.0 * math.pi / 40.0
    expected = 19.0 * math.pi * 0.5 * (1.0 / 6.0 + 0.75 / 81.0) * x * x
    assert lag(400, followed=False) == pytest.approx(expected, rel=0.05)
    assert lag(400, modal_mass=0.0) == pytest.approx(expected, rel=0.05)


@pytest.mark.parametrize("basis", [STRAIGHT, TURN @ np.diag([0.5, 3.0])])
def test_their_mass_takes_that_away(basis):
    coarse, fine = lag(200, basis), lag(400, basis)
    assert abs(fine) < 0.02 * lag(400, followed=False)
    assert coarse / fine == pytest.approx(16.0, rel=0.4)  # with the step's fourth power


def test_steps_that_follow_a_smooth_motion_leave_it():
    """Changes of step would take a tenth of a vibration in two hundred periods."""
    runs = [run(*vibrating(STRAIGHT, followed), 100, tolerance=0.1) for followed in (True, False)]
    assert np.array_equal(runs[0][1], runs[1][1])


def test_the_system_keeps_its_own_mass():
    mbs, sensor = vibrating(STRAIGHT)
    run(mbs, sensor, 100)
    matrix = mbs.GetObject(modal_item(mbs))["massMatrix"].Convert2DenseMatrix()
    assert not np.any(matrix)


def test_systems_without_modes_get_no_item():
    mbs = exu.SystemContainer().AddSystem()
    mbs.AddNode(items.NodePoint())
    follow_modes(mbs)
    assert modal_item(mbs) is None
    assert mbs.systemData.NumberOfObjects() == 0


def test_the_jacobian_of_a_large_system_is_kept():
    """A string of a hundred masses, whose force is a function: one Jacobian asks it 200 times."""
    mbs, count, asked = exu.SystemContainer().AddSystem(), 100, []

    def force(mbs, time, item, q, q_t):
        asked.append(time)
        q = np.concatenate([[0.0], q, [0.0]])
        return 1e4 * (q[:-2] - 2.0 * q[1:-1] + q[2:])

    shape = np.sin(np.pi * np.arange(1, count + 1) / (count + 1))
    node = mbs.AddNode(
        items.NodeGenericODE2(
            referenceCoordinates=np.zeros(count),
            initialCoordinates=shape,
            initialCoordinates_t=np.zeros(count),
            numberOfODE2Coordinates=count,
        )
    )
    mbs.AddObject(
        items.ObjectGenericODE2(
            nodeNumbers=[node], massMatrix=np.eye(count), forceUserFunction=force
        )
    )
    mbs.Assemble()
    settings = exu.SimulationSettings()
    settings.timeIntegration.endTime, settings.solution.file.write = 1.0, False
    outcome = solve_dynamic(mbs, settings, tolerance=1e-3)
    assert outcome.status is SolverStatus.COMPLETED, outcome.reason
    omega = 200.0 * math.sin(math.pi / (2.0 * (count + 1)))
    assert mbs.systemData.GetODE2Coordinates() == pytest.approx(shape * math.cos(omega), abs=2e-3)
    assert len(asked) < 60 * outcome.steps
