"""The runs of a study, asked in several calls and read where they are there; how keys vary."""

import numpy as np
import pytest

from exu_press import Scene
from exu_press.parallel import FILE
from exu_press.studies.base import Normal, Runs, Study

SCENE = Scene(joints={"crank_pin": "ideal", "balls": "ideal"}, revolutions=0.01)
STUDY = Study(scene=SCENE, keys={"speed_rpm": {"low": 100.0, "high": 300.0}})


def test_calls_share_processes_and_rows(tmp_path, capsys):
    scenes = [STUDY.scene_at({"speed_rpm": speed}) for speed in (100.0, 200.0, 300.0)]
    with Runs(STUDY, tmp_path, workers=1) as runs:
        first = runs.run_scenes(scenes[:2])
        again = runs.run_scenes([scenes[2], *scenes[:2]])
    assert again[1:] == first
    assert len((tmp_path / FILE).read_text().splitlines()) == 3
    with Runs(STUDY, tmp_path, workers=1, quiet=False) as runs:
        assert runs.run_scenes(scenes) == [*first, again[0]]
    assert capsys.readouterr().err == "study: runs that are finished: 3\n"
    assert len((tmp_path / FILE).read_text().splitlines()) == 3


def test_a_normal_distribution_has_its_mean_and_deviation():
    shares = (np.arange(100_000) + 0.5) / 100_000
    values = Normal(mean=3.0, deviation=0.5).quantile(shares)
    assert (values.mean(), values.std()) == (pytest.approx(3.0), pytest.approx(0.5, rel=1e-3))
    assert Normal(mean=3.0, deviation=0.5, low=2.9).quantile(shares).min() >= 2.9
