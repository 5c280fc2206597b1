"""Quantities at points: equal points run once, failed runs are counted and never numbers."""

import numpy as np
import pytest

from exu_press import InputError, Scene
from exu_press.studies.base import Study
from exu_press.studies.base.evaluation import Evaluation, error_in

SCENE = Scene(mechanism="slider_crank", joints={"crank_pin": "ideal"}, revolutions=0.01, settle=0.0)
ROD, SPEED = "slider_crank.rod_length", "speed_rpm"
STUDY = Study(scene=SCENE, keys={ROD: {"low": 0.2, "high": 0.6}, SPEED: [100.0, 200.0]})


class Runs:
    """Rows that follow from scenes; a fast one fails, a faster one is too short."""

    def __init__(self):
        self.scenes = []

    def __call__(self, scenes):
        self.scenes += scenes
        return [self.row(scene) for scene in scenes]

    def row(self, scene):
        if scene.speed_rpm == 300.0:
            return {"status": "failed", "reason": "too fast"}
        stroke = None if scene.speed_rpm == 400.0 else scene.speed_rpm / 100.0
        return {"status": "completed", "reason": "", "stroke": stroke, "peak_velocity": 7.0}


def point(speed, rod=0.4):
    return {ROD: rod, SPEED: speed}


def test_failed_runs_are_counted_and_give_no_number():
    runs = Runs()
    evaluation = Evaluation(STUDY, ["stroke", "peak_velocity"], runs)
    found = evaluation([point(s) for s in (100.0, 300.0, 400.0, 100.0)] + [point(100.0, 0.001)])
    assert found[[0, 3]].tolist() == [[1.0, 7.0], [1.0, 7.0]]
    assert np.isnan(found[[1, 2, 4]]).all()
    assert (len(runs.scenes), len(evaluation.points)) == (3, 4)
    told = evaluation.run_summary()
    assert told[0] == "4 runs: 1 gave numbers, 3 did not"
    assert any("failed: too fast" in line for line in told)
    assert any("too short to have stroke" in line for line in told)
    assert any("not a scene" in line for line in told)
    evaluation([point(100.0)])
    assert len(runs.scenes) == 3
    evaluation([point(300.0, 0.5)])
    assert evaluation.run_summary()[1] == "  2 x failed; the first: too fast"


def test_a_quantity_that_the_scene_has_not():
    with pytest.raises(InputError, match="did you mean 'stroke'"):
        Evaluation(STUDY, ["strok"], Runs())


def test_the_error_of_what_is_not_determined_is_half_its_bounds():
    row = {
        "errors": {
            "a": {"error": 0.1, "determined": True, "low": 0.0, "high": 9.0},
            "b": {"error": 0.1, "determined": False, "low": 1.0, "high": 4.0},
        }
    }
    assert (error_in(row, "a"), error_in(row, "b"), error_in(row, "c")) == (0.1, 1.5, None)
