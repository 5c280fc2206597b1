"""The page of a study is made of its report, whatever kind of study it is."""

import json
from dataclasses import dataclass

import pytest
from browser import opened

from exu_press import Scene
from exu_press.cli import main
from exu_press.files.output_directory import REPORT_FILE
from exu_press.studies.base.report import Column, Line, Panel, Picture, Points, Report, Table

SCENE = Scene(mechanism="slider_crank", joints={"crank_pin": "ideal"}, revolutions=0.1)
HOSTILE = "<b>why</b>"


@dataclass(frozen=True)
class Trials(Report):
    """Four trials, one without a number."""

    name = "trials"
    as_points: bool = True

    title = "Four trials"
    scene = SCENE

    def tables(self):
        rows = [("100", "5"), ("150", "9"), ("200", HOSTILE), ("250", "-")]
        runs = Table("Trials", ("speed_rpm", "torque"), rows, ["above"], ["below"], of_points=True)
        return [runs, Table("Lines", above=["2 +- 1 um"])]

    def pictures(self):
        return [Picture("drawn", "A picture.", "nowhere:nothing")]

    def points(self):
        if not self.as_points:
            return None
        keys = [Column("speed_rpm", "", [100.0, 150.0, 200.0, 250.0])]
        torques = [Column("torque", "N m", [5.0, 9.0, 7.0, None])]
        return Points(keys, torques, [f"run {k}" for k in range(3)] + ["others beat"])

    def panels(self):
        measured = Line("<i>measured", [0.0, 1.0], [1.0, 2.0], True, [0.9, 1.9], [1.1, 2.1])
        return [Panel("Torque", "time, s", "N m", [measured, Line("fit", [0.0, 1.0], [1.0, 2.1])])]


def page_of(report, folder):
    report.save(folder)
    assert main(["report", str(folder), "--quiet"]) == 0
    return folder / "report.html"


def test_curves_lie_over_each_other(tmp_path, browser):
    pytest.importorskip("bokeh")
    report = page_of(Trials(as_points=False), tmp_path)
    with opened(browser, report, 390, 844) as page:
        assert page.locator("#viewer .plot canvas").count() >= 1
        scroll, width = page.evaluate(
            "() => [document.documentElement.scrollWidth, document.documentElement.clientWidth]"
        )
        assert scroll <= width
        assert "<i>measured" in page.inner_text("body")


def test_a_terminal_shows_an_excerpt_and_what_is_meant_for_it():
    rows = [(str(k), f"{k**2}") for k in range(4)]
    table = Table("", ("k", "square"), rows, ["first"], ["last"], right=True, excerpt=[0, 3])
    assert table.lines() == ["first", "k  square", "0       0", "3       9", "last"]


@pytest.mark.parametrize(
    "change",
    [
        {"tables": [{"title": "a"}, 3]},
        {"tables": [{"title": "a", "head": ["b"], "rows": [[3, 4]]}]},
        {"pictures": {"../drawn": "a"}},
        {"points": {"keys": 1}},
        {"points": None, "panels": [{"title": "a"}]},
        {"scene": {"mechanism": "nothing"}},
        {"title": None},
    ],
    ids=str,
)
def test_what_no_study_wrote_is_refused(tmp_path, capsys, change):
    Trials().save(tmp_path)
    report = json.loads((tmp_path / REPORT_FILE).read_text())
    (tmp_path / REPORT_FILE).write_text(json.dumps({**report, **change}))
    assert main(["report", str(tmp_path)]) == 2
    error = capsys.readouterr().err
    assert REPORT_FILE in error and "not a report of exu_press" in error
