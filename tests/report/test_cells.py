"""What a notebook shows."""

import html
import re

import pytest

from exu_press import Scene, simulate
from exu_press.scene import mechanism_of


@pytest.fixture(scope="module")
def result():
    return simulate(Scene(mechanism="slider_crank", joints={"crank_pin": "dry"}, revolutions=0.02))


def test_a_scene_a_mechanism_and_a_result_show_what_they_are(result):
    shown = result.scene._repr_html_()
    assert re.search(r"revolutions.*0\.02", shown) and "gravity" not in shown
    assert '<img src="data:image/png;base64,' in mechanism_of(result.scene)._repr_html_()
    shown = result._repr_html_()
    stroke = result.quantity("stroke").value
    found = re.search(r"stroke, mm</th><td>([\d.]+)", shown)
    assert float(found[1]) == pytest.approx(1e3 * stroke, rel=1e-3)


def test_a_comparison_shows_what_differs(result):
    other = simulate(result.scene.replace({"joints.crank_pin.clearance": 3e-4}))
    both = result.compare(other, labels=("narrow", "<b>wide"))
    shown = both._repr_html_()
    assert "joints.crank_pin.clearance" in shown and "&lt;b&gt;wide" in shown
    assert "stroke, mm" in str(both)


def test_the_page_in_a_cell_is_a_frame_of_its_own(result, tmp_path, monkeypatch):
    monkeypatch.setattr("exu_press.report.pictures.save_pictures", lambda *_: [])  # as in any page
    page = result.view()
    cell = page._repr_html_()
    assert cell.startswith("<iframe") and "allow-same-origin" not in cell
    inner = re.search(r'srcdoc="([^"]*)"', cell)[1]
    assert html.unescape(inner) == page.text
    assert page.save(tmp_path / "page.html").read_text(encoding="utf-8") == page.text
