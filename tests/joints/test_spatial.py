"""Clearance joints between bodies in space: equal to the plane's, momentum, Jacobian."""

import functools

import exudyn as exu
import numpy as np
import pytest
from differences import assert_partials, forces
from exudyn.itemInterface import (
    NodeRigidBodyEP,
    NodeRigidBodyRotVecLG,
    NodeRigidBodyRxyz,
    ObjectGround,
    ObjectRigidBody,
)
from solving import fixed_steps, solve
from stand_in_system import planar_body, recorded

from exu_press import (
    InputError,
    add_dry_revolute,
    add_dry_spherical,
    add_joint_sensor,
    add_lubricated_revolute,
    add_lubricated_spherical,
)
from exu_press.joints import user_force_of
from exu_press.joints.spherical_film import SphericalFilm
from exu_press.laws.contact import hertz, step_damping
from exu_press.laws.film import pi_film
from exu_press.laws.film.ball import ball
from exu_press.laws.friction import LuGre, lugre_steady

NODES = {"EP": NodeRigidBodyEP, "Rxyz": NodeRigidBodyRxyz, "RotVecLG": NodeRigidBodyRotVecLG}
CONTACT = step_damping(hertz(1e9), 1e4, 1e-4)
FRICTION = lugre_steady(0.3, 0.2, 0.0, 0.01, 2.0, 1e-3)
JOINTS = {
    "dry": (add_dry_revolute, {"contact": CONTACT, "friction": FRICTION}),
    "lubricated": (add_lubricated_revolute, {"length": 0.1, "viscosity": 0.05, "law": pi_film()}),
    "spherical": (add_dry_spherical, {"contact": CONTACT, "friction": FRICTION}),
    "lubricated ball": (add_lubricated_spherical, {"viscosity": 0.05, "film": ball()}),
    "mixed ball": (
        add_lubricated_spherical,
        {
            "viscosity": 0.01,
            "film": ball(1.2, 0.3),
            "asperity_onset": 3e-4,
            "contact": CONTACT,
            "friction": FRICTION,
        },
    ),
}
PAIRS = [("EP", joint) for joint in JOINTS] + [("Rxyz", "dry"), ("RotVecLG", "dry")]
"""Each joint, and each kind of node: neither asks which the other is."""
MASS, INERTIA, RADIUS, CLEARANCE = 2.0, np.diag([0.02, 0.03, 0.04]), 0.03, 1e-3


def system():
    container = exu.SystemContainer()
    return container, container.AddSystem()


def add_body(mbs, kind, place, velocity, spin):
    """A body with the orientation of the axes; spin is its angular velocity."""
    if kind == "2D":
        start, rates = [*place[:2], 0.0], [*velocity[:2], spin[2]]
        body, node = planar_body(mbs, MASS, INERTIA[2, 2], start, rates)
    else:
        turn, rates = {
            "EP": ([1.0, 0.0, 0.0, 0.0], [0.0, *(0.5 * np.array(spin))]),
            "Rxyz": ([0.0] * 3, spin),
            "RotVecLG": ([0.0] * 3, spin),
        }[kind]
        node = mbs.AddNode(
            NODES[kind](referenceCoordinates=[*place, *turn], initialVelocities=[*velocity, *rates])
        )
        inertia = [*np.diag(INERTIA), 0.0, 0.0, 0.0]
        body = mbs.AddObject(ObjectRigidBody(nodeNumber=node, mass=MASS, inertia=inertia))
    outputs = ("Position", "Velocity", "AngularVelocity", "RotationMatrix")
    return body, [recorded(mbs, node, output) for output in outputs]


def run(mbs, duration, step):
    mbs.Assemble()
    settings = fixed_steps(duration, step)
    settings.timeIntegration.newton.useModifiedNewton = False
    solve(mbs, settings)


@functools.cache
def two_bodies(kind, joint, velocity, spin, duration=0.01, step=1e-5):
    """Run two free bodies joined at a point that starts centred; return records and joint's."""
    _container, mbs = system()
    first, sensors_a = add_body(mbs, kind, (0.0, 0.0, 0.0), velocity, spin)
    second, sensors_b = add_body(mbs, kind, (0.3, 0.0, 0.0), (0.0, 0.0, 0.0), (0.0, 0.0, 0.0))
    add, laws = JOINTS[joint]
    made = add(
        mbs, (first, (0.2, 0.0, 0.0)), (second, (-0.1, 0.0, 0.0)),
        radius=RADIUS, clearance=CLEARANCE, **laws,
    )  # fmt: skip
    sensor = add_joint_sensor(mbs, made)
    run(mbs, duration, step)
    records = [
        [np.asarray(mbs.GetSensorStoredData(s))[:, 1:] for s in sensors]
        for sensors in (sensors_a, sensors_b)
    ]
    return records, np.asarray(mbs.GetSensorStoredData(sensor))


@pytest.mark.parametrize(
    ("kind", "joint"),
    [pytest.param(*p, marks=[pytest.mark.long] * p[1].endswith("ball")) for p in PAIRS],
)
def test_motion_in_the_plane_is_that_of_planar_bodies(kind, joint):
    motion = ((0.3, 0.2, 0.0), (0.0, 0.0, 5.0))
    (flat, _), record = two_bodies("2D", joint, *motion, step=5e-5)
    (spatial, _), spatial_record = two_bodies(kind, joint, *motion, step=5e-5)
    assert np.abs(flat[0] - spatial[0]).max() < 2e-7
    moved = np.abs(flat[0][:, 1] - 0.2 * record[:, 0]).max()
    assert moved > 1e-5, "the joint must have done something"
    assert record[:, 1:3] == pytest.approx(spatial_record[:, 1:3], abs=2e-7)


@pytest.mark.parametrize(("kind", "joint"), PAIRS)
def test_momentum_is_kept_in_space_and_energy_only_dissipated(kind, joint):
    """With bodies that tumble and slide along the axis, so that both ends are far apart."""
    records, joint_record = two_bodies(kind, joint, (0.3, 0.2, 0.1), (2.0, 1.0, 5.0), step=4e-6,
                                       duration=0.001)  # fmt: skip
    momentum = MASS * sum(record[1] for record in records)
    angular = 0.0
    for position, velocity, spin, matrix in records:
        rotation = matrix.reshape(-1, 3, 3)
        own = rotation @ INERTIA @ rotation.transpose(0, 2, 1) @ spin[:, :, None]
        angular = angular + MASS * np.cross(position, velocity) + own[:, :, 0]
    assert np.abs(joint_record[:, 4:7]).max() > 1.0
    assert joint_record[:, -1].min() >= -1e-9 * joint_record[:, -1].max() < 0.0
    assert np.abs(momentum - momentum[0]).max() < 1e-9
    assert np.abs(angular - angular[0]).max() < 2e-6 * np.abs(angular[0]).max()


@pytest.mark.parametrize("joint", JOINTS)
@pytest.mark.parametrize("kind", ["Rxyz", "2D"])
def test_jacobian_against_differences(kind, joint, factors=(1.0, 0.01)):
    """Between a spatial body and another kind, near the reference, to the arms' small terms."""
    _container, mbs = system()
    first, _ = add_body(mbs, "Rxyz", (0.0, 0.0, 0.0), (0, 0, 0), (0, 0, 0))
    second, _ = add_body(mbs, kind, (0.3, 0.0, 0.0), (0, 0, 0), (0, 0, 0))
    add, laws = JOINTS[joint]
    made = add(
        mbs, (first, (0.2, 0.0, 0.0)), (second, (-0.1, 0.0, 0.0)),
        radius=RADIUS, clearance=CLEARANCE, **laws,
    )  # fmt: skip
    size = user_force_of(mbs).size
    q, q_t = np.zeros(size), np.random.default_rng(1).normal(size=size) * 1e-2
    inside, touching = (4e-4, 3e-4), (CLEARANCE + 2e-4, 3e-4)
    q[:2] = {"dry": touching, "spherical": touching, "mixed ball": (9e-4, 3e-4)}.get(joint, inside)

    forces(made, q, q_t)
    matrix = np.zeros((size, size))
    matrix[np.ix_(made.indices, made.indices)] = np.reshape(
        made.jacobian(*factors), (len(made.indices), -1)
    )
    assert_partials(matrix, lambda: forces(made, q, q_t), (q, q_t), factors, 2e-3, by_rows=False)


def test_film_of_a_ball_has_the_derivatives_of_its_force_and_couples():
    """By eccentricity, rate and both angular velocities, each to 1e-5 of its own block."""

    def film_at(state):
        film, e = SphericalFilm(ball(), 2.0, CLEARANCE), float(np.linalg.norm(state[:3]))
        film.move(e, state[:3] / e, state[3:6], state[6:])
        return film

    sizes = np.repeat([3e-4, 1e-3, 2.0, 2.0], 3)
    state = np.random.default_rng(2).normal(size=12) * sizes
    given = np.hstack(film_at(state).partials())
    for rows in (slice(0, 3), slice(3, 6), slice(6, 9)):
        for block in (slice(0, 3), slice(3, 6), slice(6, 9), slice(9, 12)):
            expected = []
            for step in np.diag(1e-5 * sizes)[block]:
                low, high = (film_at(state + change) for change in (-step, step))
                difference = [high.force - low.force, *(high.moments - low.moments)]
                expected.append(np.concatenate(difference)[rows] / (2.0 * step.sum()))
            size = np.abs(expected).max()
            assert given[rows, block] == pytest.approx(np.transpose(expected), abs=1e-5 * size)


def test_bristle_of_a_ball_works_in_space():
    bristle = LuGre(0.3, 0.2, 1e5, 10.0, 0.0, 0.01, 2.0)
    _container, mbs = system()
    body, _ = add_body(mbs, "EP", (0.0, 0.0, -CLEARANCE), (0.1, 0.05, -0.01), (0, 0, 0))
    ground = mbs.AddObject(ObjectGround())
    joint = add_dry_spherical(
        mbs, (body, (0, 0, 0)), (ground, (0, 0, 0)),
        radius=RADIUS, clearance=CLEARANCE, contact=CONTACT, friction=bristle,
    )  # fmt: skip
    sensor = add_joint_sensor(mbs, joint)
    run(mbs, 2e-3, 4e-6)
    record = np.asarray(mbs.GetSensorStoredData(sensor))
    force, eccentricity = record[:, 4:7], record[:, 1:4]
    normal = eccentricity / np.linalg.norm(eccentricity, axis=1)[:, None]
    pressed = -(force * normal).sum(axis=1)
    drag = np.linalg.norm(force + pressed[:, None] * normal, axis=1)
    late = pressed > 0.5 * pressed.max()
    assert late.any()
    assert drag[late] / pressed[late] == pytest.approx(0.2, rel=0.05)


def test_axis_between_planar_bodies_is_refused():
    _container, mbs = system()
    bodies = [add_body(mbs, "2D", (0.0, 0.0, 0.0), (0, 0, 0), (0, 0, 0))[0] for _ in range(2)]
    with pytest.raises(InputError, match=r"axis = \(1, 0, 0\): allowed between planar bodies"):
        add_dry_revolute(
            mbs, (bodies[0], (0, 0, 0)), (bodies[1], (0, 0, 0)), radius=RADIUS,
            clearance=CLEARANCE, contact=CONTACT, friction=FRICTION, axis=(1, 0, 0),
        )  # fmt: skip
