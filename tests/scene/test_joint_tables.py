"""[joints.NAME]: every joint of the mechanism, by its name or its group's."""

from dataclasses import replace

import pytest

from exu_press import InputError, Scene
from exu_press.scene import mechanism_of
from exu_press.schema.table import plain


def press(**joints):
    return Scene(joints=joints)


def test_a_group_stands_for_its_joints():
    balls = {"balls": {"kind": "dry", "clearance": 5e-5}, "ball_left": {"clearance": 2e-4}}
    assert press(**balls).joints["ball_left"].clearance == 2e-4, "its own go before"
    assert press(**balls).joints["ball_right"].clearance == 5e-5
    scene = press(knuckles={"kind": "dry", "clearance": 5e-5})
    loose = scene.joints.with_clearance
    assert len(loose) == 4
    assert all(name.startswith("knuckle_") and j.clearance == 5e-5 for name, j in loose.items())
    assert list(scene.joints.by_group) == ["knuckles"]


def test_own_laws_differ_from_the_scenes():
    scene = Scene(
        joints={
            "crank_pin": {"kind": "lubricated", "film": {"law": "pi_film"}},
            "slide_pin": "lubricated",
            "balls": {"kind": "dry", "contact": {"damping": "flores"}, "friction": {"law": "none"}},
            "pivots": "dry",
        },
        film={"viscosity": 0.1},
    )
    films = scene.joints["crank_pin"].film, scene.joints["slide_pin"].film
    assert [(film.law.kind, film.viscosity) for film in films] == [
        ("pi_film", 0.1),
        ("finite", 0.1),
    ]
    assert scene.joints["ball_left"].contact.damping.kind == "flores"
    kept = {key: value for key, value in scene.contact.items() if key != "restitution"}
    assert plain(scene.joints["pivot_left"].contact) == kept
    given = scene.to_dict()["joints"]
    assert given["crank_pin"]["film"] == {"law": "pi_film"}, "nothing but the difference"
    assert "film" not in given["slide_pin"]
    assert Scene.from_dict(scene.to_dict()) == scene


def test_contact_and_friction_of_a_film_only_where_it_is_mixed():
    assert press(crank_pin="lubricated").joints["crank_pin"].contact is None
    mixed = Scene(joints={"crank_pin": "lubricated"}, film={"at_contact": "mixed"})
    assert plain(mixed.joints["crank_pin"].contact) == mixed.contact
    assert mixed.joints["crank_pin"].onset == pytest.approx(6e-7)


def test_a_joint_in_two_groups_is_refused():
    """The press has no such groups; a mechanism may."""
    groups = {"both": ("shaft", "crank_pin"), "some": ("shaft",)}
    mechanism = replace(mechanism_of(Scene()), groups=groups)
    with pytest.raises(InputError, match="shaft lies in both"):
        Scene(mechanism=mechanism, joints={"both": "dry", "some": "ideal"})
