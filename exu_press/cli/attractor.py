"""Analyse the motion in the long run: period, Lyapunov exponent, figures by revolution."""

import argparse
import sys
from pathlib import Path

from exu_press.cli.options import (
    add_format_argument,
    add_scene_arguments,
    check_format,
    directory_of,
    scene_of,
    show_warnings,
)
from exu_press.errors import InputError
from exu_press.files.lock import locked, remove_unused
from exu_press.files.output_directory import output_directory, write_json
from exu_press.scene import Scene
from exu_press.scene.warnings import scene_warnings

__all__ = ["EXAMPLE", "add_arguments", "execute"]

ITS_OWN = {"revolutions": "--revolutions", "settle": "--skip"}
"""Keys of a scene in whose place the command has arguments."""

EXAMPLE = "exu-press attractor press --set joints.crank_pin=dry --revolutions 100 --skip 30"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the command's arguments."""
    add_scene_arguments(parser)
    parser.add_argument(
        "--revolutions",
        type=int,
        default=100,
        metavar="N",
        help="after the transient (100); the scene's own do not count",
    )
    parser.add_argument(
        "--skip", type=int, default=30, metavar="N", help="revolutions of the transient (30)"
    )
    parser.add_argument(
        "--longest", type=int, default=16, metavar="N", help="longest period looked for (16)"
    )
    parser.add_argument(
        "--quantity",
        action="append",
        default=[],
        metavar="NAME",
        help="keep this quantity of each revolution; may be repeated (the headline ones)",
    )
    add_format_argument(parser)


def execute(options: argparse.Namespace) -> int:
    """Run for long; print and draw the motion."""
    check_format(options)
    for name in (assignment.partition("=")[0].strip() for assignment in options.set):
        if name in ITS_OWN:
            raise InputError(f"--set {name}: a long run has its own; allowed is {ITS_OWN[name]} N")
    scene = scene_of(options)
    target = directory_of(options, options.scene)
    is_new = not target.exists()
    with locked(output_directory(target)) as directory:
        try:
            return _execute(scene, directory, options)
        finally:
            if is_new:
                remove_unused(directory)


def _execute(scene: Scene, directory: Path, options: argparse.Namespace) -> int:
    """Run for long in a directory of its own; return the exit status."""
    from exu_press.studies.attractor import attractor
    from exu_press.studies.attractor.lines import attractor_lines
    from exu_press.studies.attractor.orbit import NoMotion

    try:
        found = attractor(
            scene,
            revolutions=options.revolutions,
            skip=options.skip,
            names=options.quantity,
            most=options.longest,
            quiet=options.quiet,
        )
    except NoMotion as error:
        print(f"exu-press: {error}", file=sys.stderr)
        return 3
    write_json(directory / "attractor.json", found.to_dict())
    written = ["attractor.json"]
    if not options.quiet:
        print("\n".join(attractor_lines(found)), flush=True)
        show_warnings(scene_warnings(scene))
    if not options.no_pictures:
        from exu_press.plots.attractor import attractor_figure
        from exu_press.plots.file import save_figure

        file = directory / f"attractor{options.format}"
        written.append(save_figure(attractor_figure(found), file).name)
    if not options.quiet:
        print("written:", ", ".join(written), f"in {directory}")
    if found.stopped:
        print(f"exu-press: {found.stopped}", file=sys.stderr)
    if not found.period.told:
        print(f"exu-press: the period is {found.period}", file=sys.stderr)
    return 3 if found.stopped or not found.period.told else 0
