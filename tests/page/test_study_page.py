"""A study's page: one run opens in the picture, over the keys and in the table."""

import numpy as np
import pytest
from browser import opened

from exu_press.report.html import page, table

pytest.importorskip("bokeh")

from exu_press.page.study import study_viewer
from exu_press.studies.base.report import Column, Points

HOSTILE = "<img src=x onerror='window.hacked=1'>$$x$$"
CLEARANCE = [1e-5, 1e-4, 1e-3, 1e-5, 1e-4, 1e-3]
KIND = ["dry", "dry", "dry", HOSTILE, HOSTILE, HOSTILE]
FORCE = [1.0, 2.0, 4.0, 3.0, None, 12.0]
SOURCE = """name => { const found = Bokeh.documents[0].get_model_by_name(name).data;
    return [[...found.x], [...found.y]]; }"""


@pytest.fixture(scope="module")
def study(tmp_path_factory):
    low = [None if f is None else 0.9 * f for f in FORCE]
    high = [None if f is None else 1.1 * f for f in FORCE]
    keys = [Column("clearance", "m", CLEARANCE), Column("kind", "", KIND)]
    quantities = [Column("force", "N", FORCE, low, high)]
    told = [f"--set clearance={c} {HOSTILE}" for c in CLEARANCE]
    live = study_viewer(Points(keys, quantities, told))
    cells = zip(CLEARANCE, KIND, FORCE, strict=True)
    rows = [[str(k), *map(str, row)] for k, row in enumerate(cells)]
    text = page(
        "study", "", [("Points", live), ("Runs", table(["run", "c", "k", "F"], rows, name="runs"))]
    )
    path = tmp_path_factory.mktemp("study") / "page.html"
    path.write_text(text, encoding="utf-8")
    return path


def test_every_run_with_a_number_is_a_point(study, browser):
    with opened(browser, study) as shown:
        x, y = shown.evaluate(SOURCE, "points-runs")
        assert sorted(zip(x, y, strict=True)) == sorted(
            (c, f) for c, f in zip(CLEARANCE, FORCE, strict=True) if f is not None
        )
        shown.check("#log-x")
        x, _ = shown.evaluate(SOURCE, "points-runs")
        assert sorted(set(np.round(x, 9))) == [-5.0, -4.0, -3.0]


def test_a_point_a_line_and_a_row_open_the_same_run(study, browser):
    chosen = "document.documentElement.dataset.chosen"
    with opened(browser, study) as shown:
        shown.click("#runs tbody tr:nth-child(3) button")
        assert shown.evaluate(chosen) == "2"
        assert shown.evaluate(SOURCE, "points-chosen") == [[1e-3], [4.0]]
        assert "--set clearance=0.001" in shown.inner_text("#chosen")
        box, place = (
            shown.locator("#points").bounding_box(),
            shown.evaluate(
                """() => { const m = Bokeh.documents[0].get_model_by_name('points');
            const f = Bokeh.index.get_by_id(m.id).frame;
            return [f.x_scale.compute(1e-3), f.y_scale.compute(12)]; }"""
            ),
        )
        shown.mouse.click(box["x"] + place[0], box["y"] + place[1])
        assert shown.evaluate(chosen) == "5"
        assert shown.locator("#runs tr.chosen th").inner_text() == "5"
        assert shown.evaluate("window.hacked") is None


def test_a_range_on_an_axis_keeps_the_runs_in_it(study, browser):
    with opened(browser, study) as shown:
        box, ends = (
            shown.locator("#parallel").bounding_box(),
            shown.evaluate(
                """() => { const m = Bokeh.documents[0].get_model_by_name('parallel');
            const f = Bokeh.index.get_by_id(m.id).frame;
            return [f.x_scale.compute(2), f.y_scale.compute(0.2), f.y_scale.compute(1.05)]; }"""
            ),
        )
        shown.mouse.move(box["x"] + ends[0], box["y"] + ends[1])
        shown.mouse.down()
        shown.mouse.move(box["x"] + ends[0], box["y"] + ends[2], steps=4)
        shown.mouse.up()
        _, y = shown.evaluate(SOURCE, "points-runs")
        assert sorted(y) == [4.0, 12.0]  # from 0.2 of 1 to 12 on: 3.2
        shown.click("#clear")
        assert len(shown.evaluate(SOURCE, "points-runs")[1]) == 5
