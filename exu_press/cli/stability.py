"""Pushes a scene to its extremes: each is right, stopped with a reason, or wrong."""

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

from exu_press.cli.options import add_scene_arguments, directory_of, scene_of
from exu_press.errors import InputError
from exu_press.output import output_directory, write_json

if TYPE_CHECKING:
    from exu_press.studies.stability import Report

__all__ = ["EXAMPLE", "add_arguments", "execute", "finish"]

EXAMPLE = "exu-press stability slider_crank --key contact.damping_max --out out/stability"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the command's arguments."""
    add_scene_arguments(parser)
    parser.add_argument(
        "--key",
        action="append",
        default=[],
        metavar="KEY",
        help="push this key alone; may be repeated (default: every number that the scene uses)",
    )
    parser.add_argument("--workers", type=int, metavar="N", help="processes (default: the cores)")


def execute(options: argparse.Namespace) -> int:
    """Run the cases, going on where DIR was left; return 0, or 1 if one is wrong."""
    from exu_press.studies.stability import extremes, stability

    table = extremes(scene_of(options), Path(options.scene).stem)
    keys = dict.fromkeys(case.axis for case in table)
    for key in options.key:
        if key not in keys:
            raise InputError(f"--key {key}: allowed are {', '.join(keys)}")
    chosen = [case for case in table if not options.key or case.axis in options.key]
    directory = output_directory(directory_of(options))
    report = stability(chosen, directory, workers=options.workers, quiet=options.quiet)
    return finish(report, directory, options)


def finish(report: "Report", directory: Path, options: argparse.Namespace) -> int:
    """Write, draw and print a report; return 0, or 1 if a case is wrong."""
    write_json(directory / "stability.json", report.to_dict())
    written = ["stability.json"]
    if not options.no_pictures:
        from exu_press.plots.stability import save_stability

        written.append(save_stability(report, directory).name)
    if not options.quiet:
        print("\n".join(report.lines()))
        print("written:", ", ".join(written), f"in {directory}")
    return 1 if report.counts()["wrong"] else 0
