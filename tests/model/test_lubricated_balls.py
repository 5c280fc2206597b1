"""Balls with a film: in the press, and alone in a system of one's own."""

import math

import exudyn as exu
import numpy as np
import pytest
from exudyn.itemInterface import (
    LoadMassProportional,
    MarkerBodyMass,
    NodeRigidBodyEP,
    ObjectGround,
    ObjectRigidBody,
)
from scipy.integrate import quad
from stand_in_system import settings

from exu_press import Scene, add_joint_sensor, add_lubricated_spherical, simulate
from exu_press.laws.film import film_scale
from exu_press.laws.film.ball import ball

RADIUS, CLEARANCE, VISCOSITY = 0.07, 1e-4, 0.4
SCALE = film_scale(VISCOSITY, RADIUS, RADIUS, CLEARANCE)


def alone(spin, inertia=0.5, mass=50.0):
    """A body whose ball starts centred in a socket of the ground, its sensors and its joint's."""
    container = exu.SystemContainer()
    mbs = container.AddSystem()
    ground = mbs.AddObject(ObjectGround())
    turn = [0.0, *(0.5 * np.array(spin))]
    node = mbs.AddNode(
        NodeRigidBodyEP(
            referenceCoordinates=[0.0] * 3 + [1.0, 0.0, 0.0, 0.0],
            initialVelocities=[0.0] * 3 + turn,
        )
    )
    moments = [inertia] * 3 + [0.0] * 3
    body = mbs.AddObject(ObjectRigidBody(nodeNumber=node, mass=mass, inertia=moments))
    joint = add_lubricated_spherical(
        mbs, (body, (0, 0, 0)), (ground, (0, 0, 0)),
        radius=RADIUS, clearance=CLEARANCE, viscosity=VISCOSITY, film=ball(),
    )  # fmt: skip
    return container, mbs, node, body, add_joint_sensor(mbs, joint)


def run(mbs, duration, steps):
    mbs.Assemble()
    chosen = settings(duration, steps, period=0.0, newton__useModifiedNewton=False)
    mbs.SolveDynamic(chosen, showHints=False)


def test_a_ball_spins_down_alike_about_any_axis():
    """As between two spheres about one centre, 8 pi mu R^4 / (3 c) (Landau and Lifshitz)."""
    axis = np.array([1.0, 2.0, -2.0]) / 3.0
    _container, mbs, node, _, _ = alone(25.0 * axis)
    run(mbs, 0.1, 400)
    end = mbs.GetNodeOutput(node, exu.OutputVariableType.AngularVelocity)
    rate = 8.0 * math.pi / 3.0 * SCALE * CLEARANCE / 0.5
    assert end == pytest.approx(25.0 * axis * math.exp(-0.1 * rate), rel=1e-4)


def test_a_loaded_ball_sinks_as_the_closed_form_says():
    """It falls from the middle along a slanting load, without inertia to speak of."""
    _container, mbs, _, body, sensor = alone((0.0, 0.0, 0.0), mass=1.0)
    along = np.array([0.6, 0.0, -0.8])
    mass = mbs.AddMarker(MarkerBodyMass(bodyNumber=body))
    mbs.AddLoad(LoadMassProportional(markerNumber=mass, loadVector=list(4e4 * along)))
    run(mbs, 0.5, 400)
    record = np.asarray(mbs.GetSensorStoredData(sensor))
    path = record[:, 1:4] / CLEARANCE
    assert path == pytest.approx(np.outer(path @ along, along), abs=1e-6)

    def resistance(eps):  # over P, both terms of the pressure's integral
        part = lambda x: x * ((1 - eps * x) ** -2 - 1.0)  # noqa: E731
        return 6.0 * math.pi / eps * quad(part, 0.0, 1.0)[0]

    last = float(path[-1] @ along)
    taken = SCALE * quad(resistance, 1e-6, last)[0] / 4e4
    assert 0.7 < last < 1.0
    assert taken == pytest.approx(0.5, rel=5e-3)


def test_a_film_that_gives_way_passes_its_load_to_contact():
    """The oil is thin: the slider's weight presses the balls through it in a part of a turn."""
    film = {"viscosity": 0.0015, "at_contact": "mixed", "roughness": 1e-6, "socket_angle_deg": 60.0}
    balls = {"kind": "lubricated", "film": film}
    scene = Scene(joints={"balls": balls}, revolutions=0.25, start="centred")
    assert Scene.from_dict(scene.to_dict()) == scene
    result = simulate(scene)
    assert result.completed
    assert abs(result.quantity("energy.residual").value) < 1e-3
    assert result.quantity("joints.ball_left.max_eccentricity_ratio").value > 0.97
    gap, ball = result.joints["ball_left"].gap, result["ball_left_eccentricity"]
    assert gap.min() < 3e-6
    assert gap == pytest.approx(CLEARANCE - np.linalg.norm(ball, axis=1), abs=1e-12)
