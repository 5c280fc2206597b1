"""The runs of a study, asked in several calls and read where they are there; how keys vary."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from exu_press import InputError, Scene
from exu_press.parallel import FILE
from exu_press.studies.base import Normal, Range, Runs, Study, Values
from exu_press.studies.base.keys import keys_from

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


ALL = {
    "film": {"viscosity": [0.1, 0.4], "length": {"low": 0.05, "high": 0.1}},
    "joints.crank_pin.clearance": {"low": 1e-5, "high": 1e-4, "log": True},
    "friction.mu_kinetic": {"mean": 0.1, "deviation": 0.02, "low": 0.0},
}


def test_each_form_and_its_place_in_nested_tables():
    keys = keys_from(ALL)
    assert keys == {
        "film.viscosity": Values((0.1, 0.4)),
        "film.length": Range(low=0.05, high=0.1),
        "joints.crank_pin.clearance": Range(low=1e-5, high=1e-4, log=True),
        "friction.mu_kinetic": Normal(mean=0.1, deviation=0.02, low=0.0),
    }
    assert keys_from({name: each.plain() for name, each in keys.items()}) == keys


@settings(deadline=None)
@given(st.floats(0.001, 0.999))
def test_shares_and_values_belong_to_each_other(share):
    for each in keys_from(ALL).values():
        if not isinstance(each, Values):
            value = each.quantile(np.array([share]))
            assert each.share(value) == pytest.approx([share], abs=1e-9)
            assert each.ends[0] <= value[0] <= each.ends[1]


def test_a_normal_distribution_has_its_mean_and_deviation():
    shares = (np.arange(100_000) + 0.5) / 100_000
    values = Normal(mean=3.0, deviation=0.5).quantile(shares)
    assert (values.mean(), values.std()) == (pytest.approx(3.0), pytest.approx(0.5, rel=1e-3))
    assert Normal(mean=3.0, deviation=0.5, low=2.9).quantile(shares).min() >= 2.9
