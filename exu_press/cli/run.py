"""Run one scene: summary.json, run.nc and pictures."""

import argparse
import sys
import textwrap
from collections.abc import Callable, Iterator
from contextlib import ExitStack, nullcontext
from dataclasses import replace
from itertools import chain
from pathlib import Path

from exu_press.cli.options import (
    add_error_argument,
    add_scene_arguments,
    directory_of,
    scene_of,
    show_warnings,
)
from exu_press.cli.pictures_beside import PicturesBeside, pictures_beside
from exu_press.errors import InputError
from exu_press.files.digests import file_digest
from exu_press.files.lock import lock_directory
from exu_press.files.output_directory import (
    checkpoint_directory,
    output_directory,
    remove_pictures,
    write_json,
)
from exu_press.model.state import State
from exu_press.quantities.remarks import run_lines
from exu_press.result import Result
from exu_press.result.checkpoint import has_blocks, refuse_blocks, remove, set_aside
from exu_press.scene import Scene, mechanism_of
from exu_press.scene.assumptions import assumed_line
from exu_press.scene.warnings import scene_warnings
from exu_press.terminal.interrupt import postponed_interrupt
from exu_press.verification.refine import refinements
from exu_press.verification.simulate import simulate
from exu_press.verification.within import accuracy_lines, find_tolerance

__all__ = ["EXAMPLE", "add_arguments", "execute"]

RESULT = "run.nc"

OF_THE_START = "start", "start_angle_deg"
"""Keys that do nothing where a run goes on from another one."""

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
    value = float(text.removesuffix("%")) * (0.01 if text.endswith("%") else 1.0)
    if not 1e-5 <= value < 1.0:
        raise argparse.ArgumentTypeError(f"{text!r}: allowed is a number from 0.001% to 100%")
    return value


def _start_path(name: str) -> Path:
    """Return the file, or the directory of blocks, that --from means.

    In the directory of a run, what a killed one has left is newer than the result beside it.
    """
    path = Path(name)
    file = path / RESULT if path.is_dir() else path
    blocks = path if has_blocks(path) else checkpoint_directory(file)
    return blocks if has_blocks(blocks) and (path.is_dir() or not path.exists()) else file


def _start_of(options: argparse.Namespace, scene: Scene) -> State | None:
    """Return the state in which the run of --from ended, or None without it."""
    if options.start is None:
        return None
    if options.within is not None:
        raise InputError("--from: not together with --within, which runs as often as it needs")
    previous = Result.load(_start_path(options.start))
    if not previous.completed or "state" not in previous.info:
        why = previous.info["reason"] or "it was written without the state at its end"
        raise InputError(f"--from {options.start}: allowed is a run that reached its end; {why}")
    for key, asked, began in _shared_keys(scene, previous.scene):
        if asked != began:
            raise InputError(
                f"--from {options.start}: {key} = {asked!r}; allowed is {began!r}, as in that run"
            )
    for key in OF_THE_START:
        asked, began = getattr(scene, key), getattr(previous.scene, key)
        if asked != began:
            raise InputError(
                f"--from {options.start}: {key} = {asked!r} does nothing in a run that goes on; "
                f"allowed is {began!r}, with which that run began"
            )
    return previous.info["state"]


def _shared_keys(scene: Scene, previous: Scene) -> Iterator[tuple[str, object, object]]:
    """Yield names and both values of what a run that goes on shares with the one before it."""
    yield "mechanism", mechanism_of(scene).name, mechanism_of(previous).name
    yield "joints", [*scene.joints], [*previous.joints]
    for name, joint in scene.joints.items():
        began = previous.joints[name].kind
        if "ideal" in (joint.kind, began):
            yield f"joints.{name}.kind", joint.kind, began


def execute(options: argparse.Namespace) -> int:
    """Run the scene; return 0, or 3 if it stopped early or was not resolved."""
    with nullcontext() if options.no_pictures else pictures_beside() as pictures:
        scene = scene_of(options)
        start = _start_of(options, scene)
        if options.figure is not None and options.within is None:
            raise InputError(f"--figure {options.figure}: only together with --within")
        with lock_directory(output_directory(directory_of(options, options.scene))) as directory:
            if pictures is not None:
                pictures.prepare(scene)
            return _run(scene, start, directory, options, pictures)


def _with_start(result: Result, path: Path) -> Result:
    """Return a run that went on from another one, with that in its provenance."""
    provenance = result.info["provenance"]
    files = sorted(path.iterdir()) if path.is_dir() else [path]
    digests = {str(file): file_digest(file) for file in files}
    provenance = {
        **provenance,
        "files": {**provenance["files"], **digests},
        "start": str(path),
    }
    return replace(result, info={**result.info, "provenance": provenance})


def _make_room(unfinished: Path, options: argparse.Namespace) -> None:
    """Remove the finished blocks of an earlier run, or set them aside where --from goes on."""
    if options.overwrite:
        remove(unfinished)
    elif (
        options.start is not None
        and has_blocks(unfinished)
        and _start_path(options.start).resolve() == unfinished.resolve()
    ):
        aside = set_aside(unfinished)
        if not options.quiet:
            print(f"the revolutions before are kept in {aside}", file=sys.stderr)
    refuse_blocks(unfinished)


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
    start: State | None,
    directory: Path,
    options: argparse.Namespace,
    pictures: PicturesBeside | None,
) -> int:
    def draw_early(run: Result) -> None:
        if pictures is not None and start is None:  # with one, its pictures name its file
            pictures.draw_early(run)

    remarks: list[str] = []
    interrupted = False
    doubts = scene_warnings(scene)
    if not options.quiet:  # a drawing in mm may run for long
        show_warnings(doubts, directory / "summary.json")
    unfinished = checkpoint_directory(directory / RESULT)
    _make_room(unfinished, options)
    if options.within is not None:
        delivered = find_tolerance(scene, options.within, options.figure, quiet=options.quiet)
        result, remarks = delivered.result, accuracy_lines(delivered, options.within)
    elif options.no_error or options.once:
        errors = not options.no_error
        result = simulate(
            scene, errors=errors, start=start, unfinished=unfinished, quiet=options.quiet
        )
    else:
        result, interrupted, remark = _run_refined(
            scene, start, unfinished, draw_early, quiet=options.quiet
        )
        remarks = [remark] if remark else []
    if options.start is not None:
        result = _with_start(result, _start_path(options.start))
    written = [directory / RESULT, directory / "summary.json"]
    with ExitStack() as stack:
        with postponed_interrupt():
            summary = result.summary()
            remove_pictures(directory, "run")
            drawn = list if pictures is None else pictures.draw(result, directory)
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
