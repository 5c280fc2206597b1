import shutil
import subprocess

import pytest
from PIL import Image

from exu_press.errors import InputError
from exu_press.view import instants, save_animation


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
