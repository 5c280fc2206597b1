"""Modes of flexible bodies keep their pace, by a mass that fits the step."""

import math

import exudyn as exu
import exudyn.utilities as items
import numpy as np
import pytest
from stand_in_system import recorded, settings

from exu_press.integrate import SolverStatus, SolverTuning, solve_dynamic
from exu_press.integrate.modal_mass import follow_modes
from exu_press.integrate.system import modal_item

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
    sensor = recorded(mbs, modes, "Coordinates")
    mbs.Assemble()
    return mbs, sensor


def run(mbs, sensor, steps, tolerance=None, **numbers):
    """Time and the slow mode's coordinate over ten of its periods."""
    chosen = settings(10.0, steps, period=0.0, generalizedAlpha__spectralRadius=0.8)
    outcome = solve_dynamic(mbs, chosen, tolerance=tolerance, tuning=SolverTuning(**numbers))
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


@pytest.mark.parametrize("basis", [STRAIGHT, TURN @ np.diag([0.5, 3.0])])
def test_their_mass_takes_that_away(basis):
    coarse, fine = lag(200, basis), lag(400, basis)
    assert abs(fine) < 0.02 * lag(400, followed=False)
    assert coarse / fine == pytest.approx(16.0, rel=0.4)  # with the step's fourth power


def test_the_system_keeps_its_own_mass():
    mbs, sensor = vibrating(STRAIGHT)
    run(mbs, sensor, 100)
    matrix = mbs.GetObject(modal_item(mbs))["massMatrix"].Convert2DenseMatrix()
    assert not np.any(matrix)
