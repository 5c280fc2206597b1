"""A figure's heading and text."""

from exu_press.plots.style import look
from exu_press.plots.title import figure_with_title


def test_heading_and_text_lie_within_a_narrow_figure():
    with look():
        figure = figure_with_title(
            "How well the measurement determines each key", "word " * 40, (3, 5)
        )
        figure.subplots()
        figure.draw_without_rendering()
    (heading,) = figure.artists
    for text in (heading, figure._suptitle):
        assert text.get_window_extent().x1 < figure.bbox.x1
