"""An animation as .mp4, .gif or numbered .png files, and a single picture; without a display."""

import errno
import itertools
import os
import re
import shutil
import subprocess
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import IO

import numpy as np
from matplotlib.colors import to_rgb
from PIL import Image
from PIL.PngImagePlugin import PngInfo

from exu_press.errors import DiskFullError, InputError
from exu_press.files.output_directory import FORMATS, check_writable, replacing
from exu_press.mechanism.shapes import COLOURS as BODIES
from exu_press.plots.file import png_texts, save_figure, write_png
from exu_press.plots.palette import COLOURS
from exu_press.plots.save import sources_of
from exu_press.view.animation import Animation, Painter
from exu_press.view.flexible_panel import COLOURS as SURFACES

__all__ = ["check_target", "is_animation", "save_animation", "save_picture"]

DPI = {".mp4": 150.0, ".gif": 75.0, ".png": 150.0}
KEPT_COLOURS = [
    *COLOURS.values(),
    *BODIES.values(),
    *(SURFACES(level) for level in np.linspace(0.0, 1.0, 64)),
    *(tuple(0.8 * rgb for rgb in SURFACES(level)[:3]) for level in np.linspace(0.0, 1.0, 48)),
]
"""Colours that a GIF has exactly, whether the first frame shows them or not."""

NUMBER = re.compile(r"%0?\d*d")
"""In a file name: the frame's number, as in frame_%04d.png."""

MOST_DIGITS = 9
"""Most digits of a frame's number."""

ALLOWED = ".mp4, .gif, .png with the frame's number, as in frame_%04d.png, or .png, .svg, .pdf"


def is_animation(path: Path) -> bool:
    """Return whether a name asks for all frames, not for one picture."""
    return path.suffix.lower() not in FORMATS or NUMBER.search(path.name) is not None


def check_target(path: Path) -> None:
    """Raise InputError if nothing can be written under this name, before anything is drawn."""
    if path.suffix.lower() not in (DPI if is_animation(path) else FORMATS):
        raise InputError(f"--save {path}: allowed is a name ending in {ALLOWED}")
    if path.suffix.lower() == ".mp4":
        _ffmpeg(path)
    if (number := NUMBER.search(path.name)) and int(number[0].strip("%d") or 0) > MOST_DIGITS:
        raise InputError(f"--save {path}: allowed are at most {MOST_DIGITS} digits of a frame")
    check_writable(path)


def save_picture(animation: Animation, frame: int, path: Path) -> Path:
    """Write one frame as .png, .svg or .pdf."""
    check_target(path)
    animation.show(frame)
    animation.freeze()
    return save_figure(animation.figure, path, sources_of({"": animation.result}))


def save_animation(
    animation: Animation, path: Path, report: Callable[[int], None] | None = None
) -> list[Path]:
    """Write all frames; return the files. An existing one is replaced only when complete.

    Args:
        animation: to be drawn.
        path: .mp4 (needs ffmpeg), .gif, or .png with the frame's number, as in frame_%04d.png.
        report: called with the number of frames done.

    Raises:
        InputError: the name is of another kind, ffmpeg is missing, or a file cannot be written.
    """
    check_target(path)
    kind = path.suffix.lower()
    painter = Painter(animation, DPI[kind])

    def frames() -> Iterator[Image.Image]:
        for frame in range(len(animation.instants)):
            yield painter.paint(frame)
            if report is not None:
                report(frame + 1)

    if kind == ".png":
        texts = png_texts(sources_of({"": animation.result}))
        return [_write_png(path, number, image, texts) for number, image in enumerate(frames())]
    with replacing(path) as partial:
        if kind == ".gif":
            _write_gif(partial, frames(), animation.instants.fps)
        else:
            _write_mp4(path, partial, frames(), animation.instants.fps)
    return [path]


def _write_png(path: Path, number: int, image: Image.Image, texts: PngInfo) -> Path:
    """Write a frame; its number stands in the name where this asks for it."""
    numbered = path.with_name(NUMBER.sub(lambda match: match[0] % number, path.name))
    with replacing(numbered) as partial:
        write_png(partial, image, DPI[".png"], texts)
    return numbered


def _write_gif(path: Path, frames: Iterator[Image.Image], fps: float) -> None:
    """Write a GIF with one palette throughout: nothing flickers, and it is small."""
    first = next(frames)
    palette = _palette(first)
    quantized = (
        image.quantize(palette=palette, dither=Image.Dither.NONE)
        for image in itertools.chain([first], frames)
    )
    start = next(quantized)
    start.save(
        path, format="gif", save_all=True, append_images=quantized, duration=1000.0 / fps, loop=0
    )


def _palette(image: Image.Image) -> Image.Image:
    """Return the colours that an animation is made of, and those of its first frame's blends."""
    fixed = [255, 255, 255]
    for colour in KEPT_COLOURS:
        fixed += [round(255 * component) for component in to_rgb(colour)]
    rest = image.quantize(256 - len(fixed) // 3, method=Image.Quantize.MEDIANCUT).getpalette()
    assert rest is not None
    palette = Image.new("P", (1, 1))
    palette.putpalette([*fixed, *rest][:768])
    return palette


def _ffmpeg(path: Path) -> str:
    program = shutil.which("ffmpeg")
    if program is None:
        raise InputError(
            f"--save {path}: .mp4 needs the program ffmpeg, which is not installed; "
            "allowed without it is .gif or .png"
        )
    return program


def _write_mp4(path: Path, partial: Path, frames: Iterator[Image.Image], fps: float) -> None:
    """Hand the frames to ffmpeg."""
    first = next(frames)
    command = [_ffmpeg(path), "-loglevel", "error", "-y", "-f", "rawvideo", "-pix_fmt", "rgb24"]
    command += ["-s", f"{first.width}x{first.height}", "-r", f"{fps:g}", "-i", "-", "-an"]
    command += ["-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2", "-pix_fmt", "yuv420p"]
    command += ["-movflags", "+faststart", "-f", "mp4", str(partial)]
    process = subprocess.Popen(command, stdin=subprocess.PIPE, stderr=subprocess.PIPE)
    _, messages = _feed(process, itertools.chain([first], frames))
    if process.returncode:
        last = (messages.decode(errors="replace").strip().splitlines() or ["no message"])[-1]
        if os.strerror(errno.ENOSPC) in last:
            raise DiskFullError(f"--save {path}: {last}")
        raise InputError(f"--save {path}: ffmpeg failed ({last})")


def _feed(process: "subprocess.Popen[bytes]", frames: Iterator[Image.Image]) -> tuple[bytes, bytes]:
    pipe: IO[bytes] | None = process.stdin
    assert pipe is not None
    try:
        for image in frames:
            pipe.write(image.tobytes())
    except BrokenPipeError:
        pass  # it ended early, and says why
    except BaseException:
        process.kill()
        process.communicate()
        raise
    return process.communicate()
