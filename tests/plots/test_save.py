import sys
import time
from functools import partial

import numpy as np
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from PIL import Image

from exu_press.errors import InputError
from exu_press.files.output_directory import PICTURES
from exu_press.plots import save_pictures
from exu_press.plots.file import draw_figures, read_sources
from exu_press.plots.format import PictureFormat, drawn_as
from exu_press.plots.save import save_early_pictures

linux = pytest.mark.skipif(sys.platform != "linux", reason="no process is copied there")

EVERY = [f"{name}.png" for name in PICTURES["run"]]


def assert_pictures(paths):
    for path in paths:
        with Image.open(path) as image:
            assert image.format == "PNG"
            assert image.width == 1950  # 13 inch at 150 dpi
            assert image.info["dpi"] == pytest.approx((150, 150), abs=0.1)
        assert 15e3 < path.stat().st_size < 400e3


def test_pictures_of_a_run(results, tmp_path, monkeypatch):
    """Of which one is written: each costs half a second."""

    names = []

    def save_one(draws, folder, *_):
        names.extend(draws)
        return draw_figures({"force": draws["force"]}, folder)

    monkeypatch.setattr("exu_press.plots.save.draw_figures", save_one)
    with drawn_as(PictureFormat(everything=True)):
        (path,) = save_pictures(results["stopped at once"], tmp_path)
    assert [f"{name}.png" for name in names] == EVERY
    assert path.name == "force.png"
    assert list(tmp_path.iterdir()) == [path]
    assert_pictures([path])


def test_an_orbit_that_was_drawn_early_is_copied(results, tmp_path, monkeypatch):
    early, result = tmp_path / "early", results["dry"]
    early.mkdir()
    (file,) = save_early_pictures(result, early)
    monkeypatch.setattr(
        "exu_press.plots.save.draw_figures",
        lambda draws, folder, *_: [*map(folder.joinpath, draws)],
    )
    files = save_pictures(result, tmp_path, early)
    assert [path.stem for path in files] == ["slider", "orbit", "force"]
    assert files[1] == tmp_path / file.name and files[1].read_bytes() == file.read_bytes()
    monkeypatch.setattr("exu_press.plots.save.MOST_JOINTS", 0)  # the rest has a table with errors
    assert save_early_pictures(result, early) == []


@pytest.mark.parametrize("copied", [pytest.param(True, marks=linux), False])
def test_a_file_has_the_pixels_of_its_figure(copied, tmp_path, monkeypatch):
    """Also where it is drawn in another process, beside the first one."""
    monkeypatch.setattr("fe_models.processes.may_copy", lambda: copied)
    figure = draw_stripes(7)
    canvas = FigureCanvasAgg(figure)
    figure.set_dpi(150)
    canvas.draw()
    pixels = np.asarray(canvas.buffer_rgba())[:, :, :3]
    for path in draw_figures({name: partial(draw_stripes, 7) for name in ("a", "b")}, tmp_path):
        with Image.open(path) as image:
            assert np.array_equal(np.asarray(image), pixels)


def draw_stripes(number):
    """Return a figure of odd width with stripes in all colours."""
    figure = Figure(figsize=(1.01, 0.5))
    figure.add_axes((0.0, 0.0, 1.0, 1.0)).imshow(np.arange(number * 3).reshape(3, number))
    return figure


def draw_blank(number):
    if number < 0:
        raise InputError("no figure of a number below zero")
    return Figure(figsize=(number, 1.0))


def test_figures_are_drawn_beside_each_other(tmp_path):
    """Sizes, order and provenance are those of one after the other; an error is the picture's."""
    sources = {"simulated": {"version": "1.0"}}
    draws = {f"width{number}": partial(draw_blank, number) for number in (3, 1, 2)}
    paths = draw_figures(draws, tmp_path, sources)
    assert [path.name for path in paths] == ["width3.png", "width1.png", "width2.png"]
    for path, number in zip(paths, (3, 1, 2), strict=True):
        with Image.open(path) as image:
            assert image.width == 150 * number
        assert read_sources(path) == sources
    with pytest.raises(InputError, match="below zero"):
        draw_figures({**draws, "wrong": partial(draw_blank, -1)}, tmp_path)


class SlowFigure(Figure):
    def draw(self, _):
        time.sleep(60.0)


@linux
def test_an_error_leaves_no_half_picture_of_those_drawn_beside(tmp_path, monkeypatch):
    monkeypatch.setattr("os.cpu_count", lambda: 2)
    monkeypatch.setattr("fe_models.processes.may_copy", lambda: True)

    def fail():
        deadline = time.monotonic() + 30.0
        while not list(tmp_path.glob(".slow.png.*")) and time.monotonic() < deadline:
            time.sleep(0.01)
        assert list(tmp_path.glob(".slow.png.*"))
        raise InputError("no such figure")

    with pytest.raises(InputError, match="no such figure"):
        draw_figures({"first": fail, "slow": SlowFigure}, tmp_path)
    assert list(tmp_path.iterdir()) == []
