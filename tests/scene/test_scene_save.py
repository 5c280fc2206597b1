"""A scene written from Python is read back equal, and never in place of somebody's file."""

import json

import pytest
from schedules import SCHEDULE

from exu_press import InputError, Scene

PULSE = {"kind": "blanking", "force": 1e4}
SCENES = {
    "mixed": {
        "film": {"law": "finite", "at_contact": "mixed"},
        "contact": {"tension": True, "shape": "cylindrical"},
        "solver": {"step": 1e-5},
        "load": {"blanking": {"kind": "blanking", "force": 1e4}},
    },
    "flexible": {"bodies": {"crank": "crank", "linkage": {"flexible": "linkage", "modes": 4}}},
    "own part": {
        "mechanism": "four_bar",
        "bodies": {
            "coupler": {
                "flexible": "coupler.step",
                "origin": [0.1, -0.2],
                "faces": {"crank_pin": {"radius": 0.02, "z": [-0.1, 0.1]}, "knuckle": "bore"},
            }
        },
    },
    "groups": {
        "joints": {
            "crank_pin": {"kind": "lubricated", "film": {"law": "finite", "viscosity": 0.1}},
            "knuckles": {"kind": "dry", "clearance": 5e-5},
            "ball_left": "dry",
        }
    },
    "oil": {
        "mechanism": "slider_crank",
        "joints": {
            "crank_pin": {"kind": "lubricated", "film": {"oil": {"conductance": 1.0}}},
            "shaft": "lubricated",
        },
        "film": {
            "oil": {"viscosity_cst": [68.0, 8.7], "density": 870.0, "supply_celsius": 40.0}
        },
    },
    "loads": {
        "bodies": {"linkage": "linkage"},
        "load": {
            "blanking": {**PULSE, "offset": [-0.1, 0]},
            "spring": {
                "kind": "table", "time": [0.0, 0.1], "force": [0.0, 1e3], "body": "link_7_left",
                "offset": [0.0, 0.1], "direction": [3, 4], "factor": 2.0,
            },
            "pin": {**PULSE, "body": "linkage", "joint": "slide_pin"},
            "two": {
                **PULSE, "body": "linkage", "face": [{"x": [0, 1]}, {"y": [0, 1], "z": [2, 3]}]
            },
        },
    },
    "grooves": {
        "film": {"law": "grooved", "grooves": [{"angle_deg": 90.0, "width_deg": 10.0}]},
    },
    "rubbing guides": {
        "mechanism": "slider_crank",
        "joints": {},
        "guide": {"friction": "lugre"},
        "friction": {"sigma_0": 2e4},
    },
    "worn": {
        "mechanism": "slider_crank",
        "joints": {
            "crank_pin": {
                "kind": "dry",
                "worn": {"angle_deg": [0.0, 90.0, 180.0], "bearing_depth": [0.0, 1e-6, 0.0]},
            },
            "shaft": {"kind": "dry", "worn": {"journal_depth": [0.0, 1e-6, 0.0]}},
        },
    },
    "schedule": {
        "mechanism": "eccentric_press",
        "drive": {
            **SCHEDULE, "brake_off": [0.0, 0.03], "start_time": [0.05], "stop_time": [0.6]
        },
    },
}  # fmt: skip


@pytest.mark.parametrize("comments", [False, True])
@pytest.mark.parametrize("keys", SCENES.values(), ids=SCENES)
def test_round_trip(keys, comments, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)  # a STEP file's path is taken from the scene's directory
    scene = Scene.from_dict(keys)
    complete = scene.to_dict()
    assert json.loads(json.dumps(complete)) == complete == Scene.from_dict(complete).to_dict()
    scene.save("scene.toml", comments=comments)
    assert Scene.load("scene.toml") == scene
    assert hash(scene) == hash(Scene.load("scene.toml"))


def test_a_file_that_is_there_is_kept(tmp_path):
    path = tmp_path / "scene.toml"
    path.write_text("# mine\n")
    with pytest.raises(InputError, match=r"scene\.toml: exists.*overwrite=True"):
        Scene().save(path)
    assert path.read_text() == "# mine\n"
    Scene().save(path, overwrite=True)
    assert Scene.load(path) == Scene()
