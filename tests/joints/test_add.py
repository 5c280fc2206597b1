"""What the joints' functions refuse, in one line, before anything is added."""

import exudyn as exu
import pytest
from exudyn.itemInterface import NodeRigidBody2D, ObjectGround, ObjectRigidBody2D

from exu_press import InputError, add_dry_revolute, add_dry_spherical, add_lubricated_revolute
from exu_press.laws.friction import no_friction
from exu_press.scene import Scene
from exu_press.scene.laws import contact_law, film_law

SCENE = Scene()
CONTACT = contact_law(SCENE.contact, 1e-4, revolute=True)
DRY = {"radius": 0.02, "clearance": 1e-4, "contact": CONTACT, "friction": no_friction()}
FILM = {
    "radius": 0.02,
    "clearance": 1e-4,
    "length": 0.1,
    "viscosity": 0.1,
    "law": film_law(SCENE.film, 0.02, 1e-4),
}


def system():
    container = exu.SystemContainer()
    mbs = container.AddSystem()
    ground = int(mbs.AddObject(ObjectGround()))
    node = mbs.AddNode(NodeRigidBody2D())
    body = int(mbs.AddObject(ObjectRigidBody2D(nodeNumber=node, mass=1.0, inertia=1.0)))
    return container, mbs, (body, (0.0, 0.0)), (ground, (0.0, 0.0))


@pytest.mark.parametrize(
    ("add", "arguments", "message"),
    [
        (add_dry_revolute, {**DRY, "clearance": 0.05}, "clearance = 0.05: allowed is .* 0.02 m"),
        (add_dry_spherical, {**DRY, "clearance": 0.0}, "clearance = 0: allowed is a number > 0"),
        (add_dry_revolute, {**DRY, "radius": -1.0}, "radius = -1: allowed is a number > 0"),
        (add_dry_revolute, {**DRY, "friction": "lugre"}, "friction = 'lugre': allowed is a law"),
        (add_dry_spherical, {**DRY, "contact": "step"}, "contact = 'step': allowed is a law"),
        (add_lubricated_revolute, {**FILM, "law": "finite"}, "law = 'finite': allowed is a law"),
        (add_lubricated_revolute, {**FILM, "clearance": 0.05}, "clearance = 0.05: allowed is"),
    ],
)
def test_what_is_refused(add, arguments, message):
    _, mbs, journal, bearing = system()
    with pytest.raises(InputError, match=message):
        add(mbs, journal, bearing, **arguments)
    assert mbs.systemData.NumberOfObjects() == 2


@pytest.mark.parametrize(
    ("add", "arguments"),
    [(add_dry_revolute, DRY), (add_dry_spherical, DRY), (add_lubricated_revolute, FILM)],
)
def test_an_assembled_system_takes_no_joint(add, arguments):
    _, mbs, journal, bearing = system()
    mbs.Assemble()
    with pytest.raises(InputError, match=r"assembled: allowed is to add joints before"):
        add(mbs, journal, bearing, **arguments)
