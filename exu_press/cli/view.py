"""Show a run in the browser, to zoom and to play; --save writes an animation or a picture."""

import argparse
import os
import tempfile
from pathlib import Path

from exu_press.cli.options import add_picture_arguments, demand_save
from exu_press.errors import InputError
from exu_press.report.find import find_output, find_run, report_of
from exu_press.result import Result
from exu_press.terminal.progress import Progress

__all__ = ["EXAMPLE", "add_arguments", "execute"]

EXAMPLE = "exu-press view out/press/run.nc --from 0.03 --to 0.05 --save animation.gif"

SAVE_OPTIONS = ("at", "slow", "frames", "fps", "colour", "exaggerate", "style")
"""They go with --save; in the page one chooses what they say."""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the command's arguments."""
    parser.add_argument(
        "path",
        metavar="PATH",
        help="a run.nc, or the directory that run wrote to; without --save also what report takes",
    )
    parser.add_argument(
        "--save",
        metavar="FILE",
        help="write .mp4 (needs ffmpeg), .gif, frames as frame_%%04d.png, or one picture as .png, "
        ".svg or .pdf; an existing file is replaced when the new one is complete",
    )
    parser.add_argument("--from", dest="start", type=float, metavar="S", help="begin (s)")
    parser.add_argument("--to", dest="stop", type=float, metavar="S", help="end (s)")
    parser.add_argument(
        "--at", type=float, metavar="S", help="one picture: when (s; default: the end)"
    )
    parser.add_argument(
        "--slow",
        type=float,
        metavar="N",
        help="seconds of animation for a second of the machine (default: a revolution takes 5 s)",
    )
    parser.add_argument("--frames", type=int, metavar="N", help="number of frames, instead")
    parser.add_argument("--fps", type=float, metavar="N", help="frames a second (default: 25)")
    parser.add_argument(
        "--colour",
        choices=("displacement", "stress"),
        help="quantity that the colours of flexible bodies show (default: displacement)",
    )
    parser.add_argument(
        "--exaggerate",
        type=float,
        metavar="N",
        help="factor of their deformation (default: one that makes it visible)",
    )
    add_picture_arguments(parser, to_files=False, on_paper=False)
    parser.add_argument("--quiet", action="store_true", help="print nothing but errors")


def execute(options: argparse.Namespace) -> int:
    """Show the page or write the animation; return 0."""
    if options.save is None:
        return _open(options)
    result = Result.load(find_run(options.path))
    target = Path(options.save)
    from exu_press.view.save import check_target, is_animation

    check_target(target)
    is_picture = not is_animation(target)
    if options.at is not None and not is_picture:
        raise InputError(f"--at {options.at:g}: allowed with --save of one picture, as FILE.png")
    for option in ("slow", "frames", "fps"):
        if is_picture and (value := getattr(options, option)) is not None:
            raise InputError(f"--{option} {value:g}: allowed for animations, not for a picture")
    for option, value in (("--colour", options.colour), ("--exaggerate", options.exaggerate)):
        if value is not None and not result.surfaces:
            raise InputError(f"{option} {value}: allowed for runs with flexible bodies alone")
    _write(result, target, is_picture, options)
    return 0


def _open(options: argparse.Namespace) -> int:
    """Write the page that report writes, and open it in the browser."""
    from exu_press.cli.report import name_missing_extra
    from exu_press.report.page_file import open_file, write_page

    demand_save(options, *SAVE_OPTIONS)
    kind, file = find_output(Path(options.path))
    page = write_page(report_of(kind, file, (options.start, options.stop)), _page_path(file))
    if not options.quiet:
        print(f"written: {page} ({page.stat().st_size / 1e6:.1f} MB)")
        name_missing_extra()
    open_file(page)
    return 0


def _page_path(file: Path) -> Path:
    """Return the file of a result's page: beside it, or temporary where that is read-only."""
    beside = file.parent / "report.html"
    if os.access(file.parent, os.W_OK):
        return beside
    return Path(tempfile.mkdtemp(prefix="exu_press_")) / beside.name


def _write(result: Result, target: Path, is_picture: bool, options: argparse.Namespace) -> None:
    from matplotlib.figure import Figure

    from exu_press.view import Animation, Look, instants, moment, save_animation, save_picture
    from exu_press.view.animation import SIZE

    flexible = Look(options.colour or "displacement", options.exaggerate)
    start, stop = options.start, options.stop
    speed = {"slow": options.slow, "frames": options.frames, "fps": options.fps}
    if is_picture:
        frames = moment(result, options.at, start, stop)
    else:
        frames = instants(result, start, stop, **{k: v for k, v in speed.items() if v is not None})
    animation = Animation(result, frames, Figure(figsize=SIZE), flexible)
    if is_picture:
        written = [save_picture(animation, 1, target)]
    else:
        with Progress("animation", len(frames), "frames", quiet=options.quiet) as progress:
            written = save_animation(animation, target, progress.update)
    if not options.quiet:
        more = f" to {written[-1].name}" if len(written) > 1 else ""
        print(f"written: {written[0]}{more}")
