"""What a process draws beside a run: early pictures are taken of the same run alone."""

import signal
from dataclasses import dataclass, field
from functools import partial
from pathlib import Path

import pytest

from exu_press import Scene
from exu_press.cli.pictures_beside import PicturesBeside
from exu_press.errors import DiskFullError


@dataclass(frozen=True)
class Run:
    scene: Scene
    completed: bool = True
    channels: dict = field(default_factory=dict)


def test_a_finer_run_is_drawn_anew(tmp_path):
    asked = []
    pictures = PicturesBeside(
        lambda *request: asked.append(request) or partial(list, [1]), tmp_path
    )
    coarse, fine = Run(Scene()), Run(Scene().replace({"solver.tolerance": 1e-4}))
    pictures.draw_early(Run(Scene(), completed=False))
    pictures.draw(coarse, Path("out"))
    pictures.draw_early(coarse)
    pictures.draw(coarse, Path("out"))
    files = pictures.draw(fine, Path("out"))
    assert [request[1:] for request in asked[1:]] == [
        (coarse, Path("out"), None),
        (coarse, tmp_path),
        (coarse, Path("out"), tmp_path),
        (fine, Path("out"), None),
    ]
    assert files() == [1] and pictures.directories == {Path("out")}


def test_ctrl_c_leaves_no_half_request_and_a_full_disk_no_early_picture(tmp_path, monkeypatch):
    asked = []

    def begin(*request):
        signal.raise_signal(signal.SIGINT)  # in the midst of it
        asked.append(request)
        return list

    def save(*_):
        raise DiskFullError("full")

    pictures = PicturesBeside(lambda *_: list, tmp_path)
    pictures._begin = begin
    with pytest.raises(KeyboardInterrupt):
        pictures.draw_early(Run(Scene()))
    assert [request[1:] for request in asked] == [(Run(Scene()), tmp_path)]
    monkeypatch.setattr("exu_press.plots.save.save_early_pictures", save)
    assert asked[0][0](*asked[0][1:]) == []
