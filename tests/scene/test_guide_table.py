"""The [guide] table, the load's eccentricity and the counterweight's switch."""

import math
import pickle

import pytest

from exu_press import Scene
from exu_press.quantities.units import unit_of
from exu_press.scene import mechanism_of
from exu_press.scene.assumptions import assumed_values
from exu_press.schema.table import key_values

IDEAL = {"mechanism": "slider_crank", "joints": {}}


def test_on_and_off_by_replace():
    scene = Scene().replace({"guide.lateral_stiffness": 2e8})
    assert scene.guide.support.lateral_stiffness == 2e8
    assert scene.guide.support.tilting.length == 0.5
    assert Scene(guide=scene.guide) == scene
    assert scene.replace({"guide": None}) == Scene()
    other = scene.replace({"guide": None, "mechanism": "slider_crank"})
    assert other == Scene(mechanism="slider_crank")


MIXED = {
    "lateral_stiffness": 5e8,
    "slide": {"kind": "ideal"},
    "plunger_left": {"clearance": 3e-5, "friction": "coulomb"},
    "counterweight": {"length": 0.8},
}
"""[guide], and tables of three of the press' guides."""


def test_a_guides_own_table_has_its_keys_over_those_of_all(tmp_path):
    scene = Scene(guide=MIXED, contact={"damping": "hu_guo", "restitution": 0.5})
    assert {name: guide.kind for name, guide in scene.guides.items()} == {
        "plunger_left": "dry",
        "plunger_right": "elastic",
        "slider": "elastic",
        "counterweight": "elastic",
    }
    assert scene.guides["counterweight"].support.lateral_stiffness == 5e8
    assert scene.guides["counterweight"].support.tilting.length == 0.8
    assert scene.guides["plunger_left"].rubs
    assert not scene.guides["plunger_right"].rubs
    said = assumed_values(scene)
    assert any(line.startswith("guide.plunger_left.mu_kinetic = 0.1 (hard steel") for line in said)
    assert Scene.from_dict(scene.to_dict()) == scene
    scene.save(tmp_path / "scene.toml", comments=True)
    assert Scene.load(tmp_path / "scene.toml") == scene
    assert pickle.loads(pickle.dumps(scene)).guides == scene.guides
    assert unit_of("guide.plunger_left.clearance") == "m"


OILED = {"clearance": 1e-4, "viscosity": 0.1, "face_width": 0.1, "contact_gap": 2e-6}


@pytest.mark.parametrize(
    ("shared", "own", "kept"),
    [
        (OILED, {"clearance": 5e-5}, "viscosity"),
        ({"clearance": 1e-4, "length": 0.3}, {"lateral_stiffness": 2e9}, "length"),
        (
            {"friction": "coulomb", "mu_kinetic": 0.2},
            {"friction": "stribeck", "mu_static": 0.3},
            "mu_kinetic",
        ),
        (
            {"lateral_stiffness": 1e9, "lateral_damping": 9.0, "damping_ratio": 0.1},
            {"tilting_damping": 9.0, "length": 0.3},
            "lateral_damping",
        ),
    ],
)
def test_a_key_that_others_of_all_guides_need_is_used_where_each_has_its_own(shared, own, kept):
    scene = Scene.from_dict({**IDEAL, "guide": shared})
    changed = scene.replace({f"guide.slider.{name}": value for name, value in own.items()})
    assert changed == Scene.from_dict({**IDEAL, "guide": {**shared, "slider": own}})
    of_slider = {name: value for name, value, _ in key_values(changed.guides["slider"])}
    assert of_slider[kept] == shared[kept]


SLIDING = {"slide", "plunger_left", "plunger_right", "slider", "counterweight"}


def press(**scene):
    return mechanism_of(Scene.from_dict({"mechanism": "press", **scene}))


def test_stiffness_and_damping_as_documented():
    """Lateral k; tilting k L^2 / 12; damping 2 D sqrt(k m) of the guided body, unless given."""
    table = {"lateral_stiffness": 3e8, "length": 0.6, "damping_ratio": 0.1}
    mechanism = press(guide=table)
    assert {guide.body for guide in mechanism.guides} == SLIDING
    assert not any(guide.lateral or guide.tilting for guide in press().guides)
    bodies = {body.name: body for body in mechanism.bodies}
    for guide in mechanism.guides:
        body = bodies[guide.body]
        assert guide.lateral.stiffness == 3e8
        assert guide.tilting.stiffness == pytest.approx(3e8 * 0.6**2 / 12)
        assert guide.lateral.damping == pytest.approx(0.2 * math.sqrt(3e8 * body.mass))
        assert guide.tilting.damping == pytest.approx(
            0.2 * math.sqrt(guide.tilting.stiffness * body.inertia)
        )
    given = {"lateral_stiffness": 1e9, "tilting_stiffness": 1e6, "tilting_damping": 7.0}
    for guide in press(guide=given).guides:
        assert (guide.tilting.stiffness, guide.tilting.damping) == (1e6, 7.0)


def test_inertia_of_a_steel_cube_unless_given():
    """m a^2 / 6 with a^3 = m / 7850; a plunger keeps its rod's inertia."""
    bodies = {
        body.name: body
        for body in press(guide={"lateral_stiffness": 1e9}, press={"slide_inertia": 0.5}).bodies
    }
    assert bodies["slide"].inertia == 0.5
    side = (1347.0 / 7850.0) ** (1 / 3)
    assert bodies["slider"].inertia == pytest.approx(1347.0 * side**2 / 6)
    assert bodies["plunger_left"].inertia == pytest.approx(155.3 * 0.55**2 / 12)
