"""Runs of several scenes beside each other."""

import time
from collections import deque

import pytest

from exu_press import InputError, Scene
from exu_press.verification import side_by_side
from exu_press.verification.run import simulate_with_errors
from exu_press.verification.side_by_side import simulate_side_by_side

SCENES = {
    kind: Scene(mechanism="slider_crank", joints={"crank_pin": kind}, revolutions=0.01)
    for kind in ("dry", "lubricated")
}


def test_results_are_those_of_one_run_after_the_other():
    """In all digits, with their errors."""
    results = dict(simulate_side_by_side(SCENES))
    assert results.keys() == SCENES.keys()
    for label, scene in SCENES.items():
        alone = simulate_with_errors(scene, beside=False)
        assert results[label].info["errors"] == alone.info["errors"] != {}
        assert (results[label]["slider_velocity"] == alone["slider_velocity"]).all()


def test_without_errors_a_scene_is_run_once():
    (result,) = dict(simulate_side_by_side({"a": SCENES["dry"]}, errors=False)).values()
    assert result.completed and "errors" not in result.info


def test_a_scene_that_cannot_be_run_is_refused():
    off = SCENES["dry"].replace({"output.channels": ["no_such_channel"]})
    with pytest.raises(InputError, match="no_such_channel"):
        dict(simulate_side_by_side({"a": off}, errors=False))


def test_progress_says_what_runs(monkeypatch, capsys):
    monkeypatch.setattr(side_by_side, "SECONDS_BETWEEN_UPDATES", 1e-3)
    monkeypatch.setattr("exu_press.terminal.progress.SECONDS_BETWEEN_LINES", 0.0)
    longer = SCENES["dry"].replace({"revolutions": 0.1})
    dict(simulate_side_by_side({"a dry one": longer}, errors=False, quiet=False))
    lines = capsys.readouterr().err.splitlines()
    assert lines[0].startswith("a dry one: ") and lines[-1].startswith("a dry one: 100 %")


def test_flexible_and_rigid_runs_begin_in_turn():
    flexible = Scene(bodies={"crank": "crank"})
    rigid = flexible.replace({"bodies": {}})
    runs = [
        run
        for label, scene in (("r", rigid), ("f", flexible))
        for run in side_by_side._runs(label, scene, True)
    ]
    order = side_by_side._in_order_of_time(runs)
    assert [run.label for run in order] == ["f", "r"] * 3
    assert order[0].cost == max(run.cost for run in runs)


def test_the_time_left_counts_the_core_that_works_longest():
    """Two cores: a long run on one of them alone takes as long as both did for all others."""
    cores = object.__new__(side_by_side._Cores)
    runs = [side_by_side.Run("a", 1.0, SCENES["dry"], False, cost) for cost in (1.0, 1.0, 2.0)]
    now = time.monotonic()
    cores.done, cores.spent, cores._largest_share, cores._begin = 2.0, 20.0, 0.0, now - 10.0
    cores.under_way, cores._waiting = {0: (runs[2], 0.0, now)}, deque()
    assert cores.share_passed() == pytest.approx(10.0 / (10.0 + 20.0), rel=1e-3)
    cores.under_way, cores._waiting = {}, deque(runs[:2])
    cores._begin = now - 40.0
    assert cores.share_passed() == pytest.approx(40.0 / (40.0 + 20.0), rel=1e-3)
    cores._begin = now
    assert cores.share_passed() == pytest.approx(40.0 / 60.0, rel=1e-3), "it never falls"
