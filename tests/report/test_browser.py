"""Reports in a real browser, without a display."""

import pytest
from browser import opened

SHOW = "() => document.querySelectorAll('.turned').forEach(box => { box.checked = true; })"


@pytest.mark.parametrize(
    "name",
    [
        "run",
        pytest.param("compare", marks=pytest.mark.long),
        pytest.param("sweep", marks=pytest.mark.long),
    ],
)
def test_a_report_fits_a_laptop_and_a_phone_where_a_tap_enlarges_a_picture(pages, browser, name):
    live = 'id="viewer"' in pages[name].read_text(encoding="utf-8")
    with opened(browser, pages[name], 1280, 800, live) as page:
        page.evaluate(SHOW)
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
        page.set_viewport_size({"width": 390, "height": 800})
        page.wait_for_timeout(150)
        image = "document.images[0].getBoundingClientRect().width"
        before = page.evaluate(image)
        page.locator("figure img").first.click()
        scroll, width = page.evaluate(
            "() => [document.documentElement.scrollWidth, document.documentElement.clientWidth]"
        )
        assert scroll <= width <= 390
        assert before < width
        assert page.evaluate(image) == page.evaluate("document.images[0].naturalWidth") > 1000


def test_the_browser_tells_errors(tmp_path, browser):
    """What the tests above rely on: a broken page is told from a good one."""
    broken = tmp_path / "page.html"
    broken.write_text('<body><img src="no.png"><script>nothing()</script></body>')
    with pytest.raises(AssertionError, match="nothing"), opened(browser, broken, live=False):
        pass
