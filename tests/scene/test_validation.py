"""Validation: what a scene allows, fills in and says; which bodies are flexible."""

import math

import pytest

from exu_press import Scene
from exu_press.scene import Face, Flexible, flexible_press
from exu_press.scene.solver import Solver
from exu_press.schema.table import plain, table_from

CRANK = {"mechanism": "slider_crank"}
IDEAL = {"mechanism": "press", "joints": {}}
DRY = {"mechanism": "press", "joints": {"crank_pin": "dry", "balls": "dry"}}


def test_defaults():
    """Table 2 and assumptions A-1 .. A-14, as the interface shows them."""
    scene = Scene()
    assert (scene.mechanism, scene.bodies) == ("press", {})
    assert (scene.speed_rpm, scene.revolutions, scene.start_angle_deg) == (240.0, 2.0, 0.0)
    assert {n: joint.kind for n, joint in scene.joints.with_clearance.items()} == {
        "crank_pin": "lubricated",
        "ball_left": "dry",
        "ball_right": "dry",
    }
    pin, ball = scene.joints["crank_pin"], scene.joints["ball_left"]
    assert pin.clearance == ball.clearance == 1e-4 and pin.radius == ball.radius == 0.07
    assert plain(pin.film) == scene.film
    assert (plain(ball.contact), plain(ball.friction)) == (scene.contact, scene.friction)
    assert (scene.contact["stiffness"], scene.contact["exponent"]) == (2.5545e10, 1.5)
    assert (scene.contact["damping_max"], scene.contact["damping_depth"]) == (2.5545e8, 1e-5)
    assert scene.contact["tension"] is False
    bristle = scene.replace({"friction.law": "lugre"}).friction
    assert (bristle["sigma_0"], bristle["sigma_1"], bristle["sigma_2"]) == (1e5, 400, 0)
    assert scene.friction["sigma_2"] == 0 and not {"sigma_0", "sigma_1"} & scene.friction.keys()
    assert (scene.film["viscosity"], scene.film["length"]) == (0.4, 0.1)
    assert scene.press.pivot_distance == 0.1655
    assert scene.press.counterweight.counter_eccentricity == 0.016
    assert scene.press.slide_mass == 60.0
    assert scene.press.bottom_dead_centre == 0.47
    assert not scene.load
    assert scene.slider_crank is None


def test_what_is_not_used_is_none():
    scene = Scene.from_dict(IDEAL)
    assert scene.contact is scene.friction is scene.film is None
    assert Scene.from_dict({**DRY}).film is None
    film_alone = Scene.from_dict(CRANK)
    assert film_alone.contact is film_alone.friction is None


def test_tables_may_be_dataclasses_or_mappings():
    by_mapping = Scene.from_dict({"film": {"viscosity": 0.1}, "solver": {"step": 1e-4}})
    solver = table_from(Solver, "solver", {"step": 1e-4})
    assert Scene(film={"viscosity": 0.1}, solver=solver) == by_mapping


def test_derived_quantities():
    scene = Scene.from_dict({"speed_rpm": 120, "revolutions": 3, "start_angle_deg": 90})
    assert scene.angular_speed == pytest.approx(4 * math.pi)
    assert scene.duration == pytest.approx(1.5)
    assert scene.start_angle == pytest.approx(math.pi / 2)


def test_a_part_alone_or_with_its_keys():
    short, long = Scene(bodies={"linkage": "linkage"}), Scene(bodies=flexible_press(modes=4))
    assert short.bodies == {"linkage": Flexible("linkage")}
    assert {name: body.modes for name, body in long.bodies.items()} == {"crank": 4, "linkage": 4}
    assert Scene().bodies == {}


def test_one_key_a_part_or_all_bodies_are_replaced():
    scene = Scene().replace({"bodies.linkage": "linkage"}).replace({"bodies.linkage.modes": 6})
    assert scene.bodies == {"linkage": Flexible("linkage", modes=6)}
    assert scene.replace({"bodies.linkage": "linkage_2"}).bodies["linkage"].modes == 20
    assert scene.replace({"bodies": {}}).bodies == {}
    assert scene.replace({"mechanism": "slider_crank"}).bodies == {}
    both = scene.replace({"bodies.linkage": "linkage_2", "bodies.linkage.modes": 3})
    assert both.bodies["linkage"] == Flexible("linkage_2", modes=3)


def test_a_flexibility_error_takes_the_place_of_the_modes_and_back():
    scene = Scene(bodies=flexible_press()).replace({"bodies.crank.flexibility_error": 0.01})
    assert (scene.bodies["crank"].modes, scene.bodies["linkage"].modes) == (None, 20)
    back = scene.replace({"bodies.crank.modes": 6}).bodies["crank"]
    assert (back.modes, back.flexibility_error) == (6, None)


def test_faces_are_a_name_a_table_or_several():
    faces = {"crank_pin": "pin", "shaft": ["a", {"radius": 0.1, "z": [0, 1]}]}
    body = Scene(bodies={"crank": {"flexible": "crank", "faces": faces}}).bodies["crank"]
    assert body.faces["crank_pin"] == (Face("pin"),)
    assert body.faces["shaft"] == (Face("a"), Face(radius=0.1, z=(0.0, 1.0)))


def test_a_file_lies_beside_its_scene(tmp_path):
    (tmp_path / "scenes").mkdir()
    path = tmp_path / "scenes" / "mine.toml"
    path.write_text('mechanism = "four_bar"\n[bodies]\ncoupler = "my.step"\n')
    scene = Scene.load(path)
    assert scene.bodies["coupler"].path == tmp_path / "scenes" / "my.step"
    scene.save(tmp_path / "other.toml")
    assert 'flexible = "scenes/my.step"' in (tmp_path / "other.toml").read_text()
