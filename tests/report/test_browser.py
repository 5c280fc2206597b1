"""Reports in a real browser, without a display."""

import pytest
from browser import opened

SHOW = "() => document.querySelectorAll('.turned').forEach(box => { box.checked = true; })"
NAMES = ["run", "compare", "stopped", "sweep"]


def is_live(path):
    return 'id="viewer"' in path.read_text(encoding="utf-8")


@pytest.mark.parametrize("name", NAMES)
def test_a_report_opens_whole_and_fits_a_laptop(pages, browser, name):
    with opened(browser, pages[name], 1280, 800, is_live(pages[name])) as page:
        page.evaluate(
            "document.querySelectorAll('.turned').forEach(box => { box.checked = true; })"
        )
        told = page.evaluate(
            """() => { const images = [...document.images]; return {
            broken: images.filter(image => !(image.complete && image.naturalWidth > 0)).length,
            images: images.length,
            widest: Math.max(...images.map(image => image.getBoundingClientRect().right)),
            scroll: document.documentElement.scrollWidth,
            width: document.documentElement.clientWidth}; }"""
        )
        assert told["images"] >= 1 and told["broken"] == 0
        assert told["width"] > 1000
        assert told["scroll"] <= told["width"]
        assert told["widest"] <= told["width"]


@pytest.mark.parametrize("name", ["run", "compare", "sweep"])
def test_a_report_fits_a_phone_and_a_tap_enlarges_a_picture(pages, browser, name):
    with opened(browser, pages[name], 390, 800, is_live(pages[name])) as page:
        page.evaluate(
            "document.querySelectorAll('.turned').forEach(box => { box.checked = true; })"
        )
        image = "document.images[0].getBoundingClientRect().width"
        before = page.evaluate(image)
        page.locator("figure img").first.click()
        scroll, width = page.evaluate(
            "() => [document.documentElement.scrollWidth, document.documentElement.clientWidth]"
        )
        assert scroll <= width
        assert before < width
        assert page.evaluate(image) == page.evaluate("document.images[0].naturalWidth") > 1000


def test_the_browser_tells_errors(tmp_path, browser):
    """What the tests above rely on: a broken page is told from a good one."""
    broken = tmp_path / "page.html"
    broken.write_text('<body><img src="no.png"><script>nothing()</script></body>')
    with pytest.raises(AssertionError, match="nothing"), opened(browser, broken, live=False):
        pass
