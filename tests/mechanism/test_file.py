"""Mechanism files: what is read, what is refused in one line, and the way back."""

import tomllib
from dataclasses import replace

import pytest
from refused import refused

from exu_press import InputError
from exu_press.mechanism import (
    SHIPPED,
    Press,
    mechanism_from_dict,
    mechanism_lines,
    press,
    shipped_mechanism,
)

TEXT = """
name = "sliding"
crank = "crank"
output = {body = "slider", direction = [3, 4], origin = [0.0, 0.1]}
[bodies.crank]
centre_of_mass = [0.0, 0.0]
mass = 20.0
inertia = 0.05
[bodies.rod]
centre_of_mass = [0.2, 0.0]
mass = 3.0
[bodies.slider]
centre_of_mass = [0.3, 0.0]
mass = 5.0
inertia = 0.02
[joints.shaft]
at = [0.0, 0.0]
journal = "crank"
bearing = "frame"
[joints.crank_pin]
at = [0.1, 0.0]
journal = "crank"
bearing = "rod"
[joints.wrist_pin]
at = [0.4, 0.3]
journal = "rod"
bearing = "slider"
shape = "spherical"
[guides.slider]
direction = [0, 2]
[groups]
pins = ["crank_pin", "wrist_pin"]
"""


def changed(*changes):
    """The file with one text after the other in place of another."""
    text = TEXT
    for old, new in changes:
        assert old in text
        text = text.replace(old, new, 1)
    return text


def test_a_file_is_read_as_drawn():
    mechanism = mechanism_from_dict(tomllib.loads(TEXT))
    assert mechanism.body("rod").inertia == pytest.approx(3.0 * (0.3**2 + 0.3**2) / 12)
    assert [joint.spherical for joint in mechanism.joints] == [False, False, True]
    assert mechanism.output.direction == pytest.approx((0.6, 0.8))
    assert mechanism.guides[0].direction == (0.0, 1.0)


@pytest.mark.parametrize("drawn", [*map(shipped_mechanism, SHIPPED), press(Press())])
def test_a_mechanism_is_written_and_read_back_equal(drawn):
    assert mechanism_from_dict(tomllib.loads("\n".join(mechanism_lines(drawn)))) == drawn


@pytest.mark.parametrize(
    ("changes", "shown"),
    [
        ([("mass = 3.0", "")], "bodies.rod needs mass"),
        (
            [("mass = 3.0", ""), ("at = [0.0, 0.0]", ""), ('crank = "crank"', "")],
            "it needs crank; bodies.rod needs mass; joints.shaft needs at",
        ),
        ([("mass = 3.0", "mass = 0.0")], "bodies.rod.mass = 0.0: allowed is a number > 0 (kg)"),
        ([("mass = 3.0", "mas = 3.0")], "bodies.rod.mas = 3.0: unknown key (did you mean 'mass'?)"),
        ([("mass = 3.0", "mass = 1e300")], "bodies.rod.mass = 1e+300: allowed is a number; a nu"),
        ([("[bodies.slider]", '[bodies."Stößel"]')], "bodies: 'Stößel' is no name; allowed are"),
        ([("inertia = 0.02", "")], "bodies.slider.inertia: missing; allowed is a number > 0"),
        ([('bearing = "rod"', 'bearing = "rood"')], "joints.crank_pin.bearing = 'rood':"),
        ([('bearing = "rod"', 'bearing = "crank"')], "joints.crank_pin: joins 'crank' to itself"),
        ([("[guides.slider]", "[guides.sleder]")], "guides.sleder.body = 'sleder': unknown"),
        ([("direction = [0, 2]", "direction = [0, 0]")], "guides.slider.direction = (0.0, 0.0): "),
        ([('crank = "crank"', 'crank = "rod"')], "crank = 'rod': has 0 joints with the frame"),
        ([("at = [0.1, 0.0]", "at = [0.0, 0.0]")], "crank = 'crank': all of its joints lie on its"),
        ([("direction = [3, 4]", "direction = [3, 0]")], "output.direction = (3.0, 0.0): across"),
        ([("pins =", "shaft =")], "groups.shaft: is a joint's name too"),
        ([('["crank_pin", "wrist_pin"]', "[]")], "groups.pins: is empty"),
        ([("[joints.shaft]", "[joints.rod]")], "joints.rod: is a body's name too"),
        ([("[joints.shaft]", "[joints.shaking]")], "joints.shaking: shaking_force is recorded of"),
        ([("[joints.shaft]", "[joints.rod_guide]")], "joints.rod_guide: rod_guide_force is"),
        ([("[joints.shaft]", "[joints.load_blanking]")], "joints.load_blanking: load_blanking_"),
        ([("[bodies.rod]", "[bodies.frame]")], "bodies.frame: this name means the frame"),
        ([("[bodies.rod]", "[bodies.drive]")], "bodies.drive: this name means the disc that turns"),
        ([("[bodies.rod]", "[bodies]\nloose = 3\n[bodies.rod]")], "bodies.loose = 3: allowed is a"),
        (
            [('crank = "crank"', 'crank = "crank"\ncounterweight = "rod"')],
            "counterweight = 'rod': ",
        ),
        (
            [('crank = "crank"', 'crank = "crank"\ncounterweight = ["rodd"]')],
            "counterweight = 'rodd': unknown (did you mean 'rod'?); allowed are rod",
        ),
    ],
)
def test_what_is_wrong_is_named_in_one_line(changes, shown):
    assert refused(mechanism_from_dict, tomllib.loads(changed(*changes))).startswith(shown)


def test_dataclasses_of_ones_own_are_checked_too():
    drawn = mechanism_from_dict(tomllib.loads(TEXT))
    listed = replace(drawn, bodies=list(drawn.bodies), joints=list(drawn.joints))
    assert listed == drawn and hash(listed) == hash(drawn)
    for change, shown in (
        ({"bodies": {"crank": 1.0}}, "bodies: 'crank' is no Body, which alone is allowed"),
        ({"joints": ("shaft",)}, "joints: 'shaft' is no Joint"),
        ({"guides": drawn.bodies}, "guides: Body("),
        ({"output": "slider"}, "output: 'slider' is no Output"),
        ({"name": ""}, "name = '': allowed is a text"),
    ):
        with pytest.raises(InputError) as caught:
            replace(drawn, **change)
        assert str(caught.value).startswith(shown)


def test_a_body_on_nothing():
    more = "[bodies.idle]\ncentre_of_mass = [0.0, 0.0]\nmass = 1.0\ninertia = 1.0\n[groups]"
    assert (
        refused(mechanism_from_dict, tomllib.loads(changed(("[groups]", more))))
        == "bodies.idle: no joint and no guide holds it"
    )


def test_a_scene_is_no_mechanism():
    with pytest.raises(InputError, match="mechanism = 'press': is a key of a scene; allowed is"):
        mechanism_from_dict({"mechanism": "press", "revolutions": 2.0})
