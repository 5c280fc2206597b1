"""What joints refuse, in one line: to be added, and to start where no law of theirs holds."""

import re

import exudyn as exu
import pytest
from exudyn.itemInterface import (
    NodeRigidBodyRxyz,
    ObjectGround,
    ObjectRigidBody,
)
from stand_in_system import planar_body, settings

from exu_press import (
    InputError,
    SolverStatus,
    add_dry_revolute,
    add_dry_spherical,
    add_lubricated_revolute,
    add_lubricated_spherical,
    solve_dynamic,
)
from exu_press.laws.film import with_asperities
from exu_press.laws.film.ball import ball
from exu_press.laws.friction import no_friction
from exu_press.scene import Scene

SCENE = Scene()
CONTACT = SCENE.joints["ball_left"].normal_contact(SCENE.angular_speed)
DRY = {"radius": 0.02, "clearance": 1e-4, "contact": CONTACT, "friction": no_friction()}
FILM = {
    "radius": 0.02,
    "clearance": 1e-4,
    "length": 0.1,
    "viscosity": 0.1,
    "law": SCENE.joints["crank_pin"].film.film_law(0.02, 1e-4),
}
OILED_BALL = {"radius": 0.02, "clearance": 1e-4, "viscosity": 0.1, "film": ball()}
IN_SPACE = add_dry_spherical, add_lubricated_spherical


def system():
    container = exu.SystemContainer()
    mbs = container.AddSystem()
    ground = int(mbs.AddObject(ObjectGround()))
    body, _ = planar_body(mbs, 1.0, 1.0)
    return container, mbs, (int(body), (0.0, 0.0)), (ground, (0.0, 0.0))


@pytest.mark.parametrize(
    ("add", "arguments", "message"),
    [
        (add_dry_revolute, {**DRY, "clearance": 0.05}, "clearance = 0.05: allowed is .* 0.02 m"),
        (add_dry_spherical, {**DRY, "clearance": 0.0}, "clearance = 0: allowed is a number > 0"),
        (add_dry_revolute, {**DRY, "radius": -1.0}, "radius = -1: allowed is a number > 0"),
        (add_dry_revolute, {**DRY, "friction": "lugre"}, "friction = 'lugre': allowed is a law"),
        (add_dry_revolute, {**DRY, "friction": None}, "friction = None: allowed is a law"),
        (add_dry_spherical, {**DRY, "contact": None}, "contact = None: allowed is a law"),
        (add_lubricated_revolute, {**FILM, "law": "finite"}, "law = 'finite': allowed is a law"),
        (add_lubricated_spherical, {**OILED_BALL, "film": "ball"}, "film = 'ball': allowed"),
        (add_lubricated_spherical, {**OILED_BALL, "viscosity": 0.0}, "viscosity = 0"),
    ],
)
def test_what_is_refused(add, arguments, message):
    _, mbs, journal, bearing = system()
    with pytest.raises(InputError, match=message):
        add(mbs, journal, bearing, **arguments)
    assert mbs.systemData.NumberOfObjects() == 2


@pytest.mark.parametrize(
    ("add", "arguments"),
    [
        (add_dry_revolute, DRY),
        (add_dry_spherical, DRY),
        (add_lubricated_revolute, FILM),
        (add_lubricated_spherical, OILED_BALL),
    ],
)
def test_an_assembled_system_takes_no_joint(add, arguments):
    _, mbs, journal, bearing = system()
    mbs.Assemble()
    with pytest.raises(InputError, match=r"assembled: allowed is to add joints before"):
        add(mbs, journal, bearing, **arguments)


def start(add, arguments, out):
    """A body that starts out of its bearing's middle (m), ready to be solved."""
    container, mbs, journal, bearing = system()
    if add in IN_SPACE:
        node = mbs.AddNode(NodeRigidBodyRxyz())
        inertia = [1.0, 1.0, 1.0, 0.0, 0.0, 0.0]
        body = mbs.AddObject(ObjectRigidBody(nodeNumber=node, mass=1.0, inertia=inertia))
        journal = int(body), (0.0, 0.0, 0.0)
    add(mbs, journal, bearing, **arguments)
    mbs.Assemble()
    data = mbs.systemData
    before = data.GetODE2Coordinates(exu.ConfigurationType.Initial)
    x, y = (-6, -5) if add in IN_SPACE else (-3, -2)  # of the last node
    before[x] += 0.6 * out
    before[y] += 0.8 * out
    data.SetODE2Coordinates(before, exu.ConfigurationType.Initial)
    data.SetODE2Coordinates_t([1e-3] * len(before), exu.ConfigurationType.Initial)
    return container, mbs, settings(1e-4, 10)


MIXED = FILM | {
    "law": with_asperities(FILM["law"], 0.02),
    "contact": CONTACT,
    "asperity_onset": 2e-6,
}
TOO_FAR = [
    (add_lubricated_revolute, FILM, 1e-4, "less, where its film's law gives numbers"),
    (add_lubricated_revolute, FILM, 2e-2, "less, where its film's law gives numbers"),
    (add_lubricated_revolute, MIXED, 3.1e-4, "0.0003 m, a penetration of 1% of the radius"),
    (add_dry_revolute, DRY, 3.1e-4, "0.0003 m, a penetration of 1% of the radius"),
    (add_dry_spherical, DRY, 3.1e-4, "0.0003 m, a penetration of 1% of the radius"),
    (add_lubricated_spherical, OILED_BALL, 1e-4, "less, where its film's law gives numbers"),
]


@pytest.mark.parametrize(("add", "arguments", "out", "allowed"), TOO_FAR)
def test_a_start_too_far_out_alone_is_refused(add, arguments, out, allowed):
    """With what is allowed, and before anything has run; Exudyn's own solver says so too.

    One that starts not quite as far out is solved.
    """
    out *= 1.0001
    said = (
        f"clearance joint 0 starts with an eccentricity of {out:.4g} m at a clearance of 0.0001 m: "
        f"allowed is {allowed}"
    )
    _container, mbs, chosen = start(add, arguments, out)
    for _ in range(2):
        with pytest.raises(InputError, match=re.escape(said)):
            solve_dynamic(mbs, chosen)
        assert "dynamicSolver" not in mbs.sys
    _container, mbs, chosen = start(add, arguments, out)
    with pytest.raises(exu.ExudynError, match=re.escape(said)):
        mbs.SolveDynamic(chosen)
    out = 0.99 * min(out, 1e-4 if arguments is FILM else 3e-4)
    _container, mbs, chosen = start(add, arguments, out)
    assert solve_dynamic(mbs, chosen).status is SolverStatus.COMPLETED
