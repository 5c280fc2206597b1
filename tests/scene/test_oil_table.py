"""The [film.oil] table: what it takes the place of, merges, round trips and refusals."""

import pytest

from exu_press import Scene
from exu_press.scene.oil import Oil
from exu_press.scene.warnings import scene_warnings

OIL = {"viscosity_cst": [68.0, 8.7], "density": 870.0, "supply_celsius": 40.0, "conductance": 5.0}


def scene_of(**keys):
    given = {"mechanism": "slider_crank", "joints": {"crank_pin": "lubricated"}}
    return Scene(**(given | {"film": {"oil": OIL}} | keys))


def film_of(scene, joint="crank_pin"):
    return scene.joints[joint].film


def test_joints_have_oils_of_their_own():
    own = {"kind": "lubricated", "film": {"oil": {"conductance": 1.0}}}
    constant = {"kind": "lubricated", "film": {"viscosity": 0.2}}
    scene = scene_of(joints={"crank_pin": own, "shaft": constant, "wrist_pin": "lubricated"})
    assert film_of(scene).oil == Oil(**(OIL | {"conductance": 1.0}))
    assert film_of(scene).cold_viscosity == pytest.approx(68e-6 * 870.0)
    warmer = scene.replace({"film.oil.supply_celsius": 55.0})
    assert film_of(warmer, "wrist_pin").oil == Oil(**(OIL | {"supply_celsius": 55.0}))
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
