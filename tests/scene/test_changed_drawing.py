"""Keys of a scene's drawing as keys of the scene: masses, places, and what is refused."""

import math

import pytest
from refused import refused

from exu_press import Scene
from exu_press.mechanism import mechanism_from_dict, mechanism_lines, shipped_mechanism
from exu_press.quantities.units import with_unit
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


def test_an_inertia_left_out_is_that_of_a_rod():
    inertia = bodies({"bodies.link.inertia": None}, "drag_link")["link"].inertia
    crank_pin, link_pin = (
        next(joint.at for joint in shipped_mechanism("drag_link").joints if joint.name == name)
        for name in ("crank_pin", "link_pin")
    )
    length = math.dist(crank_pin, link_pin)
    assert inertia == pytest.approx(14.0 * length**2 / 12, rel=1e-12)


def test_a_file_and_its_keys_change_at_once(tmp_path):
    file = tmp_path / "link.toml"
    file.write_text("\n".join(mechanism_lines(mechanism_from_dict(LINK))), encoding="utf-8")
    changes = {"mechanism": str(file), "mechanism.bodies.slide.mass": 7.0}
    changed = Scene(mechanism="slider_crank", joints={}).replace(changes)
    assert mechanism_of(changed).body("slide").mass == 7.0


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


def test_units_of_their_columns():
    assert with_unit("mechanism.bodies.rod.inertia") == "mechanism.bodies.rod.inertia, kg m^2"
    assert with_unit("mechanism.joints.crank_pin.at.x") == "mechanism.joints.crank_pin.at.x, m"
