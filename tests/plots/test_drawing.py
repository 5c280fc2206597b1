"""The drawing of a mechanism: what is named, what is red."""

from dataclasses import replace

import numpy as np
import pytest
from matplotlib.colors import same_color
from matplotlib.patches import Polygon
from matplotlib.text import Text

from exu_press.mechanism import Press, SliderCrank, press, slider_crank
from exu_press.mechanism.examine import examine
from exu_press.plots.drawing import WRONG, drawing_figure


def words(axes):
    return [text.get_text() for text in axes.texts]


def red(axes):
    return [text.get_text() for text in axes.texts if same_color(text.get_color(), WRONG)]


def test_every_body_and_joint_is_named():
    mechanism = press(Press())
    drawing, *_ = drawing_figure(examine(mechanism), "text").axes
    found = ", ".join(words(drawing)).replace("\n", " ").replace(" (guided)", "").split(", ")
    assert sorted(found) == sorted(
        [*(b.name for b in mechanism.bodies), *(j.name for j in mechanism.joints)]
    )
    assert red(drawing) == []


def test_the_curves_are_those_of_the_mechanism():
    examined = examine(slider_crank(SliderCrank(crank_radius=0.05, rod_length=0.2)))
    _, position, velocity, *_ = drawing_figure(examined, "", 10.0).axes
    assert np.ptp(position.lines[0].get_ydata()) == pytest.approx(100.0)
    assert np.abs(velocity.lines[0].get_ydata()).max() == pytest.approx(0.515, abs=1e-3)


def test_loose_bodies_are_red_and_a_name_is_no_formula():
    drawn = replace(slider_crank(SliderCrank()), name=r"a $\frac{ b$ press", guides=())
    figure = drawing_figure(examine(drawn), "text")
    figure.draw_without_rendering()
    assert any(r"\frac{ b" in text.get_text() for text in figure.findobj(Text))
    (axes,) = figure.axes
    assert set(red(axes)) == {"rod", "slider", "wrist_pin"}
    edges = [p.get_edgecolor() for p in axes.patches if isinstance(p, Polygon)]
    assert sum(same_color(edge[:3], WRONG) for edge in edges) == 2
