"""Error against run time: every solver against references; precision.json and pictures."""

import argparse
from pathlib import Path

from exu_press.cli.options import scene_of
from exu_press.errors import InputError
from exu_press.output import output_directory, write_json

__all__ = ["EXAMPLE", "add_arguments", "execute"]

EXAMPLE = "exu-press precision --case press_lubricated --out out/precision"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the command's arguments."""
    parser.add_argument(
        "scene",
        metavar="SCENE.toml",
        nargs="?",
        help="a scene file or a shipped scene, instead of the table of cases",
    )
    parser.add_argument(
        "--set", action="append", default=[], metavar="KEY=VALUE", help="change a key of the scene"
    )
    parser.add_argument(
        "--case",
        action="append",
        default=[],
        metavar="NAME",
        help="one case of the table; may be repeated (default: all)",
    )
    parser.add_argument(
        "--quick", action="store_true", help="a reduced form in under two minutes, times not judged"
    )
    parser.add_argument("--out", metavar="DIR", help="where to write (default: out/precision)")
    parser.add_argument("--quiet", action="store_true", help="print nothing but errors")
    parser.add_argument("--no-pictures", action="store_true", help="draw nothing")


def execute(options: argparse.Namespace) -> int:
    """Run the study; return 0, as runs that fail are part of what it reports."""
    if options.scene and options.case:
        raise InputError(f"--case {options.case[0]}: allowed is a scene or --case, not both")
    if options.set and not options.scene:
        raise InputError(f"--set {options.set[0]}: allowed with a scene only")
    from exu_press.studies.precision import Case, Report, case_of, chosen, precision
    from exu_press.studies.precision.table import report_lines

    selection: tuple[Case, ...]
    if options.scene:
        selection = (case_of(Path(options.scene).stem, scene_of(options)),)
    else:
        selection = chosen(options.case)
    directory = output_directory(options.out or Path("out") / "precision")

    def keep(so_far: Report) -> None:
        write_json(directory / "precision.json", so_far.to_dict())

    report = precision(selection, quick=options.quick, quiet=options.quiet, after_case=keep)
    written = ["precision.json"]
    if not options.no_pictures:
        from exu_press.plots.precision import save_precision

        written += [path.name for path in save_precision(report, directory)]
    if not options.quiet:
        print("\n".join(report_lines(report)))
        print("written:", ", ".join(written), f"in {directory}")
    return 0
