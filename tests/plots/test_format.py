"""Figures for a paper: format, width, style, and colours that stay apart."""

import itertools
import re

import numpy as np
import pytest
from matplotlib.colors import to_rgb
from matplotlib.text import Text
from PIL import Image

from exu_press.cli import main
from exu_press.plots import energy_figure, force_figure, orbit_figure, slider_figure
from exu_press.plots.file import save_figure
from exu_press.plots.format import PictureFormat, drawn_as
from exu_press.plots.palette import COLOURS, line_of

COLOUR_BLIND = {
    "protanopia": ((0.152, 1.053, -0.205), (0.115, 0.786, 0.099), (-0.004, -0.048, 1.052)),
    "deuteranopia": ((0.367, 0.861, -0.228), (0.280, 0.673, 0.047), (-0.012, 0.043, 0.969)),
    "tritanopia": ((1.256, -0.077, -0.179), (-0.078, 0.931, 0.148), (0.005, 0.691, 0.304)),
}
"""On linear RGB, complete (Machado, Oliveira and Fernandes, IEEE TVCG 15 (2009) 1291-1298)."""


def linear(colour):
    rgb = np.array(to_rgb(colour))
    return np.where(rgb <= 0.04045, rgb / 12.92, ((rgb + 0.055) / 1.055) ** 2.4)


def lab(rgb):
    """CIE L*a*b* of linear RGB, white D65."""
    to_xyz = [[0.4125, 0.3576, 0.1804], [0.2127, 0.7152, 0.0722], [0.0193, 0.1192, 0.9503]]
    xyz = np.array(to_xyz) @ np.clip(rgb, 0.0, 1.0) / (0.9505, 1.0, 1.089)
    f = np.where(xyz > 0.008856, np.cbrt(xyz), 7.787 * xyz + 16.0 / 116.0)
    return np.array([116.0 * f[1] - 16.0, 500.0 * (f[0] - f[1]), 200.0 * (f[1] - f[2])])


def test_colours_stay_apart_in_grey_and_for_colour_blind_readers():
    """Five runs by lightness alone where their lines have one style."""
    for first, second in itertools.combinations(map(line_of, range(5)), 2):
        lightness = [lab(linear(line["color"]))[0] for line in (first, second)]
        if first["linestyle"] == second["linestyle"]:
            assert abs(lightness[0] - lightness[1]) > 15.0, (first, second)
    for first, second in itertools.combinations(COLOURS.values(), 2):
        lightness = abs(lab(linear(first))[0] - lab(linear(second))[0])
        assert lightness > 10.0, (first, second)
        for matrix in COLOUR_BLIND.values():
            seen = [lab(np.array(matrix) @ linear(colour)) for colour in (first, second)]
            assert np.linalg.norm(seen[0] - seen[1]) > 16.0, (first, second)


@pytest.mark.parametrize("width", [pytest.param("84mm", marks=pytest.mark.long), "17.4cm"])
def test_a_width_is_that_of_the_file_and_letters_are_those_of_a_paper(width, results, tmp_path):
    chosen = PictureFormat.from_texts("png", width, None, "default")
    with drawn_as(chosen):
        figure = slider_figure({"dry": results["dry"], "ideal": results["ideal"]})
        assert figure.get_suptitle() == "", "the paper's caption has the heading"
        columns = {round(axes.get_position().x0, 2) for axes in figure.axes}
        assert len(columns) == (1 if width == "84mm" else 2)
        texts = [axes.yaxis.label for axes in figure.axes]
        assert all(6.0 <= text.get_fontsize() <= 8.0 for text in texts)
        with Image.open(save_figure(figure, tmp_path / "a.png")) as image:
            assert image.width / image.info["dpi"][0] == pytest.approx(chosen.width, rel=0.01)


def overlapping_headings(figure):
    """Return the titles of panels that a note or a legend lies on, or nearly touches."""
    figure.draw_without_rendering()
    near = 12.0 * figure.dpi / 72.0
    overlapping = []
    for axes in figure.axes:
        title = axes._left_title
        others = [axes._right_title, *axes.texts, *filter(None, [axes.get_legend()])]
        boxes = [
            item.get_window_extent()
            for item in others
            if not hasattr(item, "get_text") or item.get_text()
        ]
        around = title.get_window_extent().padded(near, 0.0)
        if title.get_text() and any(around.overlaps(box) for box in boxes):
            overlapping.append(title.get_text())
    return overlapping


@pytest.mark.parametrize("width", [pytest.param(None, marks=pytest.mark.long), "84mm", "140mm"])
def test_no_heading_lies_on_another_one(width, results):
    with drawn_as(PictureFormat.from_texts("png", width, None, "default")):
        for figure in (
            slider_figure({"": results["dry"]}),
            force_figure({"": results["dry"]}),
            orbit_figure(results["dry"]),
            energy_figure(results["dry"]),
        ):
            assert overlapping_headings(figure) == []


LONG = "a_rather_long_variant_name_for_scene"


@pytest.mark.parametrize(
    ("width", "name", "columns"), [("84mm", "variant", 3), (None, LONG, 3), ("84mm", 3 * LONG, 1)]
)
def test_a_legend_outside_has_the_columns_that_fit(width, name, columns, results):
    labels = [f"{name}_{number}" for number in range(5)]
    with drawn_as(PictureFormat.from_texts("png", width, None, "default")):
        figure = force_figure(dict.fromkeys(labels, results["ideal"]))
    figure.draw_without_rendering()
    (legend,) = figure.legends
    box, texts = legend.get_window_extent(), legend.get_texts()
    assert box.x0 >= 0.0 and box.x1 <= figure.bbox.width
    assert len({text.get_window_extent().x0 for text in texts}) == columns
    assert ["".join(text.get_text().split()) for text in texts] == labels


@pytest.mark.parametrize("width", ["84mm", "140mm"])
def test_words_in_a_circle_stay_inside_it(width, results):
    with drawn_as(PictureFormat.from_texts("png", width, None, "default")):
        figure = orbit_figure(results["lubricated"])
    figure.draw_without_rendering()
    (inset,) = (axes for panel in figure.axes for axes in panel.child_axes)
    (panel,) = (axes for axes in figure.axes if inset in axes.child_axes)
    titles = (inset.title, inset._left_title, inset._right_title)
    (title,) = (text.get_window_extent() for text in titles if text.get_text())
    assert panel.bbox.x0 < title.x0 and title.x1 < panel.bbox.x1
    assert title.y1 < panel.bbox.y1
    ball = next(axes for axes in figure.axes if len(axes.texts) == 2)
    for text in ball.texts:
        corners = ball.transData.inverted().transform(text.get_window_extent().corners())
        assert np.linalg.norm(corners, axis=1).max() < 100.0, "um, of the clearance"


def test_svg_has_text_and_a_style_file_goes_before_our_settings(results, tmp_path):
    style = tmp_path / "journal.mplstyle"
    cycle = "cycler('color', ['tab:red', 'gray']) + cycler('linestyle', [':', '-.'])"
    style.write_text(f"axes.titlesize: 6.25\nfont.size: 12\naxes.prop_cycle: {cycle}\n")
    with drawn_as(PictureFormat.from_texts("svg", "84mm", str(style), "default")):
        figure = force_figure({"first": results["ideal"], "second": results["ideal"]})
        assert {axes._left_title.get_fontsize() for axes in figure.axes} == {6.25}
        sizes = [text.get_fontsize() for text in figure.findobj(Text)]
        assert min(size for size in sizes if size != 6.25) == pytest.approx(8.5 / 9.5 * 12)
        drawn = [(line.get_color(), line.get_linestyle()) for line in figure.axes[0].lines]
        assert drawn == [("tab:red", ":"), ("gray", "-.")]
        text = save_figure(figure, tmp_path / "force.svg").read_text()
    assert re.search(r"<text[^>]*>Drive torque</text>", text)


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["--format", "jpg"], "--format jpg: allowed are png, svg, pdf"),
        (["--width", "84"], "--width 84: allowed is a number with mm, cm or in"),
        (["--width", "3mm"], "allowed are 2 to 20 inch"),
        (["--style", "none.mplstyle"], "--style none.mplstyle: no such file"),
        (["--style", "bad.mplstyle"], "is no matplotlib style"),
        (["--style", "huge.mplstyle"], "matplotlib cannot draw with it"),
    ],
)
def test_what_is_no_format_is_refused_before_anything_runs(
    words, said, tmp_path, monkeypatch, capsys
):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "bad.mplstyle").write_text("no.such.key: 1\n")
    (tmp_path / "huge.mplstyle").write_text("font.size: 1e9\n")
    assert main(["run", "press", *words, "--out", "o"]) == 2
    assert said in capsys.readouterr().err and not (tmp_path / "o").exists()
