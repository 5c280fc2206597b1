"""Short runs of every kind of scene, made once."""

import dataclasses

import pytest

from exu_press import Result, Scene, simulate

SCENES = {
    "ideal": {"joints": {}},
    "dry": {"joints": {"crank_pin": "dry", "balls": "dry"}},
    "lubricated": {
        "joints": {"crank_pin": "lubricated", "balls": "dry"},
        "load": {"blanking": {"kind": "blanking", "force": 1e4}},
    },
    "elastic": {
        "joints": {"balls": "dry"},
        "guide": {},
        "start_angle_deg": 80.0,
        "revolutions": 0.6,
        "load": {"blanking": {"kind": "blanking", "force": 1e4, "offset": [0.1, 0.0]}},
    },
    "slider_crank": {"mechanism": "slider_crank", "joints": {"crank_pin": "dry"}},
}


@pytest.fixture(scope="session")
def results() -> dict[str, Result]:
    runs = {
        label: simulate(Scene(**{"revolutions": 0.3, "solver": {"step": 1e-4}} | scene))
        for label, scene in SCENES.items()
    }
    runs["stopped"] = cut(runs["lubricated"], 200)
    runs["stopped at once"] = cut(runs["dry"], 1)
    return runs


def cut(result: Result, count: int) -> Result:
    """Return a run as an interruption leaves it."""
    channels = {
        name: dataclasses.replace(channel, values=channel.values[:count])
        for name, channel in result.channels.items()
    }
    reason = "interrupted at t = 0.0125 s, crank angle 18.00 deg"
    info = {**result.info, "status": "interrupted", "reason": reason}
    return dataclasses.replace(result, channels=channels, info=info)
