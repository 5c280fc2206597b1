"""Steps that do not resolve the impacts of a run say so."""

import re

import numpy as np
import pytest

from exu_press import Scene, simulate
from exu_press.mechanism.press import PAPER_LAWS

DRY = {
    "mechanism": "slider_crank",
    "joints": {"crank_pin": "dry"},
    "revolutions": 0.1,
    "start": "centred",
    "contact": PAPER_LAWS["contact"],
    "friction": PAPER_LAWS["friction"],
}
REASON = re.compile(
    r"under-resolved at t = (\S+) s, crank angle (\S+) deg: (\d+)% of the largest inertia force "
    r"\((slider|rod)\) within a step of (\S+) s; peaks are the step's; "
    r"try solver\.(step|tolerance) = (\S+)"
)


def run(**changes):
    return simulate(Scene.from_dict(DRY).replace(changes))


def peak(result):
    return np.abs(result["slider_acceleration"]).max()


@pytest.fixture(scope="module")
def reference():
    resolved = run(**{"solver.tolerance": 3e-4})
    assert resolved.info["status"] == "completed"
    return resolved


def test_a_step_that_leaps_over_impacts_names_one_that_does_not(reference):
    coarse = run(**{"solver.step": 2e-4})
    assert coarse.completed, "it reached its end"
    assert coarse.info["status"] == "under-resolved"
    match = REASON.fullmatch(coarse.info["reason"])
    assert match, coarse.info["reason"]
    assert peak(coarse) < 0.6 * peak(reference), "and its peak is the step's"
    assert match[6] == "step"
    fine = run(**{"solver.step": float(match[7])})
    assert fine.info["status"] == "completed", fine.info["reason"]
    assert peak(fine) == pytest.approx(peak(reference), rel=0.03)


@pytest.mark.parametrize(
    "changes",
    [
        {"solver.step": 1e-3, "contact.damping_max": 0.0},  # soft: the impact lasts many steps
        {"solver.step": 1e-3, "joints": {}},
    ],
    ids=str,
)
def test_resolved_runs_are_completed(changes):
    assert run(**changes).info["status"] == "completed"


def test_a_pulse_shorter_than_the_step_is_not_resolved_either():
    load = {
        "load.blanking.kind": "blanking",
        "load.blanking.force": 1e6,
        "load.blanking.rise": 1e-4,
        "load.blanking.fall": 2e-4,
    }
    changes = {"joints": {}, "load.blanking.end_angle_deg": 20.0, **load}
    leapt = run(**changes, **{"solver.step": 1e-3})
    assert leapt.info["status"] == "under-resolved"
    assert leapt["load_blanking_force"].max() < 0.9e6, "the pulse's peak was missed"
    advice = re.search(r"load\.blanking .* try solver\.step = (\S+)", leapt.info["reason"])
    fine = run(**changes, **{"solver.step": float(advice[1])})
    assert fine.info["status"] == "completed"
    assert fine["load_blanking_force"].max() > 0.9e6
    assert run(**changes).info["status"] == "completed", "a tolerance steps on its corners"
