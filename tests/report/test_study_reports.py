"""Pages of optima and fits, from the files that those commands write."""

import json

import pytest
from browser import opened

from exu_press import Scene
from exu_press.cli import main
from exu_press.verification.distribution import Distribution

SCENE = Scene(mechanism="slider_crank", joints={"crank_pin": "ideal"}, revolutions=0.1)
TRIALS = """speed_rpm,drive.peak_torque,peak_velocity,front
100.0,5.0,1.0,1
150.0,9.0,0.9,0
200.0,7.0,2.0,1
250.0,,,0
"""


@pytest.fixture
def optimum(tmp_path):
    front = [{"keys": {"speed_rpm": rpm}, "quantities": {}} for rpm in (100.0, 200.0)]
    (tmp_path / "optimise.json").write_text(
        json.dumps({"front": front, "chosen": 1, "at_ends": []})
    )
    (tmp_path / "trials.csv").write_text(TRIALS)
    SCENE.save(tmp_path / "chosen.toml")
    return tmp_path


@pytest.fixture
def fitted(tmp_path):
    key = {"value": 3.0, "low": 2.0, "high": 4.0}
    key |= {"low_remark": "end of the range", "high_remark": ""}
    number = {"name": "<i>force", "value": 10.0, "uncertainty": 2.0, "computed": 13.0}
    told = {
        "keys": {"speed_rpm": key},
        "chi_square": 2.25,
        "degrees_of_freedom": 1.0,
        "measured": [{**number, "error_over_uncertainty": 0.6}],
        "largest_error_over_uncertainty": 0.6,
        "curves": {
            "torque": {
                "channel": "drive_torque",
                "unit": "N m",
                "across": "time, s",
                "at": [0.0, 1.0, 2.0],
                "measured": [1.0, 2.0, 3.0],
                "computed": [1.1, 2.1, 2.9],
            }
        },
        "profiles": {"speed_rpm": [[2.0, 4.0], [3.0, 0.0], [4.0, 4.0]]},
    }
    (tmp_path / "fit.json").write_text(json.dumps(told))
    SCENE.save(tmp_path / "fitted.toml")
    return tmp_path


def report_in(folder):
    assert main(["report", str(folder), "--quiet"]) == 0
    return folder / "report.html"


def test_a_point_of_the_front_opens_its_scene(optimum, browser):
    pytest.importorskip("bokeh")
    with opened(browser, report_in(optimum)) as page:
        page.click("#runs tbody tr:nth-child(3) button")
        assert "exu-press run front/02.toml" in page.inner_text("#chosen")
        page.click("#runs tbody tr:nth-child(2) button")
        assert "others beat" in page.inner_text("#chosen")


def test_the_table_of_trials(optimum):
    text = report_in(optimum).read_text(encoding="utf-8")
    assert "4 trials, 2 on the front" in text and "02.toml, chosen" in text


def test_measured_and_computed_lie_over_each_other(fitted, browser):
    pytest.importorskip("bokeh")
    with opened(browser, report_in(fitted), 390, 844) as page:
        assert page.locator("#viewer .plot canvas").count() >= 3
        scroll, width = page.evaluate(
            "() => [document.documentElement.scrollWidth, document.documentElement.clientWidth]"
        )
        assert scroll <= width
        assert "<i>force" in page.inner_text("body")
        assert "2 (end of the range)" in page.inner_text("body")
        assert "own error is up to 0.6 of an uncertainty" in page.inner_text("body")


@pytest.mark.parametrize(
    ("name", "content"), [("optimise.json", "{}"), ("fit.json", "{}"), ("fit.json", "[]")]
)
def test_what_no_study_wrote_is_refused(tmp_path, capsys, name, content):
    (tmp_path / name).write_text(content)
    (tmp_path / "trials.csv").write_text("a,front\n")
    assert main(["report", str(tmp_path / name)]) == 2
    assert name in capsys.readouterr().err


@pytest.mark.long
def test_every_point_of_a_section_is_in_the_diagram(tmp_path, browser):
    pytest.importorskip("bokeh")
    rows = [
        {"value": value, "status": "completed", "reason": "", "points": [[x, 0.0] for x in found],
         "in_words": f"period {len(found)}", "exponent": [-1.0, None, -0.5], "motion": "periodic"}
        for value, found in ((100.0, [0.5]), (200.0, [0.4, 0.6]))
    ]  # fmt: skip
    rows.append({"value": 300.0, "status": "failed", "reason": "<b>why"})
    for one in rows:
        one["second"] = 0.1
    told = {"key": "speed_rpm", "second_key": "film.viscosity", "branches": {"up": rows}}
    (tmp_path / "bifurcation.json").write_text(json.dumps(told))
    with opened(browser, report_in(tmp_path)) as page:
        found = page.evaluate(
            """() => { const d = Bokeh.documents[0].get_model_by_name('points-runs').data;
            return [[...d.x], [...d.y]]; }"""
        )
        assert found == [[100.0, 200.0, 200.0], [0.5, 0.4, 0.6]]
        assert "<b>why" in page.inner_text("body")


def motion():
    """What attractor.json has of four revolutions; one does not have the first figure."""
    scene = Scene(mechanism="slider_crank", joints={"crank_pin": "dry"})
    figures = {"stroke": [0.06, None, 0.07, 0.06], "peak_velocity": [1.0, 2.0, 3.0, 4.0]}
    known = {name: [v for v in each if v is not None] for name, each in figures.items()}
    exponent = {"per_revolution": -1.0, "low": None, "high": -0.5, "motion": "regular"}
    return {
        "scene": scene.to_dict(), "skip": 5, "revolutions": 4, "section_deg": 0.0,
        "period": {"in_words": "<i>1 revolution", "distances": [1e-3], "error": 1e-2},
        "lyapunov_exponent": {
            **exponent, "per_second": -4.0, "low_per_second": None, "high_per_second": -2.0,
        },
        "figures": figures, "units": {"stroke": "m", "peak_velocity": "m/s"},
        "distributions": {n: Distribution.from_values(each).to_dict() for n, each in known.items()},
        "points": [[0.1 * k, -0.1 * k] for k in range(4)],
    }  # fmt: skip


def test_every_revolution_of_a_long_run_is_in_its_page(tmp_path, browser):
    pytest.importorskip("bokeh")
    (tmp_path / "attractor.json").write_text(json.dumps(motion()))
    with opened(browser, report_in(tmp_path)) as page:
        found = page.evaluate(
            """() => { const d = Bokeh.documents[0].get_model_by_name('points-runs').data;
            return [[...d.x], [...d.y]]; }"""
        )
        assert found == [[0.0, 0.1, 0.2, 0.1 * 3], [0.0, -0.1, -0.2, -0.1 * 3]]
        text = page.inner_text("body")
        assert "<i>1 revolution" in text
        assert "below -2" in text
        assert "peak_velocity" in text


def test_a_long_run_without_its_points_is_refused(tmp_path, capsys):
    (tmp_path / "attractor.json").write_text(json.dumps({**motion(), "points": [], "figures": 3}))
    assert main(["report", str(tmp_path)]) == 2
    assert "not a motion of exu-press attractor" in capsys.readouterr().err
