"""Keys of a scene's drawing as keys of the scene: masses, places, and what is refused."""

import pytest
from refused import refused

from exu_press import Scene
from exu_press.scene.scene import mechanism_of

LINK = {
    "name": "link",
    "crank": "crank",
    "output": {"body": "slide", "direction": [0, 1]},
    "bodies": {
        "crank": {"centre_of_mass": [0.0, 0.05], "mass": 3.0},
        "rod": {"centre_of_mass": [0.0, 0.3], "mass": 6.0},
        "slide": {"centre_of_mass": [0.0, 0.5], "mass": 20.0, "inertia": 0.1},
    },
    "joints": {
        "shaft": {"at": [0.0, 0.0], "journal": "crank", "bearing": "frame"},
        "crank_pin": {"at": [0.0, 0.1], "journal": "crank", "bearing": "rod"},
        "wrist_pin": {"at": [0.0, 0.5], "journal": "slide", "bearing": "rod"},
    },
    "guides": {"slide": {"direction": [0, 1]}},
}


def bodies(changes, mechanism=LINK):
    changed = Scene(mechanism=mechanism).replace(
        {f"mechanism.{name}": value for name, value in changes.items()}
    )
    again = Scene.from_dict(changed.to_dict())
    assert again == changed
    return {body.name: body for body in mechanism_of(again).bodies}


def test_a_uniform_rod_stays_one():
    """Its inertia is m l^2 / 12 of the new mass and length; the slide keeps what it was given."""
    found = bodies({"bodies.rod.mass": 12.0, "joints.wrist_pin.at.y": 0.7, "bodies.slide.mass": 5})
    assert found["rod"].inertia == pytest.approx(12.0 * 0.6**2 / 12, rel=1e-12)
    assert found["crank"].inertia == pytest.approx(3.0 * 0.1**2 / 12, rel=1e-12)
    assert (found["slide"].mass, found["slide"].inertia) == (5.0, 0.1)


@pytest.mark.parametrize(
    ("mechanism", "key", "told"),
    [
        (LINK, "bodies.rood.mass", "no table bodies.rood (did you mean 'rod'?)"),
        (LINK, "bodies.rod.mas", "unknown key (did you mean 'mass'?)"),
        (LINK, "joints.wrist_pin.at.z", "no table joints.wrist_pin.at"),
        (LINK, "joints.wrist_pin.at.left.x", "no table joints.wrist_pin.at"),
        (LINK, "defaults.radius", "allowed are keys of bodies, joints, guides, output"),
        ("press", "bodies.ram.mass", "are keys of [press]"),
    ],
)
def test_other_keys_are_refused(mechanism, key, told):
    message = refused(Scene(mechanism=mechanism).replace, {f"mechanism.{key}": 3.0})
    assert message.startswith(f"mechanism.{key}") and told in message
