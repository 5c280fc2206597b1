"""Validation: what a scene allows, fills in and says; which bodies are flexible."""

import math

import pytest

from exu_press import Scene
from exu_press.scene import Flexible, flexible_press
from exu_press.scene.solver import Solver
from exu_press.schema.table import table_from


def test_tables_may_be_dataclasses_or_mappings():
    by_mapping = Scene.from_dict({"film": {"viscosity": 0.1}, "solver": {"step": 1e-4}})
    solver = table_from(Solver, "solver", {"step": 1e-4})
    assert Scene(film={"viscosity": 0.1}, solver=solver) == by_mapping


def test_derived_quantities():
    scene = Scene.from_dict({"speed_rpm": 120, "revolutions": 3, "start_angle_deg": 90})
    assert scene.angular_speed == pytest.approx(4 * math.pi)
    assert scene.duration == pytest.approx(1.5)
    assert scene.start_angle == pytest.approx(math.pi / 2)


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
