"""The body in Exudyn: frequencies, damping, energy and momentum, markers, the rigid limit."""

import exudyn as exu
import numpy as np
import pytest
from exudyn.itemInterface import (
    SensorNode,
)
from stand_in_system import settings

from fe_models import Reduction, add_flexible_body
from fe_models.errors import InputError
from fe_models.reduction import _craig_bampton_basis, _orthogonalise, reduce_model

OUTPUT = exu.OutputVariableType


def fixed_steps(end, step):
    """Return settings without numerical damping that record every step."""
    chosen = settings(
        end, round(end / step), step, generalizedAlpha__spectralRadius=1.0,
        newton__relativeTolerance=1e-10, newton__absoluteTolerance=1e-12, verboseMode=0,
    )  # fmt: skip
    chosen.linearSolver.solverType = exu.LinearSolverType.EigenSparse
    return chosen


def system():
    container = exu.SystemContainer()
    return container, container.AddSystem()


@pytest.mark.parametrize("mode", [0, 19])
def test_every_mode_decays_with_two_per_cent(reduced_bar, mode):
    period = 1.0 / reduced_bar.frequencies[mode]
    start = np.zeros(20)
    start[mode] = 1e-4
    _, mbs = system()
    body = add_flexible_body(mbs, reduced_bar, initial_modes=start)
    sensor = mbs.AddSensor(
        SensorNode(
            nodeNumber=body.node_modes, outputVariableType=OUTPUT.Coordinates, storeInternal=True
        )
    )
    mbs.Assemble()
    mbs.SolveDynamic(fixed_steps(6 * period, period / 120))
    q = mbs.GetSensorStoredData(sensor)[:, 1 + mode]
    peaks = np.flatnonzero((q[1:-1] > q[:-2]) & (q[1:-1] > q[2:])) + 1
    decrement = np.log(q[peaks[0]] / q[peaks[-1]]) / (len(peaks) - 1)
    assert decrement / np.hypot(2 * np.pi, decrement) == pytest.approx(0.02, rel=1e-3)


def energy_and_momenta(mbs, body, model, modes):
    """From the full model: kinetic + strain energy, linear and angular momentum."""
    q = mbs.GetNodeOutput(body.node_modes, OUTPUT.Coordinates)
    q_t = mbs.GetNodeOutput(body.node_modes, OUTPUT.Coordinates_t)
    turn = np.reshape(mbs.GetNodeOutput(body.node_rigid, OUTPUT.RotationMatrix), (3, 3))
    place = np.array(mbs.GetNodeOutput(body.node_rigid, OUTPUT.Position))
    speed = np.array(mbs.GetNodeOutput(body.node_rigid, OUTPUT.Velocity))
    spin = np.array(mbs.GetNodeOutput(body.node_rigid, OUTPUT.AngularVelocityLocal))
    local = model.nodes + (modes @ q).reshape(-1, 3)
    positions = place + local @ turn.T
    velocities = speed + (np.cross(spin, local) + (modes @ q_t).reshape(-1, 3)) @ turn.T
    momenta = model.nodal_mass @ velocities
    strain = 0.5 * ((2 * np.pi * body.reduced.frequencies * q) ** 2).sum()
    energy = 0.5 * (velocities * momenta).sum() + strain
    return energy, momenta.sum(axis=0), np.cross(positions, momenta).sum(axis=0)


def test_free_spinning_body_keeps_energy_and_momentum(bar, bar_model, reduced_bar):
    basis, *_ = _craig_bampton_basis(bar, bar_model, 20)
    _, modes = _orthogonalise(bar_model, basis, 20)
    drifts = []
    for step in (1e-5, 5e-6):
        _, mbs = system()
        body = add_flexible_body(
            mbs,
            reduced_bar,
            velocity=(1, 2, 3),
            angular_velocity=(40, 0, 60),
            damping_ratio=0.0,
            initial_modes=np.eye(20)[0] * 5e-5,
        )
        mbs.Assemble()
        before = energy_and_momenta(mbs, body, bar_model, modes)
        mbs.SolveDynamic(fixed_steps(2e-3, step))
        after = energy_and_momenta(mbs, body, bar_model, modes)
        drifts.append(
            [
                np.linalg.norm(np.subtract(b, a)) / np.linalg.norm(a)
                for a, b in zip(before, after, strict=True)
            ]
        )
    assert max(drifts[1]) < 1e-6, drifts
    # second order: halving the step takes the drift to a quarter
    assert np.array(drifts[0]) / np.array(drifts[1]) == pytest.approx([4.0] * 3, rel=0.15)


@pytest.mark.parametrize("modes", [0, 20])
def test_a_free_body_falls_undeformed_and_without_modes_it_is_rigid(
    bar, bar_model, reduced_bar, modes
):
    reduced = reduced_bar if modes else reduce_model(bar, bar_model, Reduction(modes=0))
    _, mbs = system()
    body = add_flexible_body(mbs, reduced, gravity=(0, -9.81, 0), position=(0, 1, 0))
    end = body.add_marker(mbs, "right")
    mbs.Assemble()
    assert (body.node_modes is None) == (modes == 0)
    assert mbs.GetMarkerOutput(end, OUTPUT.Position) == pytest.approx([0.3, 1.025, 0.015])
    mbs.SolveDynamic(fixed_steps(0.1, 1e-3))
    fallen = mbs.GetNodeOutput(body.node_rigid, OUTPUT.Position)
    assert fallen == pytest.approx([0, 1 - 0.5 * 9.81 * 0.01, 0], abs=1e-9)
    if modes:
        q = mbs.GetNodeOutput(body.node_modes, OUTPUT.Coordinates)
        assert q == pytest.approx(0.0, abs=1e-9)


def test_a_marker_moves_with_pose_modes_and_offset(reduced_bar):
    """p + A (centre + translation q + offset), but for the turn of the face by the modes."""
    q = 1e-6 * np.random.default_rng(3).standard_normal(20)
    turn = np.array([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])
    end, offset = reduced_bar.interface("right"), np.array([0.0, 0.2, 0.1])
    pose = {"position": (1, 0, 0), "rotation": turn, "angular_velocity": (0, 0, 25.0)}
    _, mbs = system()
    body = add_flexible_body(mbs, reduced_bar, initial_modes=q, **pose)
    markers = body.add_marker(mbs, "right"), body.add_marker(mbs, "right", offset=offset)
    mbs.Assemble()
    centre = end.centre + end.translation @ q
    for marker, local, bound in zip(markers, (centre, centre + offset), (1e-12, 1e-4), strict=True):
        place = mbs.GetMarkerOutput(marker, OUTPUT.Position, exu.ConfigurationType.Initial)
        assert place == pytest.approx([1, 0, 0] + turn @ local, abs=bound)
        velocity = mbs.GetMarkerOutput(marker, OUTPUT.Velocity, exu.ConfigurationType.Initial)
        assert velocity == pytest.approx(np.cross([0, 0, 25.0], turn @ local), abs=25.0 * bound)


def test_bad_input(reduced_bar):
    _, mbs = system()
    with pytest.raises(InputError, match="initial modal values"):
        add_flexible_body(mbs, reduced_bar, initial_modes=[1.0])
    with pytest.raises(InputError, match="damping_ratio"):
        add_flexible_body(mbs, reduced_bar, damping_ratio=-0.1)
    body = add_flexible_body(mbs, reduced_bar)
    with pytest.raises(InputError, match="no interface 'web'"):
        body.add_marker(mbs, "web")
