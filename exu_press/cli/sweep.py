"""Run many scenes, as a study file says: table.csv, table.nc and a picture; may be interrupted."""

import argparse
import sys
from pathlib import Path

from exu_press.cli.options import add_study_arguments, resumable, show_warnings
from exu_press.errors import InputError
from exu_press.files.output_directory import remove_pictures
from exu_press.parallel.task import FAILED, TIME_LIMIT, WORKER_DIED
from exu_press.scene.warnings import scene_warnings

__all__ = ["EXAMPLE", "add_arguments", "execute"]

EXAMPLE = "exu-press sweep study.toml --workers 2 --out out/study"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the command's arguments."""
    add_study_arguments(parser)
    parser.add_argument(
        "--over",
        action="append",
        default=[],
        metavar="KEY",
        help="key on a picture's axis; at most twice (default: the first two that vary)",
    )
    parser.add_argument(
        "--show",
        action="append",
        default=[],
        metavar="COLUMN",
        help="print and draw this column of the table; may be repeated",
    )


def execute(options: argparse.Namespace) -> int:
    """Run the study; return 0, or 3 after Ctrl-C or if all runs failed. Failed runs are rows."""
    return resumable(_execute, options)


def _execute(options: argparse.Namespace, directory: Path) -> int:
    from exu_press.quantities import quantities_of
    from exu_press.studies.sweep import load_study, sweep, table_lines

    study = load_study(options.study)
    unknown = [key for key in options.over if key not in study.keys]
    if unknown:
        raise InputError(f"--over {unknown[0]}: allowed are {', '.join(study.keys)}")
    for name in options.show:
        if not any(name in quantities_of(scene) for scene in study.scenes):
            raise InputError(
                f"--show {name}: allowed are {', '.join(quantities_of(study.scenes[0]))}"
            )
    table = sweep(study, directory, workers=options.workers, dask=options.dask, quiet=options.quiet)
    remove_pictures(directory, "sweep")
    written = ["table.csv", "table.nc"]
    if not options.no_pictures:
        from exu_press.plots.sweep import save_sweep

        pictures = save_sweep(table, directory, options.over, options.show)
        written += [path.name for path in pictures]
    if not options.quiet:
        print("\n".join(table_lines(table, options.show)))
        show_warnings(warning for scene in study.scenes for warning in scene_warnings(scene))
        print("written:", ", ".join(written), f"in {directory}")
    if set(table["status"]) <= {FAILED, TIME_LIMIT, WORKER_DIED}:
        print(f"exu-press: no run reached an end: {table['reason'][0]}", file=sys.stderr)
        return 3
    return 0
