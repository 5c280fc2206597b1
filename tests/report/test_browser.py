"""Reports in a real browser, without a display."""

import json
import re
import shutil
import subprocess

import pytest

BROWSER = next(
    filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome", "chrome"))),
    None,
)
pytestmark = pytest.mark.skipif(
    BROWSER is None, reason="no browser: install chromium to test the reports in one"
)

FLAGS = [
    "--headless",
    "--no-sandbox",
    "--disable-gpu",
    "--disable-quic",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
    "--enable-logging=stderr",
    "--v=0",
    "--window-size=1280,800",
]

ASK = """<script>
addEventListener("load", () => {
  const images = [...document.images];
  document.documentElement.dataset.told = JSON.stringify({
    broken: images.filter(image => !(image.complete && image.naturalWidth > 0)).length,
    images: images.length,
    widest: Math.max(...images.map(image => image.getBoundingClientRect().right)),
    scroll: document.documentElement.scrollWidth,
    width: document.documentElement.clientWidth,
    loaded: performance.getEntriesByType("resource").map(entry => entry.name)
      .filter(name => !name.startsWith("data:")),
    headings: document.querySelectorAll("h2").length,
  });
});
</script>"""


@pytest.mark.parametrize("name", ["run", "compare", "stopped", "sweep"])
def test_a_report_opens_whole_and_fits_a_laptop(pages, tmp_path, name):
    page = tmp_path / "page.html"
    page.write_text(pages[name].read_text(encoding="utf-8").replace("</body>", f"{ASK}</body>"))
    command = [BROWSER, *FLAGS, f"--user-data-dir={tmp_path / 'profile'}", "--dump-dom"]
    done = subprocess.run(
        [*command, page.as_uri()], capture_output=True, text=True, timeout=120, check=True
    )
    console = [line for line in done.stderr.splitlines() if "CONSOLE" in line]
    assert console == []
    found = re.search(r'data-told="([^"]*)"', done.stdout)
    assert found is not None, "the page's script did not run"
    told = json.loads(found[1].replace("&quot;", '"'))
    assert told["images"] >= 1 and told["broken"] == 0
    assert told["headings"] >= 5
    assert told["loaded"] == []
    assert told["width"] > 1000
    assert told["scroll"] <= told["width"]
    assert told["widest"] <= told["width"]


TAP = """<script>
addEventListener("load", () => {
  const image = document.images[0];
  const before = image.getBoundingClientRect().width;
  image.click();
  document.documentElement.dataset.told = JSON.stringify({
    before: before,
    after: image.getBoundingClientRect().width,
    natural: image.naturalWidth,
    scroll: document.documentElement.scrollWidth,
    width: document.documentElement.clientWidth,
  });
});
</script>"""


@pytest.mark.parametrize("name", ["run", "compare", "sweep"])
def test_a_report_fits_a_phone_and_a_tap_enlarges_a_picture(pages, tmp_path, name):
    page = tmp_path / "page.html"
    page.write_text(pages[name].read_text(encoding="utf-8").replace("</body>", f"{TAP}</body>"))
    flags = [flag for flag in FLAGS if "window-size" not in flag] + ["--window-size=390,800"]
    command = [BROWSER, *flags, f"--user-data-dir={tmp_path / 'profile'}", "--dump-dom"]
    done = subprocess.run(
        [*command, page.as_uri()], capture_output=True, text=True, timeout=120, check=True
    )
    found = re.search(r'data-told="([^"]*)"', done.stdout)
    assert found is not None, "the page's script did not run"
    told = json.loads(found[1].replace("&quot;", '"'))
    assert told["width"] <= 500
    assert told["scroll"] <= told["width"]
    assert told["before"] < told["width"]
    assert told["after"] == told["natural"] > 1000


def test_the_browser_tells_errors(tmp_path):
    """What the test above relies on: a broken page is told from a good one."""
    page = tmp_path / "page.html"
    page.write_text('<body><img src="no.png"><script>nothing()</script></body>' + ASK)
    command = [BROWSER, *FLAGS, f"--user-data-dir={tmp_path / 'profile'}", "--dump-dom"]
    done = subprocess.run(
        [*command, page.as_uri()], capture_output=True, text=True, timeout=120, check=True
    )
    assert any("CONSOLE" in line and "nothing" in line for line in done.stderr.splitlines())
    assert "&quot;broken&quot;:1" in done.stdout
