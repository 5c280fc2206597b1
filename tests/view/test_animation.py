import dataclasses
import itertools

import numpy as np
import pytest
from matplotlib.text import Text

from exu_press.view import instants
from exu_press.view.animation import Painter

CASES = ["press", "slider_crank", "ideal", "flexible"]


def visible_texts(figure):
    return [t for t in figure.findobj(Text) if t.get_visible() and t.get_text().strip()]


@pytest.mark.parametrize("name", [*CASES[:3], pytest.param(CASES[3], marks=pytest.mark.long)])
def test_no_label_is_clipped_and_no_names_of_bodies_overlap(runs, animation, name):
    picture = animation(runs[name], instants(runs[name], frames=5))
    painter = Painter(picture, 100.0)
    painter.paint(3)
    renderer = picture.figure.canvas.get_renderer()
    width, height = picture.figure.bbox.size
    for text in visible_texts(picture.figure):
        box = text.get_window_extent(renderer)
        assert box.x0 >= -1 and box.y0 >= -1, text.get_text()
        assert box.x1 <= width + 1 and box.y1 <= height + 1, text.get_text()
    boxes = [text.get_window_extent(renderer) for text in picture.figure.axes[0].texts]
    for one, two in itertools.combinations(boxes, 2):
        assert not one.overlaps(two)


def test_a_body_that_leaves_the_picture_is_named_at_its_edge(runs, animation):
    """Matplotlib could not draw a text that is 1e92 pixels off."""
    run = runs["press"]
    channel = run.channels["body_position"]
    places = np.array(channel.values)
    places[0, :, 1] = 1e90
    moved = {"body_position": dataclasses.replace(channel, values=places)}
    flown = dataclasses.replace(run, channels={**run.channels, **moved})
    picture = animation(flown, instants(flown, frames=5))
    Painter(picture, 100.0)
    axes = picture.figure.axes[0]
    assert all(abs(text.get_position()[1]) < 1e3 for text in axes.texts)
