"""The body in Exudyn: frequencies, damping, energy and momentum, markers, the rigid limit."""

import exudyn as exu
import numpy as np
import pytest
from exudyn.itemInterface import (
    LoadForceVector,
    LoadTorqueVector,
    MarkerNodeRigid,
    ObjectJointGeneric,
    SensorNode,
    SensorSuperElement,
)

from fe_models import Reduction, add_flexible_body
from fe_models.errors import InputError
from fe_models.reduction import _craig_bampton_basis, _orthogonalise, reduce_model

OUTPUT = exu.OutputVariableType


def settings(end, step):
    s = exu.SimulationSettings()
    s.timeIntegration.endTime = end
    s.timeIntegration.numberOfSteps = round(end / step)
    s.timeIntegration.generalizedAlpha.spectralRadius = 1.0
    s.timeIntegration.newton.relativeTolerance = 1e-10
    s.timeIntegration.newton.absoluteTolerance = 1e-12
    s.timeIntegration.verboseMode = 0
    s.solution.file.write = False
    s.solution.sensors.writePeriod = step
    s.linearSolver.solverType = exu.LinearSolverType.EigenSparse
    return s


def system():
    container = exu.SystemContainer()
    return container, container.AddSystem()


@pytest.mark.parametrize("which", ["crank", "linkage"])
def test_frequencies_of_the_body_are_ngsolves(which, request):
    part = request.getfixturevalue(f"reduced_{which}")
    _, mbs = system()
    add_flexible_body(mbs, part, position=(0.1, 0.2, 0.3))
    mbs.Assemble()
    values = mbs.ComputeODE2Eigenvalues(useAbsoluteValues=True)[0]
    found = np.sqrt(np.sort(values)) / (2 * np.pi)
    assert found[-20:] == pytest.approx(part.frequencies, rel=1e-9)
    assert np.all(found[:-20] < 1e-3)


@pytest.mark.parametrize("mode", [0, 3, 10, 19])
def test_every_mode_decays_with_two_per_cent(reduced_crank, mode):
    period = 1.0 / reduced_crank.frequencies[mode]
    start = np.zeros(20)
    start[mode] = 1e-4
    _, mbs = system()
    body = add_flexible_body(mbs, reduced_crank, initial_modes=start)
    sensor = mbs.AddSensor(
        SensorNode(
            nodeNumber=body.node_modes, outputVariableType=OUTPUT.Coordinates, storeInternal=True
        )
    )
    mbs.Assemble()
    mbs.SolveDynamic(settings(6 * period, period / 120))
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


@pytest.mark.parametrize(
    "rotation", ["euler_parameters", pytest.param("rotation_vector", marks=pytest.mark.long)]
)
def test_free_spinning_body_keeps_energy_and_momentum(crank, crank_model, reduced_crank, rotation):
    basis, *_ = _craig_bampton_basis(crank, crank_model, 20)
    _, modes = _orthogonalise(crank_model, basis, 20)
    drifts = []
    for step in (8e-5, 4e-5):
        _, mbs = system()
        body = add_flexible_body(
            mbs,
            reduced_crank,
            velocity=(1, 2, 3),
            angular_velocity=(40, 0, 60),
            rotation_parameters=rotation,
            damping_ratio=0.0,
            initial_modes=np.eye(20)[0] * 5e-4,
        )
        mbs.Assemble()
        before = energy_and_momenta(mbs, body, crank_model, modes)
        mbs.SolveDynamic(settings(0.02, step))
        after = energy_and_momenta(mbs, body, crank_model, modes)
        drifts.append(
            [
                np.linalg.norm(np.subtract(b, a)) / np.linalg.norm(a)
                for a, b in zip(before, after, strict=True)
            ]
        )
    assert max(drifts[1]) < 1e-6, drifts
    # second order: halving the step takes the drift to a quarter
    assert np.array(drifts[0]) / np.array(drifts[1]) == pytest.approx([4.0] * 3, rel=0.15)


def hang(mbs, part, load_face, held_face, **keys):
    """Hold a body at one interface, load it at another; return the loaded marker."""
    body = add_flexible_body(mbs, part, **keys)
    ground = mbs.CreateGround()
    from exudyn.itemInterface import MarkerBodyRigid

    at = mbs.AddMarker(
        MarkerBodyRigid(bodyNumber=ground, localPosition=part.interface(held_face).centre)
    )
    mbs.AddObject(ObjectJointGeneric(markerNumbers=[at, body.add_marker(mbs, held_face)]))
    return body, body.add_marker(mbs, load_face)


def test_static_deflection_at_a_marker_is_the_full_models(linkage, linkage_model, reduced_linkage):
    from fe_models.reduction import interface_rows
    from fe_models.saddle import SaddleSolver

    force = np.array([1e2, 2e2, 5e1])
    _, mbs = system()
    body, small = hang(mbs, reduced_linkage, "small bore", "big bore")
    mbs.AddLoad(LoadForceVector(markerNumber=small, loadVector=list(force)))
    mbs.AddLoad(LoadTorqueVector(markerNumber=small, loadVector=[0, 3.0, 5.0]))
    mbs.Assemble()
    before = np.array(mbs.GetMarkerOutput(small, OUTPUT.Position))
    s = exu.SimulationSettings()
    s.staticSolver.verboseMode = 0
    s.staticSolver.newton.relativeTolerance = 1e-10
    s.staticSolver.newton.absoluteTolerance = 1e-12
    s.solution.file.write = False
    s.linearSolver.solverType = exu.LinearSolverType.EigenSparse
    mbs.SolveStatic(s)
    moved = np.array(mbs.GetMarkerOutput(small, OUTPUT.Position)) - before
    rows = interface_rows(linkage, linkage_model)
    solver = SaddleSolver(linkage_model, rows[:6])
    load = rows[6:].T @ np.concatenate([force, [0, 3.0, 5.0]])
    full = rows[6:9] @ solver.solve(load, None)
    assert moved == pytest.approx(full, rel=1e-4)  # the rest: large rotations in Exudyn
    assert body.virtual_nodes["small bore"][0] - body.virtual_nodes["big bore"][0] == 3


@pytest.mark.parametrize("modes", [0, 20])
def test_a_free_body_falls_undeformed_and_without_modes_it_is_rigid(
    crank, crank_model, reduced_crank, modes
):
    reduced = reduced_crank if modes else reduce_model(crank, crank_model, Reduction(modes=0))
    _, mbs = system()
    body = add_flexible_body(mbs, reduced, gravity=(0, -9.81, 0), position=(0, 1, 0))
    pin = body.add_marker(mbs, "pin")
    mbs.Assemble()
    assert (body.node_modes is None) == (modes == 0)
    assert mbs.GetMarkerOutput(pin, OUTPUT.Position) == pytest.approx([0, 1.03, 0], abs=1e-5)
    mbs.SolveDynamic(settings(0.1, 1e-3))
    fallen = mbs.GetNodeOutput(body.node_rigid, OUTPUT.Position)
    assert fallen == pytest.approx([0, 1 - 0.5 * 9.81 * 0.01, 0], abs=1e-9)
    if modes:
        q = mbs.GetNodeOutput(body.node_modes, OUTPUT.Coordinates)
        assert q == pytest.approx(0.0, abs=1e-9)


def test_marker_moves_with_the_pose_and_offset(reduced_crank):
    turn = np.array([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])
    _, mbs = system()
    body = add_flexible_body(
        mbs, reduced_crank, position=(1, 0, 0), rotation=turn, angular_velocity=(0, 0, 25.0)
    )
    pin = body.add_marker(mbs, "pin", offset=(0.0, 0.0, 0.01))
    mbs.Assemble()
    expected = np.array([1, 0, 0]) + turn @ [0, 0.03, 0.01]
    assert mbs.GetMarkerOutput(pin, OUTPUT.Position) == pytest.approx(expected, abs=1e-5)
    velocity = np.cross([0, 0, 25.0], expected - [1, 0, 0])
    found = mbs.GetMarkerOutput(pin, OUTPUT.Velocity, exu.ConfigurationType.Initial)
    assert found == pytest.approx(velocity, abs=1e-4)


def test_marker_motion_is_the_modal_rows(reduced_linkage):
    """The formula in the README: p + A (centre + translation q)."""
    q = 1e-4 * np.random.default_rng(3).standard_normal(20)
    _, mbs = system()
    body = add_flexible_body(mbs, reduced_linkage, initial_modes=q)
    small = body.add_marker(mbs, "small bore")
    mbs.Assemble()
    bore = reduced_linkage.interface("small bore")
    found = mbs.GetMarkerOutput(small, OUTPUT.Position, exu.ConfigurationType.Initial)
    assert found == pytest.approx(bore.centre + bore.translation @ q, abs=1e-12)


def test_bad_input(reduced_crank):
    _, mbs = system()
    with pytest.raises(InputError, match="rotation_parameters"):
        add_flexible_body(mbs, reduced_crank, rotation_parameters="tait_bryan")
    with pytest.raises(InputError, match="initial modal values"):
        add_flexible_body(mbs, reduced_crank, initial_modes=[1.0])
    with pytest.raises(InputError, match="damping_ratio"):
        add_flexible_body(mbs, reduced_crank, damping_ratio=-0.1)
    body = add_flexible_body(mbs, reduced_crank)
    with pytest.raises(InputError, match="no interface 'web'"):
        body.add_marker(mbs, "web")


def test_a_mass_can_hang_on_an_interface(reduced_linkage):
    """Markers carry joints to other bodies, not loads alone."""
    from exudyn.itemInterface import NodeRigidBodyEP, ObjectRigidBody

    _, mbs = system()
    body = add_flexible_body(mbs, reduced_linkage)
    centre = list(reduced_linkage.interface("small bore").centre)
    node = mbs.AddNode(NodeRigidBodyEP(referenceCoordinates=[*centre, 1, 0, 0, 0]))
    mbs.AddObject(ObjectRigidBody(nodeNumber=node, mass=5.0, inertia=[0.1, 0.1, 0.1, 0, 0, 0]))
    markers = [body.add_marker(mbs, "small bore"), mbs.AddMarker(MarkerNodeRigid(nodeNumber=node))]
    mbs.AddObject(ObjectJointGeneric(markerNumbers=markers))
    load = mbs.AddMarker(MarkerNodeRigid(nodeNumber=node))
    mbs.AddLoad(LoadForceVector(markerNumber=load, loadVector=[0, 1000.0, 0]))
    mbs.Assemble()
    mbs.SolveDynamic(settings(2e-3, 1e-5))
    at = np.array(mbs.GetMarkerOutput(markers[0], OUTPUT.Position))
    assert mbs.GetMarkerOutput(markers[1], OUTPUT.Position) == pytest.approx(at, abs=1e-10)
    assert at[1] > 0.0


def test_exudyns_stress_is_ours(reduced_linkage):
    """SensorSuperElement at a surface node against ReducedPart.stress: xx yy zz yz xz xy."""
    q = 1e-4 * np.random.default_rng(5).standard_normal(20)
    _, mbs = system()
    body = add_flexible_body(mbs, reduced_linkage, initial_modes=q)
    sensor = mbs.AddSensor(
        SensorSuperElement(
            bodyNumber=body.object_number,
            meshNodeNumber=17,
            outputVariableType=OUTPUT.StressLocal,
            storeInternal=True,
        )
    )
    mbs.Assemble()
    mbs.systemData.SetODE2Coordinates(
        mbs.systemData.GetODE2Coordinates(exu.ConfigurationType.Initial)
    )
    found = mbs.GetSensorValues(sensor)
    ours = (reduced_linkage.stress @ q).reshape(-1, 6)[17]
    assert np.asarray(found) == pytest.approx(ours, rel=1e-9)
