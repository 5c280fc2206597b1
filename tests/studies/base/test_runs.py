"""The runs of a study: asked in several calls, read again where they are there."""

import pytest

from exu_press import InputError, Scene
from exu_press.parallel import FILE
from exu_press.studies.base import Runs, Study

SCENE = Scene(joints={"crank_pin": "ideal", "balls": "ideal"}, revolutions=0.01)
STUDY = Study(scene=SCENE, keys={"speed_rpm": {"low": 100.0, "high": 300.0}})


def test_calls_share_processes_and_rows(tmp_path):
    scenes = [STUDY.scene_at({"speed_rpm": speed}) for speed in (100.0, 200.0, 300.0)]
    with Runs(STUDY, tmp_path, workers=1) as runs:
        first = runs.run_scenes(scenes[:2])
        again = runs.run_scenes([scenes[2], *scenes[:2]])
    assert again[1:] == first
    assert len((tmp_path / FILE).read_text().splitlines()) == 3
    with Runs(STUDY, tmp_path, workers=1) as runs:
        assert runs.run_scenes(scenes) == [*first, again[0]]
    assert len((tmp_path / FILE).read_text().splitlines()) == 3


def test_a_resumed_study_says_once_how_many_runs_it_has(tmp_path, capsys):
    scenes = [STUDY.scene_at({"speed_rpm": speed}) for speed in (100.0, 200.0)]
    for said in ("", "study: runs that are finished: 2\n"):
        with Runs(STUDY, tmp_path, workers=1, quiet=False) as runs:
            for scene in [*scenes, *scenes]:
                runs.run_scenes([scene])
        assert capsys.readouterr().err == said


def test_a_range_outside_of_what_the_scene_allows_is_refused():
    with pytest.raises(InputError, match=r"run with speed_rpm = -1\.0: speed_rpm = -1\.0: allowed"):
        Study(scene=SCENE, keys={"speed_rpm": {"low": -1.0, "high": 100.0}})
