"""The [film.oil] table: what it takes the place of, merges, round trips and refusals."""

import pytest

from exu_press import Scene
from exu_press.scene.assumptions import assumed_values
from exu_press.scene.oil import Oil
from exu_press.scene.warnings import scene_warnings

OIL = {"viscosity_cst": [68.0, 8.7], "density": 870.0, "supply_celsius": 40.0, "conductance": 5.0}


def scene_of(**keys):
    given = {"mechanism": "slider_crank", "joints": {"crank_pin": "lubricated"}}
    return Scene(**(given | {"film": {"oil": OIL}} | keys))


def film_of(scene, joint="crank_pin"):
    return scene.joints[joint].film


def test_an_oil_takes_the_place_of_the_mechanisms_viscosity():
    scene = scene_of()
    assert "viscosity" not in scene.film
    assert film_of(scene).oil == Oil(**OIL)
    assert film_of(scene).cold_viscosity == pytest.approx(68e-6 * 870.0)
    constant = scene.replace({"film.viscosity": 0.1})
    assert constant.film["viscosity"] == 0.1 and "oil" not in constant.film
    assert constant.replace({"film.oil": OIL}) == scene


def test_a_key_of_it_can_be_changed_by_its_dotted_name():
    scene = scene_of().replace({"film.oil.supply_celsius": 55.0})
    assert scene.film["oil"].supply_celsius == 55.0
    assert film_of(scene).oil.density == 870.0
    pin = scene.replace({"joints.crank_pin.film.oil.conductance": 9.0})
    assert (scene.film["oil"].conductance, film_of(pin).oil.conductance) == (5.0, 9.0)
    assert film_of(pin).oil.supply_celsius == 55.0


def test_joints_have_oils_of_their_own():
    own = {"kind": "lubricated", "film": {"oil": {"conductance": 1.0}}}
    constant = {"kind": "lubricated", "film": {"viscosity": 0.2}}
    scene = scene_of(joints={"crank_pin": own, "shaft": constant, "wrist_pin": "lubricated"})
    assert film_of(scene).oil == Oil(**(OIL | {"conductance": 1.0}))
    assert (film_of(scene, "shaft").viscosity, film_of(scene, "shaft").oil) == (0.2, None)
    assert film_of(scene, "wrist_pin").oil == Oil(**OIL)
    assert Scene.from_dict(scene.to_dict()) == scene
    only_there = Scene(
        mechanism="slider_crank", joints={"crank_pin": {"kind": "lubricated", "film": {"oil": OIL}}}
    )
    assert only_there.film["viscosity"] == 0.4
    assert film_of(only_there).oil == Oil(**OIL)
    assert Scene.from_dict(only_there.to_dict()) == only_there
    balls = scene_of(mechanism="press", joints={"crank_pin": "lubricated", "balls": constant})
    assert balls.joints["ball_left"].film.cold_viscosity == 0.2
    assert scene_warnings(balls) == []


def test_defaults_that_decide_are_told():
    without = {key: value for key, value in OIL.items() if key != "conductance"}
    told = assumed_values(scene_of(film={"oil": without}))
    assert any("film.oil.conductance = 0 W/K" in text for text in told)
    assert any("film.oil.heat_capacity = 1.8e+06" in text and "DIN" in text for text in told)
    assert not any("film.oil.density" in text or "viscosity" in text for text in told)


def test_an_oil_that_is_hardly_meant_is_warned_of():
    thick = scene_of(film={"oil": OIL | {"viscosity_cst": [68000.0, 8700.0]}})
    (told,) = [text for text in scene_warnings(thick) if "oil" in text and "above 2 Pa s" in text]
    assert "59.16" in told
