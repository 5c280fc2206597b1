"""Measure error against run time of a scene, with tolerances and with fixed steps; draw both."""

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

from exu_press.cli.options import add_scene_arguments, directory_of, finish, scene_of
from exu_press.files.lock import locked
from exu_press.files.output_directory import output_directory

if TYPE_CHECKING:
    from exu_press.studies.precision import Report

__all__ = ["EXAMPLE", "add_arguments", "execute", "tell"]

EXAMPLE = "exu-press precision slider_crank --quick --out out/precision"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the command's arguments."""
    add_scene_arguments(parser)
    parser.add_argument(
        "--quick",
        action="store_true",
        help="a reduced form, less than two minutes; times mean nothing",
    )


def execute(options: argparse.Namespace) -> int:
    """Run the study; return 0, as runs that fail are part of what it reports."""
    from exu_press.studies.precision import case_of, precision

    case = case_of(Path(options.scene).stem, scene_of(options))
    with locked(output_directory(directory_of(options, options.scene))) as directory:
        report = precision((case,), quick=options.quick, quiet=options.quiet)
        tell(report, directory, options)
    return 0


def tell(report: "Report", directory: Path, options: argparse.Namespace) -> None:
    """Write, draw and print a report."""

    def draw() -> list[Path]:
        from exu_press.plots.precision import save_precision

        return save_precision(report, directory)

    finish(report, directory / "precision.json", draw, options)
