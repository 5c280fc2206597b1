"""Empty figures of Bokeh, kept on disk."""

import json
import subprocess
import sys

import pytest

from exu_press.page.document import cached_figures

COLOURS = ("#005A9E", "#2BA84A")

READ = """
import sys
from exu_press.page.document import cached_figures
names = cached_figures("curve_panels", ("#005A9E", "#2BA84A"))["names"]
print(len(names), "bokeh.models" in sys.modules)
"""


@pytest.fixture
def cache(tmp_path, monkeypatch):
    monkeypatch.setenv("EXU_PRESS_CACHE", str(tmp_path))
    return tmp_path


def test_stored_figures_load_no_bokeh(cache):
    panels = cached_figures("curve_panels", COLOURS)
    stored = cached_figures("curve_panels", COLOURS)
    assert json.dumps(stored, allow_nan=False) == json.dumps(panels, allow_nan=False)
    assert len([*cache.iterdir()]) == 1
    assert cached_figures("curve_panels", COLOURS[:1]) != panels
    read = subprocess.run([sys.executable, "-c", READ], capture_output=True, text=True, check=True)
    assert read.stdout.split() == [str(len(panels["names"])), "False"]


def test_a_damaged_file_is_made_again(cache):
    panels = cached_figures("points_and_lines")
    (file,) = cache.iterdir()
    content = file.read_bytes()
    file.write_bytes(content[:200] + b"?" + content[201:])
    assert cached_figures("points_and_lines")["names"] == panels["names"]
    assert len(file.read_bytes()) == len(content)
