"""Clearance joints in real Exudyn runs: one item for all, momentum kept, memory right."""

import math

import exudyn as exu
import numpy as np
import pytest
from exudyn.itemInterface import (
    LoadMassProportional,
    MarkerBodyMass,
    ObjectGround,
    ObjectMassPoint2D,
)
from solving import fixed_steps, solve
from stand_in_system import planar_body, recorded, settings

from exu_press import InputError, add_dry_revolute, add_dry_spherical, add_lubricated_revolute
from exu_press.joints import States, user_force_of
from exu_press.joints.history import history
from exu_press.laws.contact import DAMPING_LAWS, delivered_restitution, hertz, step_damping
from exu_press.laws.film import pi_film
from exu_press.laws.friction import LuGre, lugre_steady, no_friction

SIZE = {"radius": 0.07, "clearance": 1e-4}
CONTACT = step_damping(hertz(2.5545e10), 2.5545e6, 1e-5)
STEADY = lugre_steady(0.15, 0.1, 0.0, 0.1, 2.0, 1e-4)
SOFT_BRISTLE = LuGre(0.15, 0.1, 1e3, 4.0, 0.0, 0.1, 2.0)  # 0.1 ms at 1 m/s
LEVELS = {
    "position": "Coordinates",
    "velocity": "Coordinates_t",
    "acceleration": "Coordinates_tt",
}


class Bodies:
    """Planar bodies in a system of the user's own."""

    def __init__(self):
        self.SC = exu.SystemContainer()
        self.mbs = self.SC.AddSystem()
        self.ground = self.mbs.AddObject(ObjectGround(referencePosition=[0.1, -0.2, 0.0]))
        self.nodes, self.bodies, self.sensors = [], [], []
        self.masses, self.inertias, self.references = [], [], []

    def add(self, mass, inertia, place, velocity):
        body, node = planar_body(self.mbs, mass, inertia, place, velocity)
        self.nodes.append(node)
        self.bodies.append(body)
        self.masses.append(mass)
        self.inertias.append(inertia)
        self.references.append(place)
        levels = {name: recorded(self.mbs, node, output) for name, output in LEVELS.items()}
        self.sensors.append(levels)
        return body

    def run(self, end_time, step, tolerance=1e-10):
        self.mbs.Assemble()
        self.states = States(user_force_of(self.mbs).joints)
        self.mbs.SetPostStepUserFunction(self._take)
        chosen = settings(
            end_time,
            round(end_time / step),
            generalizedAlpha__spectralRadius=0.8,
            newton__useModifiedNewton=True,
            newton__modifiedNewtonJacUpdatePerStep=True,
            newton__relativeTolerance=tolerance,
            newton__absoluteTolerance=1e-10,
            adaptiveStep=True,
            adaptiveStepDecrease=0.5,
            minimumStepSize=step / 64,
        )
        solve(self.mbs, chosen)

    def recorded(self, level):
        """Return (n, bodies, 3); positions are displacements from the reference."""
        return np.stack(
            [self.mbs.GetSensorStoredData(sensors[level])[:, 1:] for sensors in self.sensors], 1
        )

    @property
    def time(self):
        return self.mbs.GetSensorStoredData(self.sensors[0]["position"])[:, 0]

    def _take(self, mbs, time):
        self.states.take(time)
        return True

    def history(self, joint):
        return history(self.states, joint, self.time)


def free_pair(relative=(0.05, 0.03), spin=(4.0, -6.0)):
    """Two free bodies whose journal and bearing start centred, drifting apart."""
    bodies = Bodies()
    journal_point, bearing_point = (0.1, 0.05), (-0.2, 0.03)
    angles = (0.3, -0.4)

    def arm(point, angle):
        c, s = math.cos(angle), math.sin(angle)
        return np.array([c * point[0] - s * point[1], s * point[0] + c * point[1]])

    arm_j, arm_b = arm(journal_point, angles[0]), arm(bearing_point, angles[1])
    place_b = arm_j - arm_b
    quarter = np.array([[0.0, -1.0], [1.0, 0.0]])
    velocity_b = quarter @ arm_j * spin[0] - quarter @ arm_b * spin[1] - np.array(relative)
    a = bodies.add(8.0, 0.05, [0.0, 0.0, angles[0]], [0.0, 0.0, spin[0]])
    b = bodies.add(5.0, 0.1, [*place_b, angles[1]], [*velocity_b, spin[1]])
    return bodies, (a, journal_point), (b, bearing_point)


def add_joint(kind, mbs, journal, bearing, friction=STEADY):
    if kind == "lubricated":
        return add_lubricated_revolute(
            mbs, journal, bearing, **SIZE, length=0.1, viscosity=1e-5, law=pi_film()
        )
    add = {"dry": add_dry_revolute, "ball": add_dry_spherical}[kind]
    return add(mbs, journal, bearing, **SIZE, contact=CONTACT, friction=friction)


def momenta(bodies):
    """Momentum (n, 2) and angular momentum (n,) about the origin."""
    place = bodies.recorded("position") + np.array(bodies.references)
    speed = bodies.recorded("velocity")
    mass, inertia = np.array(bodies.masses), np.array(bodies.inertias)
    x, y, u, v = place[:, :, 0], place[:, :, 1], speed[:, :, 0], speed[:, :, 1]
    return (
        (mass[:, None] * speed[:, :, :2]).sum(1),
        (mass * (x * v - y * u) + inertia * speed[:, :, 2]).sum(1),
    )


@pytest.mark.parametrize("kind", ["dry", "ball", "lubricated"])
def test_two_free_bodies_keep_momentum_and_angular_momentum(kind):
    """Momentum to rounding; angular momentum to 1.6e-9 of itself, the integrator's own error.

    That error is of second order in the step (asserted too), so nothing of it is the joint's: a
    moment left out would show as 1e-4, whatever the step.
    """
    drift = {}
    for step in (8e-6, 4e-6):
        bodies, journal, bearing = free_pair()
        add_joint(kind, bodies.mbs, journal, bearing)
        bodies.run(0.006, step)
        momentum, spin = momenta(bodies)
        speed = bodies.recorded("velocity")[:, 0]
        assert 8.0 * np.ptp(speed[:, 0]) > 0.05, "the joint does act"
        assert 0.05 * np.ptp(speed[:, 2]) > 2e-4, "and it does turn the bodies"
        assert np.abs(momentum - momentum[0]).max() < 1e-12 * np.abs(momentum[0]).max()
        drift[step] = np.abs(spin - spin[0]).max() / abs(spin[0])
    assert drift[4e-6] < 1.6e-9
    assert drift[8e-6] / drift[4e-6] == pytest.approx(4.0, rel=0.1)


def test_bodies_are_accelerated_by_what_history_says():
    """m a = F and I alpha = M at every recorded step: forces and moments of the state are real."""
    bodies, journal, bearing = free_pair()
    joint = add_joint("lubricated", bodies.mbs, journal, bearing)
    bodies.run(0.004, 2e-6)
    assert_newton(bodies, joint, journal, bearing)


def assert_newton(bodies, joint, journal, bearing):
    states = bodies.history(joint)
    force, moments = states.force, states.moments
    acceleration, place = bodies.recorded("acceleration"), bodies.recorded("position")
    scale = np.abs(force).max()
    assert scale > 10.0
    for index, (_, point), sign in ((0, journal, 1.0), (1, bearing, -1.0)):
        mass, inertia = bodies.masses[index], bodies.inertias[index]
        angle = place[:, index, 2] + bodies.references[index][2]
        arm_x = np.cos(angle) * point[0] - np.sin(angle) * point[1]
        arm_y = np.sin(angle) * point[0] + np.cos(angle) * point[1]
        moment = sign * (arm_x * force[:, 1] - arm_y * force[:, 0]) + moments[:, index]
        error = mass * acceleration[:, index, :2] - sign * force
        assert np.abs(error[1:]).max() < 1e-5 * scale
        error = inertia * acceleration[:, index, 2] - moment
        assert np.abs(error[1:]).max() < 1e-5 * 0.1 * scale


def test_bristle_is_committed_only_for_accepted_steps():
    """A film that fails at times has steps rejected and halved; the bristle must not notice.

    Dry contact and the film act between the same two bodies; the film is too thin to matter.
    """
    failing = {"calls": 0}
    thin = pi_film()

    def unreliable(eps, eps_dot, eps_w):
        failing["calls"] += 1
        if (failing["calls"] + 700) % 1501 < 6:  # outlasts Newton's own second try
            return (math.nan,) * 10
        return thin(min(eps, 0.5), 0.0, 0.0)

    bodies, journal, bearing = free_pair(relative=(0.05, 0.5))
    joint = add_joint("dry", bodies.mbs, journal, bearing, SOFT_BRISTLE)
    add_lubricated_revolute(
        bodies.mbs, journal, bearing, **SIZE, length=0.1, viscosity=1e-12, law=unreliable
    )
    bodies.run(0.004, 2e-6)
    steps = np.diff(bodies.time)
    assert steps.min() < 0.6 * steps.max(), "steps were rejected and halved"
    assert bodies.time[-1] == pytest.approx(0.004)
    assert_newton(bodies, joint, journal, bearing)


@pytest.mark.parametrize("journal_on_ground", [False, True])
def test_a_joint_to_the_ground_carries_a_body(journal_on_ground):
    """A body at rest in a film's steady state: none; in dry contact it settles and weighs m g.

    The ground's reference position (0.1, -0.2) counts.
    """
    bodies = Bodies()
    body = bodies.add(10.0, 0.1, [0.4, 0.0, 0.0], [0.0, 0.0, 0.0])
    marker = bodies.mbs.AddMarker(MarkerBodyMass(bodyNumber=body))
    bodies.mbs.AddLoad(LoadMassProportional(markerNumber=marker, loadVector=[0, -9.81, 0]))
    ends = [(body, (0.0, 0.0)), (bodies.ground, (0.3, 0.2))]
    joint = add_joint("dry", bodies.mbs, *(ends[::-1] if journal_on_ground else ends))
    bodies.run(0.05, 2e-5)
    last = bodies.history(joint)
    sign = -1.0 if journal_on_ground else 1.0
    assert last.force[-1, 1] * sign == pytest.approx(98.1, rel=1e-3)
    assert last.eccentricity[-1, 1] * sign < -1e-4


def test_other_bodies_are_refused():
    bodies = Bodies()
    body = bodies.add(1.0, 1.0, [0.0, 0.0, 0.0], [0.0, 0.0, 0.0])
    node = bodies.mbs.AddNode(exu.itemInterface.NodePoint2D(referenceCoordinates=[0.0, 0.0]))
    point = bodies.mbs.AddObject(ObjectMassPoint2D(mass=1.0, nodeNumber=node))
    with pytest.raises(
        InputError, match="MassPoint2D: allowed are RigidBody, RigidBody2D, Ground and"
    ):
        add_joint("dry", bodies.mbs, (body, (0.0, 0.0)), (point, (0.0, 0.0)))


def bounce(contact, mass, speed, duration, step=1e-6, clearance=1e-4):
    """Return rebound over approach speed of a body in a clearance around a point of the ground."""
    container = exu.SystemContainer()
    mbs = container.AddSystem()
    body, node = planar_body(mbs, mass, 1.0, (0.99 * clearance, 0, 0), (speed, 0, 0))
    ground = mbs.AddObject(ObjectGround())
    add_dry_revolute(
        mbs, (body, (0, 0)), (ground, (0, 0)), radius=0.05, clearance=clearance,
        contact=contact, friction=no_friction(),
    )  # fmt: skip
    velocity = recorded(mbs, node, "Coordinates_t")
    mbs.Assemble()
    chosen = fixed_steps(duration, step)
    chosen.timeIntegration.newton.modifiedNewtonJacUpdatePerStep = True
    solve(mbs, chosen)
    return -np.asarray(mbs.GetSensorStoredData(velocity))[:, 1].min() / speed


@pytest.mark.parametrize(("law", "wanted"), [("flores", 0.1), ("hu_guo", 0.9)])
def test_hysteretic_laws(law, wanted):
    """A mass that bounces delivers the restitution that its law alone does."""
    contact = DAMPING_LAWS[law](hertz(1e10), restitution=wanted)
    expected = delivered_restitution(contact, mass=1.0, speed=0.5)
    assert bounce(contact, 1.0, 0.5, 1.2e-3) == pytest.approx(expected, abs=1e-3)
