"""Short runs of every kind of scene, made once."""

import dataclasses

import pytest
from on_demand import OnDemand

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
        "guide": {"lateral_stiffness": 1e9},
        "start_angle_deg": 80.0,
        "revolutions": 0.6,
        "load": {"blanking": {"kind": "blanking", "force": 1e4, "offset": [0.1, 0.0]}},
    },
    "slider_crank": {"mechanism": "slider_crank", "joints": {"crank_pin": "dry"}},
}


STOPPED = {"stopped": ("lubricated", 200), "stopped at once": ("dry", 1)}
"""Run that an interruption cuts -> the whole run, and the number of instants that are left."""


@pytest.fixture(scope="session")
def results() -> dict[str, Result]:
    def run(label):
        if label in STOPPED:
            whole, count = STOPPED[label]
            return cut(runs[whole], count)
        return simulate(Scene(**{"revolutions": 0.3, "solver": {"step": 2e-4}} | SCENES[label]))

    runs = OnDemand(run)
    return runs


def cut(result: Result, count: int) -> Result:
    """Return a run as an interruption leaves it."""
    reason = "interrupted at t = 0.0125 s, crank angle 18.00 deg"
    info = {**result.info, "status": "interrupted", "reason": reason}
    cut = result.with_values({name: result[name][:count] for name in result})
    return dataclasses.replace(cut, info=info)
