"""The page in a real browser: what it shows against what the run's file holds."""

import re

import numpy as np
import pytest
from browser import opened

from exu_press.report import Page

pytest.importorskip("bokeh")

DRAWN = "name => Array.from(Bokeh.documents[0].get_model_by_name(name).data.y)"
RANGE = (
    "() => { const r = Bokeh.documents[0].get_model_by_name('x-range'); return [r.start, r.end]; }"
)


@pytest.fixture(scope="module")
def opened_once(report, browser):
    """The page that tests use one after the other; errors on its console end the last of them."""
    with opened(browser, report) as page:
        yield page


@pytest.fixture
def page(opened_once, press):
    """The page as it opens: the whole run, its begin at the pointer."""
    zoom(opened_once, 0.0, 1e3 * float(press.time[-1]))
    put(opened_once, 0.0)
    return opened_once


def put(page, milliseconds):
    """Put the slider somewhere, as a hand does."""
    page.evaluate(
        """x => { const s = document.getElementById('slider'); s.value = x;
           s.dispatchEvent(new Event('input')); }""",
        milliseconds,
    )


def zoom(page, low, high):
    """Show a part of the axis, ms, and wait for it to be drawn."""
    page.evaluate(
        """([start, end]) => new Promise(done => {
           Bokeh.documents[0].get_model_by_name('x-range').setv({start, end});
           requestAnimationFrame(() => requestAnimationFrame(done)); })""",
        [low, high],
    )


def shown(page, panel):
    """Return the number at the pointer."""
    text = page.inner_text(f"#panel-{panel} .values")
    return float(re.match(r"\S+", text)[0])


def test_the_shipped_press_is_small_and_opens_without_a_word(report, page):
    assert report.stat().st_size <= 6e6
    assert page.locator("canvas").count() >= 2
    assert page.locator("#mechanism .body").count() == 14
    assert not page.is_visible("#failed")


def test_values_at_the_slider_are_those_of_the_file(page, press):
    steps = np.linspace(0, len(press.time) - 1, 7).astype(int)
    for step in steps:
        put(page, 1e3 * press.time[step])
        for panel, (channel, factor) in enumerate(
            [("slider_position", 1e3), ("slider_velocity", 1), ("slider_acceleration", 1)]
        ):
            expected = factor * press[channel][step]
            largest = factor * np.abs(press[channel]).max()
            assert shown(page, panel) == pytest.approx(expected, rel=1e-5, abs=1e-6 * largest)
        force = np.linalg.norm(press["crank_pin_force"][step]) / 1e3
        assert shown(page, 3) == pytest.approx(force, rel=1e-5)
        assert float(page.evaluate("document.documentElement.dataset.time")) == pytest.approx(
            1e3 * press.time[step], abs=1e-9
        )


def test_no_zoom_loses_a_peak(page, press):
    """The line has the largest and the least value of whatever is shown, down to single steps."""
    time, values = 1e3 * press.time, press["slider_acceleration"]
    peak = float(time[np.argmax(np.abs(values))])
    for width in (500.0, 100.0, 10.0, 1.0, 0.1, 0.02):
        low, high = max(peak - 0.4 * width, 0.0), min(peak + 0.6 * width, time[-1])
        zoom(page, low, high)
        inside = (time >= low) & (time <= high)
        drawn = np.array(page.evaluate(DRAWN, "curve-2-0"))
        assert drawn.max() == pytest.approx(values[inside].max(), rel=1e-6)
        assert drawn.min() <= values[inside].min() + 1e-3
        if width <= 1.0:
            assert inside.sum() <= len(drawn) <= inside.sum() + 2
        assert len(drawn) < 8000


def test_the_next_impact_opens(page, press):
    put(page, 0.0)
    page.click("#next")
    told = page.inner_text("#mark")
    begin = float(re.search(r"from (\S+) to", told)[1])
    joint = re.search(r": ([^,]+(, \w+)?), touching", told)[1]
    name = joint.lower().replace(", ", "_").replace(" ", "_")
    first = press.time[np.argmax(press.joints[name].gap < 0)] * 1e3
    assert begin == pytest.approx(first, rel=1e-5)
    low, high = page.evaluate(RANGE)
    assert low < begin < high and high - low < 50.0
    page.keyboard.press("0")
    page.wait_for_timeout(50)
    assert page.evaluate(RANGE) == pytest.approx([0.0, 1e3 * press.time[-1]])


def test_pointer_slider_and_mechanism_are_one(page, press):
    """A pointer on the curves leads the slider, the slider the pointer, both the mechanism."""
    place = "() => document.querySelector('#mechanism .body').getAttribute('transform')"
    put(page, 100.0)
    before = page.evaluate(place)
    box = page.locator("#figure-1").bounding_box()
    page.mouse.move(box["x"] + 0.8 * box["width"], box["y"] + 0.5 * box["height"])
    now = float(page.evaluate("document.getElementById('slider').value"))
    assert 300.0 < now < 450.0
    assert shown(page, 1) == pytest.approx(
        np.interp(now, 1e3 * press.time, press["slider_velocity"]), abs=1e-4
    )
    assert page.evaluate(place) != before
    page.focus("#slider")
    page.keyboard.press("ArrowRight")
    after = float(page.evaluate("document.documentElement.dataset.time"))
    assert after == pytest.approx(1e3 * press.time[np.searchsorted(1e3 * press.time, now)])


def test_it_plays(page):
    """What is shown, 500 ms, in 10 s; paused, it stands."""
    time = "Number(document.documentElement.dataset.time)"
    put(page, 10.0)
    passed, moved = page.evaluate(
        """() => new Promise(done => {
        const play = document.getElementById('play'), begun = performance.now();
        play.click();
        setTimeout(() => { play.click(); done([performance.now() - begun,
          Number(document.documentElement.dataset.time) - 10]); }, 600); })"""
    )
    assert moved == pytest.approx(0.05 * passed, rel=0.5)
    stopped = page.evaluate(time)
    page.wait_for_timeout(100)
    assert page.evaluate(time) == stopped


def test_crank_angle_and_logarithm(page, press):
    """The last one, as axis and curves stay as it leaves them."""
    page.select_option("#axis", "angle")
    page.wait_for_timeout(50)
    assert page.evaluate(RANGE) == pytest.approx([0.0, 720.0], abs=0.01)
    page.check("#panel-2 input[type=checkbox]")
    drawn = np.array(page.evaluate(DRAWN, "curve-2-0"), dtype=float)
    assert np.nanmin(drawn) > 0.0
    assert np.nanmax(drawn) == pytest.approx(np.abs(press["slider_acceleration"]).max())
    page.select_option("#panel-0 select", "ball_left:gap")
    page.wait_for_timeout(100)
    gap = np.array(page.evaluate(DRAWN, "curve-0-0"))
    assert gap.min() == pytest.approx(1e6 * press.joints["ball_left"].gap.min(), rel=1e-4)


@pytest.mark.long
def test_it_runs_in_the_frame_of_a_notebook(report, tmp_path, browser):
    cell = tmp_path / "cell.html"
    cell.write_text(f"<body>{Page(report.read_text(encoding='utf-8'))._repr_html_()}</body>")
    with opened(browser, cell, live=False) as page:
        inner = page.frame_locator("iframe")
        inner.locator("html[data-ready]").wait_for(state="attached", timeout=20_000)
        assert inner.locator("#mechanism .body").count() == 14
