"""Labels of animations, and files of them."""

import dataclasses
import itertools
import shutil
import subprocess

import numpy as np
import pytest
from matplotlib.text import Text
from PIL import Image

from exu_press.errors import InputError
from exu_press.view import instants, save_animation
from exu_press.view.animation import Painter


def test_gif_with_all_frames_at_their_speed(runs, animation, tmp_path):
    shown = instants(runs["ideal"], frames=4, fps=20.0)
    (path,) = save_animation(animation(runs["ideal"], shown), tmp_path / "a.gif")
    with Image.open(path) as image:
        assert (image.n_frames, image.info["duration"], image.size) == (4, 50, (960, 540))
    assert list(tmp_path.iterdir()) == [path]


def test_numbered_frames(runs, animation, tmp_path):
    shown = instants(runs["ideal"], frames=3)
    paths = save_animation(animation(runs["ideal"], shown), tmp_path / "f_%02d.png")
    assert [path.name for path in paths] == ["f_00.png", "f_01.png", "f_02.png"]
    assert len({path.read_bytes() for path in paths}) == 3


@pytest.mark.skipif(shutil.which("ffmpeg") is None, reason="ffmpeg is not installed")
def test_mp4_with_all_frames(runs, animation, tmp_path):
    done = []
    shown = instants(runs["ideal"], frames=4)
    (path,) = save_animation(animation(runs["ideal"], shown), tmp_path / "a.mp4", done.append)
    assert done == [1, 2, 3, 4]
    command = ["ffprobe", "-v", "error", "-count_frames", "-show_entries"]
    command += ["stream=width,height,nb_read_frames", "-of", "csv=p=0", str(path)]
    told = subprocess.run(command, capture_output=True, text=True, check=True).stdout
    assert told.strip() == "1920,1080,4"


def test_without_ffmpeg_it_says_what_is_left(tmp_path, monkeypatch, runs, animation):
    monkeypatch.setenv("PATH", str(tmp_path))
    with pytest.raises(InputError, match=r"needs the program ffmpeg.*allowed without it is \.gif"):
        save_animation(animation(runs["ideal"], instants(runs["ideal"])), tmp_path / "a.mp4")


def test_a_failing_ffmpeg_is_told_and_an_old_file_is_kept(tmp_path, monkeypatch, runs, animation):
    fake = tmp_path / "ffmpeg"
    fake.write_text("#!/bin/sh\necho 'no such codec' >&2\nexit 1\n")
    fake.chmod(0o755)
    monkeypatch.setenv("PATH", f"{tmp_path}:/bin:/usr/bin")
    target = tmp_path / "a.mp4"
    target.write_text("old")
    with pytest.raises(InputError, match=r"ffmpeg failed \(no such codec\)"):
        save_animation(animation(runs["ideal"], instants(runs["ideal"], frames=2)), target)
    assert target.read_text() == "old"
    assert {path.name for path in tmp_path.iterdir()} == {"ffmpeg", "a.mp4"}


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
