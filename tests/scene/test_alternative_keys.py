"""A key that is set takes the place of the keys that it excludes."""

import numpy as np
import pytest
from refused import refused

from exu_press import Scene

DRIVE = {"inertia": 6000.0, "table_torque": [1e3, 500.0], "table_speed_rpm": [0.0, 50.0]}

CASES = [
    ("drive", DRIVE, {"rated_torque": 2000.0}, {"table_torque", "table_speed_rpm"}),
    (
        "drive",
        {"inertia": 6000.0, "rated_torque": 2000.0},
        {"table_torque": [1e3, 5e2], "table_speed_rpm": [0.0, 50.0]},
        {"rated_torque"},
    ),
    ("contact", {"shape": "point", "stiffness": 2e10}, {"modulus": 2e11}, {"stiffness"}),
    ("contact", {"shape": "point", "modulus": 2e11}, {"stiffness": 2e10}, {"modulus"}),
    (
        "load.a",
        {"kind": "table", "time": [0.0, 1.0], "force": [0.0, 1e3]},
        {"height": [0.0, 0.01]},
        {"time"},
    ),
    (
        "load.a",
        {"kind": "blanking", "force": 1e4, "end_angle_deg": 170.0},
        {"start_angle_deg": 100.0},
        set(),
    ),
]


@pytest.mark.parametrize(("table", "keys", "change", "replaced"), CASES)
def test_the_other_alternative_goes(table, keys, change, replaced):
    scene = Scene(joints={"balls": "dry"}).replace({table: keys})
    changed = scene.replace({f"{table}.{key}": value for key, value in change.items()}).to_dict()
    for name in table.split("."):
        changed = changed[name]
    assert {key: changed[key] for key in change} == change
    assert not replaced & changed.keys()


def test_numbers_of_numpy_are_numbers_also_where_a_key_chooses():
    keys = {"revolutions": np.int64(2), "solver": {"step": np.float64(1e-4)}}
    assert Scene.from_dict(keys) == Scene(revolutions=2, solver={"step": 1e-4})
    message = refused(Scene.from_dict, {"solver": {"step": np.full(2, 1e-4)}})
    assert message.startswith("solver.step = array([0.0001, 0.0001]): allowed is a number > 0")
