"""The page of the shipped press in the browser, at the impact with the largest force.

Run with: python scripts/page_picture.py [PICTURE.png]
"""

import argparse
import shutil
import tempfile
from pathlib import Path

from exu_press import Scene, simulate
from exu_press.cli.options import scene_path
from exu_press.report.run_report import run_report

CHANGES = ["film.law=finite", "film.viscosity=0.1"]
SIZE = {"width": 1366, "height": 1000}


def main():
    """Run the press, write its page, open it and take the picture."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("picture", nargs="?", default="out/page.png", help="where to write it")
    options = parser.parse_args()
    from playwright.sync_api import sync_playwright

    result = simulate(Scene.load(scene_path("press"), CHANGES), errors=True)
    with tempfile.TemporaryDirectory() as folder, sync_playwright() as play:
        path = Path(folder) / "page.html"
        path.write_text(run_report(result, "out/press/run.nc"), encoding="utf-8")
        browser = play.chromium.launch(
            executable_path=shutil.which("chromium"), args=["--no-sandbox"]
        )
        page = browser.new_page(viewport=SIZE, device_scale_factor=1.5)
        page.goto(path.as_uri())
        page.wait_for_selector("html[data-ready]", state="attached")
        page.evaluate("window.scrollTo(0, document.getElementById('viewer').offsetTop - 10)")
        page.click("#previous")
        page.click("#next")
        page.wait_for_timeout(500)
        target = Path(options.picture)
        target.parent.mkdir(parents=True, exist_ok=True)
        page.screenshot(path=target)
        browser.close()
    print(f"written: {target}")


if __name__ == "__main__":
    main()
