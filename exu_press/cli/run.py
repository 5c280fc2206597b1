"""Run one scene: summary.json, run.nc and pictures."""

import argparse
import math
import sys
import textwrap
from collections.abc import Callable
from contextlib import ExitStack, nullcontext
from itertools import chain
from pathlib import Path

from exu_press.cli.continuation import start_path, start_state, with_start
from exu_press.cli.options import (
    add_error_argument,
    add_scene_arguments,
    directory_of,
    scene_of,
    show_warnings,
)
from exu_press.cli.pictures_beside import PicturesBeside, pictures_beside
from exu_press.errors import InputError
from exu_press.files.lock import lock_directory
from exu_press.files.output_directory import (
    COMPARED,
    RUN_FILE,
    checkpoint_directory,
    output_directory,
    remove_pictures,
    write_json,
)
from exu_press.model.state import State
from exu_press.quantities.remarks import run_lines
from exu_press.result import Result
from exu_press.result.checkpoint import refuse_blocks, remove, set_aside
from exu_press.scene import Scene
from exu_press.scene.assumptions import assumed_line
from exu_press.scene.warnings import scene_warnings
from exu_press.terminal.interrupt import postponed_interrupt
from exu_press.verification.refine import refinements
from exu_press.verification.simulate import simulate
from exu_press.verification.within import accuracy_lines, find_tolerance

__all__ = ["EXAMPLE", "add_arguments", "execute"]

EXAMPLE = "exu-press run press --set joints.crank_pin=dry --set gravity=0 --out out/dry"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the command's arguments."""
    add_scene_arguments(parser)
    add_error_argument(parser)
    parser.add_argument(
        "--within",
        metavar="ERROR",
        type=_share,
        help="find the tolerance that delivers this error, as in 1%%; where the motion is chaotic, "
        "the distribution over revolutions instead",
    )
    parser.add_argument(
        "--once",
        action="store_true",
        help="do not go on at a finer tolerance where headline quantities are not known within 5%%",
    )
    parser.add_argument(
        "--from",
        dest="start",
        metavar="RUN.nc",
        help="go on from the end of another run, or of the one in a directory, for as long as the "
        "scene says",
    )
    parser.add_argument(
        "--pictures",
        choices=("default", "all"),
        default="default",
        help="all: press and energy beside slider, orbit and force",
    )
    parser.add_argument("--figure", metavar="NAME", help="--within is for this figure alone")
    parser.add_argument(
        "--overwrite",
        action="store_true",
        help="delete the finished blocks that a killed run has left in the directory, and begin "
        "anew",
    )


def _share(text: str) -> float:
    """Return the share that a text as "1%" or "0.01" names."""
    try:
        value = float(text.removesuffix("%")) * (0.01 if text.endswith("%") else 1.0)
    except ValueError:
        value = math.nan
    if not 1e-5 <= value < 1.0:
        raise argparse.ArgumentTypeError(f"{text!r}: allowed is 0.001% or more, below 100%")
    return value


def _check_within(options: argparse.Namespace) -> None:
    """Refuse what does not go with --within, or not without it."""
    if options.within is None:
        if options.figure is not None:
            raise InputError(f"--figure {options.figure}: only together with --within")
        return
    apart = {"--from": options.start, "--once": options.once, "--no-error": options.no_error}
    if option := next((option for option, value in apart.items() if value), None):
        raise InputError(
            f"{option}: not together with --within, which needs errors and runs as often as it "
            "has to; remove one of the two"
        )


def execute(options: argparse.Namespace) -> int:
    """Run the scene; return 0, or 3 if it stopped early or was not resolved."""
    _check_within(options)
    with nullcontext() if options.no_pictures else pictures_beside() as pictures:
        scene = scene_of(options)
        start = None if options.start is None else start_path(options.start)
        state = None if start is None else start_state(start, scene)
        with lock_directory(output_directory(directory_of(options, options.scene))) as directory:
            if pictures is not None:
                pictures.prepare(scene)
            return _run(scene, start, state, directory, options, pictures)


def _make_room(directory: Path, start: Path | None, options: argparse.Namespace) -> Path | None:
    """Remove the finished blocks of an earlier run, or set them aside where --from goes on.

    Returns:
        Where the run of --from is then.

    Raises:
        InputError: it would be deleted, or blocks of another run would.
    """
    unfinished = checkpoint_directory(directory / RUN_FILE)
    resolved = None if start is None else start.resolve()
    goes_on = resolved == unfinished.resolve()
    if resolved == (directory / RUN_FILE).resolve() or (goes_on and options.overwrite):
        raise InputError(
            f"--from {start}: this run would delete the one that it goes on from; allowed is "
            "another directory: choose it with --out"
        )
    if options.overwrite:
        remove(unfinished)
    elif goes_on:
        start = set_aside(unfinished)
        if not options.quiet:
            print(f"the revolutions before are kept in {start}", file=sys.stderr)
    refuse_blocks(unfinished)
    return start


def _run_refined(
    scene: Scene,
    start: State | None,
    unfinished: Path,
    finished: Callable[[Result], object],
    *,
    quiet: bool,
) -> tuple[Result, bool, str]:
    """Run a scene, and at finer tolerances where that is needed.

    Args:
        finished: called with each run before its errors are known.

    Returns:
        The last finished run; whether Ctrl-C ended a finer one; what the user may do.
    """

    def announce(text: str) -> None:
        if not quiet:
            print("\n".join(textwrap.wrap(text, 100, subsequent_indent="  ")), file=sys.stderr)

    outcomes: list[tuple[Result, str]] = []
    interrupted = False
    try:
        for outcome in refinements(
            scene,
            start=start,
            unfinished=unfinished,
            quiet=quiet,
            announce=announce,
            finished=finished,
        ):
            outcomes.append(outcome)
    except KeyboardInterrupt:
        if not outcomes:
            raise
        interrupted = True
    result, remark = outcomes[-1]
    return result, interrupted, remark


def _run(
    scene: Scene,
    start: Path | None,
    state: State | None,
    directory: Path,
    options: argparse.Namespace,
    pictures: PicturesBeside | None,
) -> int:
    def draw_early(run: Result) -> None:
        if pictures is not None and state is None:  # with one, its pictures name its file
            pictures.draw_early(run)

    remarks: list[str] = []
    interrupted = False
    doubts = scene_warnings(scene)
    if not options.quiet:  # a drawing in mm may run for long
        show_warnings(doubts, directory / "summary.json")
    unfinished = checkpoint_directory(directory / RUN_FILE)
    start = _make_room(directory, start, options)
    if options.within is not None:
        delivered = find_tolerance(scene, options.within, options.figure, quiet=options.quiet)
        result, remarks = delivered.result, accuracy_lines(delivered, options.within)
    elif options.no_error or options.once:
        errors = not options.no_error
        result = simulate(
            scene, errors=errors, start=state, unfinished=unfinished, quiet=options.quiet
        )
    else:
        result, interrupted, remark = _run_refined(
            scene, state, unfinished, draw_early, quiet=options.quiet
        )
        remarks = [remark] if remark else []
    if start is not None:
        result = with_start(result, start)
    written = [directory / RUN_FILE, directory / "summary.json"]
    with ExitStack() as stack:
        with postponed_interrupt():
            summary = result.summary()
            remove_pictures(directory, "run")
            drawn = list if pictures is None else pictures.draw(result, directory)
            (directory / COMPARED).unlink(missing_ok=True)
            result.save(written[0])
            stack.callback(remove, unfinished)
            write_json(written[1], summary)
            if not options.quiet:
                assumed = textwrap.wrap(assumed_line(scene), 100, subsequent_indent="  ")
                lines = [textwrap.wrap(text, 100, subsequent_indent="    ") for text in remarks]
                print("\n".join([*run_lines(result), *chain(*lines), *assumed]), flush=True)
                show_warnings((w for w in summary["warnings"] if w not in doubts), written[1])
        written += drawn()
        if not options.quiet:
            print("written:", ", ".join(path.name for path in written), f"in {directory}")
    if interrupted:
        raise KeyboardInterrupt
    if summary["reason"]:
        how = "" if result.completed else "stopped early: "
        print(f"exu-press: {how}{summary['reason']}", file=sys.stderr)
        return 3
    return 0
