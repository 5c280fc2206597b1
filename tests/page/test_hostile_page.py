"""Text from files is text."""

from dataclasses import replace

import pytest
from browser import opened
from page.conftest import page_of

from exu_press import Scene, simulate

pytest.importorskip("bokeh")

HOSTILE = (
    "</script><script>window.hacked = 1</script><img src=x onerror='window.hacked = 2'>"
    r"$$x$$ $\frac{$"
)


@pytest.fixture(scope="module")
def result():
    return simulate(Scene(mechanism="slider_crank", joints={"crank_pin": "dry"}, revolutions=0.02))


@pytest.fixture(autouse=True)
def no_pictures(monkeypatch):
    monkeypatch.setattr("exu_press.report.pictures.save_pictures", lambda *_: [])


def test_hostile_texts_of_a_run_run_nothing(result, tmp_path, browser):
    channels = {
        name: replace(channel, unit=HOSTILE, long_name=HOSTILE)
        for name, channel in result.channels.items()
    }
    channels[HOSTILE] = replace(channels["slider_velocity"])
    info = {**result.info, "reason": HOSTILE, "versions": {HOSTILE: HOSTILE}}
    page_file = page_of(replace(result, channels=channels, info=info), tmp_path)
    assert "<script>window.hacked" not in page_file.read_text(encoding="utf-8")
    with opened(browser, page_file) as page:
        page.select_option("#panel-0 select", HOSTILE)
        page.wait_for_timeout(100)
        assert page.evaluate("window.hacked") is None
        assert HOSTILE in page.inner_text("#panel-0 .values")


def test_an_injected_script_would_not_run(result, tmp_path, browser):
    """What the policy of the page keeps out, wherever it came from."""
    page_file = page_of(result, tmp_path)
    text = page_file.read_text(encoding="utf-8")
    page_file.write_text(text.replace("<h1>", "<script>window.hacked = 1</script><h1>", 1))
    with (
        pytest.raises(AssertionError, match="Content Security Policy"),
        opened(browser, page_file, live=False) as page,
    ):
        assert page.evaluate("window.hacked") is None
