"""The paper's results as data: complete, and beside runs that exist."""

from dataclasses import replace

import pytest

from paper.published import published, stated
from paper.runs import paper_runs
from paper.trends import TRENDS


def test_names_are_unique():
    names = [entry.name for entry in (*published().numbers, *published().trends)]
    assert len(set(names)) == len(names)
    assert len(published().numbers) >= 17


@pytest.mark.parametrize("rigid_only", [False, True])
def test_every_number_and_trend_has_its_runs(rigid_only):
    runs = paper_runs(rigid_only=rigid_only)
    paper = published().beside("rigid" if rigid_only else "flexible")
    assert {number.run for number in paper.numbers} <= runs.keys()
    assert {run for trend in paper.trends for run in trend.runs} <= runs.keys()
    assert {trend.stated for trend in paper.trends} <= TRENDS.keys()


def test_beside_rigid_runs_nothing_is_said_of_flexible_against_rigid():
    names = {trend.name for trend in published().trends}
    rigid = {trend.name for trend in published().beside("rigid").trends}
    assert names - rigid == {"flexibility_against_rigid"}


def test_runs_are_those_of_section_5():
    runs = paper_runs()
    for name, scene in runs.items():
        small = "load" in name or name.startswith("10 kN")
        expected = 1e-5 if small else 1e-4
        if name.startswith("clearance"):
            expected = float(name.split()[1]) * 1e-3
        for joint in scene.joints.with_clearance.values():
            assert joint.clearance == pytest.approx(expected), name
        assert bool(scene.load) == ("kN" in name), name
    assert runs["500 rpm"].speed_rpm == 500.0
    assert runs["blanking 40 kN"].load["blanking"].force == 4e4
    same = runs["200 rpm"].replace(speed_rpm=240.0)
    assert runs["clearance 0.1 mm"] == same
    assert replace(runs["no load, dry, rigid"], bodies={}).joints["crank_pin"].kind == "dry"


def test_what_is_measured_on_the_machine_is_not_what_the_paper_computed():
    assert stated("no load, lubricated, flexible", "peak_acceleration") == 29.4
    assert stated("clearance 0.1 mm", "peak_acceleration") is None
