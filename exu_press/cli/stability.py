"""Push a scene to its extremes: each run is right, stopped with a reason, or wrong."""

import argparse
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from exu_press.cli.options import add_scene_arguments, directory_of, finish, scene_of
from exu_press.errors import InputError
from exu_press.files.lock import locked
from exu_press.files.output_directory import output_directory

if TYPE_CHECKING:
    from exu_press.studies.stability import Case

__all__ = ["EXAMPLE", "add_arguments", "execute", "run"]

EXAMPLE = "exu-press stability slider_crank --key contact.modulus --out out/stability"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the command's arguments."""
    add_scene_arguments(parser)
    parser.add_argument(
        "--key",
        action="append",
        default=[],
        metavar="KEY",
        help="change this key alone; may be repeated (default: every number that the scene uses)",
    )
    parser.add_argument("--workers", type=int, metavar="N", help="processes (default: the cores)")


def execute(options: argparse.Namespace) -> int:
    """Run the cases, going on where DIR was left; return 0, or 1 if one is wrong."""
    from exu_press.studies.stability import extremes

    table = extremes(scene_of(options), Path(options.scene).stem)
    return run(table, "--key", options.key, directory_of(options, options.scene), options)


def run(
    table: Sequence["Case"],
    option: str,
    wanted: Sequence[str],
    out: str | Path,
    options: argparse.Namespace,
    *,
    quick: bool = False,
) -> int:
    """Run the cases of a table; write, draw and print the report.

    Args:
        table: of cases.
        option: that chooses among their axes.
        wanted: axes; all of them for none.
        out: directory.
        options: with `workers`, `quiet` and `no_pictures`.
        quick: whether the table is a sample of a larger one.

    Returns:
        0, or 1 if a case is wrong.
    """
    from exu_press.studies.stability import stability

    axes = dict.fromkeys(case.axis for case in table)
    for axis in wanted:
        if axis not in axes:
            raise InputError(f"{option} {axis}: allowed are {', '.join(axes)}")
    chosen = [case for case in table if not wanted or case.axis in wanted]
    with locked(output_directory(out)) as directory:
        report = stability(
            chosen, directory, quick=quick, workers=options.workers, quiet=options.quiet
        )

        def draw() -> list[Path]:
            from exu_press.plots.stability import save_stability

            return [save_stability(report, directory)]

        finish(report, directory / "stability.json", draw, options)
    return 1 if report.counts()["wrong"] else 0
