"""A real browser without a display, driven through playwright; for the tests of pages."""

import shutil
from contextlib import contextmanager

import pytest

BROWSER = next(
    filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome", "chrome"))),
    None,
)


def launched():
    """Yield a browser, or skip the test with the reason."""
    if BROWSER is None:
        pytest.skip("no browser: install chromium to test the pages in one")
    driver = pytest.importorskip(
        "playwright.sync_api", reason="no playwright: install exu-press[dev]"
    )
    with driver.sync_playwright() as play:
        flags = ["--no-sandbox", "--enable-unsafe-swiftshader"]
        browser = play.chromium.launch(executable_path=BROWSER, args=flags)
        yield browser
        browser.close()


@contextmanager
def opened(browser, path, width=1366, height=768, live=True, **context):
    """Open a page; at the end there must be no error on its console and no request to anywhere."""
    page = browser.new_page(viewport={"width": width, "height": height}, **context)
    told, asked = [], []
    page.on("console", lambda message: told.append(message.text) if message.type == "error" else 0)
    page.on("pageerror", lambda error: told.append(str(error)))
    page.on("request", lambda request: asked.append(request.url))
    page.goto(path.as_uri())
    if live:
        page.wait_for_selector("html[data-ready]", state="attached", timeout=60_000)
    try:
        yield page
        away = [url for url in asked[1:] if not url.startswith(("data:", "blob:"))]
        if told or away:
            raise AssertionError(f"console: {told}, requests: {away}")
    finally:
        page.close()
