import numpy as np
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from exu_press import Scene
from exu_press.plots.typesetting import plain
from exu_press.plots.words import describe, early_stops


def test_a_scene_in_words():
    scene = Scene(
        joints={"crank_pin": {"kind": "lubricated", "clearance": 5e-5}, "balls": "dry"},
        speed_rpm=200,
        load={"blanking": {"kind": "blanking", "force": 1e4}},
    )
    words = describe([scene])
    for part in (
        "Press",
        "rigid bodies",
        "200 rpm",
        "crank pin lubricated, clearance 0.05 mm",
        "balls dry, clearance 0.1 mm",
        "blanking force 10 kN",
    ):
        assert part in words


def test_scenes_share_what_they_have_in_common():
    words = describe(
        [
            Scene(joints={"crank_pin": "ideal", "balls": "ideal"}),
            Scene(joints={"crank_pin": "dry", "balls": "dry"}),
        ]
    )
    assert "crank pin radial clearance 0.1 mm" in words
    assert "dry" not in words
    assert "ideal" not in words
    assert "rpm" not in describe([Scene(), Scene(speed_rpm=300)])
    elastic = {"guide": {"lateral_stiffness": 1e9}}
    assert "guides elastic" in describe([Scene().replace(elastic)] * 2)
    assert "guides" not in describe([Scene(), Scene().replace(elastic)])


def test_early_stops_are_named(results):
    assert early_stops({"a": results["dry"]}) == ""
    both = {"a": results["dry"], "b": results["stopped"]}
    assert early_stops(both).startswith("b: stopped early")
    assert "crank angle 18.00 deg" in early_stops(both)


@pytest.mark.parametrize("text", [r"$\frac{$", "5 $", r"a\$b$c$", "$$"])
def test_no_text_is_a_formula(text):
    """Matplotlib draws it, and draws the same as with formulas switched off."""

    def drawn(shown, **options):
        figure = Figure()
        figure.text(0.1, 0.5, shown, **options)
        FigureCanvasAgg(figure).draw()
        return np.asarray(figure.canvas.buffer_rgba())

    assert np.array_equal(drawn(plain(text)), drawn(text, parse_math=False))
