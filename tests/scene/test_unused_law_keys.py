"""Keys that a choice does not use, or another key excludes: refused, and dropped by a change."""

import numpy as np
import pytest
from refused import refused

from exu_press import InputError, Scene

PIN = {"kind": "dry", "clearance": 5e-5, "radius": 0.03}
BASE = {"mechanism": "slider_crank", "joints": {"crank_pin": PIN}, "contact": {"length": 0.05}}


def test_a_change_drops_what_is_no_longer_used_but_not_what_it_names():
    scene = Scene.from_dict({**BASE, "friction": {"law": "lugre", "sigma_0": 2e5}})
    coulomb = scene.replace({"friction.law": "coulomb"})
    assert "sigma_0" not in coulomb.friction
    assert scene.replace({"joints.crank_pin": "ideal"}).friction is None
    with pytest.raises(InputError, match=r"friction\.sigma_0 = 300000\.0: not used"):
        scene.replace({"friction.law": "coulomb", "friction.sigma_0": 3e5})
    with pytest.raises(InputError, match=r"friction\.sigma_0 = 300000\.0: not used"):
        scene.replace({"friction": {"law": "coulomb", "sigma_0": 3e5}})


def test_a_ball_has_no_cylindrical_contact_of_its_own():
    with pytest.raises(InputError, match=r"joints\.balls\.contact\.shape = 'cylindrical': a ball"):
        Scene().replace({"joints.balls": "dry", "joints.balls.contact.shape": "cylindrical"})
    scene = Scene(joints={"balls": "dry", "crank_pin": "dry"}, contact={"shape": "cylindrical"})
    assert Scene.from_dict(scene.to_dict()) == scene, "that of the pins may stand in [contact]"


CASES = [
    (
        "drive",
        {"inertia": 6000.0, "rated_torque": 2000.0},
        {"table_torque": [1e3, 5e2], "table_speed_rpm": [0.0, 50.0]},
        {"rated_torque"},
    ),
    ("contact", {"shape": "point", "stiffness": 2e10}, {"modulus": 2e11}, {"stiffness"}),
    (
        "load.a",
        {"kind": "table", "time": [0.0, 1.0], "force": [0.0, 1e3]},
        {"height": [0.0, 0.01]},
        {"time"},
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
