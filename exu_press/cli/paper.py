"""Section 5 of the paper, number by number, what moves each number, and the clearance to choose."""

import argparse
import sys
from pathlib import Path

from exu_press.output import output_directory, write_json

__all__ = ["EXAMPLE", "add_arguments", "execute"]

EXAMPLE = "exu-press paper --out out/paper"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the command's arguments."""
    parser.add_argument(
        "--quick",
        action="store_true",
        help="a reduced form in seconds, whose numbers say nothing of the paper",
    )
    parser.add_argument("--out", metavar="DIR", help="where to write (default: out/paper)")
    parser.add_argument(
        "--workers", type=int, metavar="N", help="processes at work (default: one a core)"
    )
    parser.add_argument("--quiet", action="store_true", help="print nothing but errors")
    parser.add_argument("--no-pictures", action="store_true", help="draw nothing")


def execute(options: argparse.Namespace) -> int:
    """Run the study; return 0, or 3 if one of the paper's runs did not get to its end.

    Runs of the sensitivity study that stop are part of what it reports.
    """
    from exu_press.studies.paper import paper
    from exu_press.studies.paper.table import report_lines

    directory = output_directory(options.out or Path("out") / "paper")
    report = paper(directory, quick=options.quick, workers=options.workers, quiet=options.quiet)
    write_json(directory / "paper.json", report.to_dict())
    write_json(directory / "sensitivity.json", report.sensitivity_dict())
    write_json(directory / "clearance.json", report.choice.to_dict())
    written = ["paper.json", "sensitivity.json", "clearance.json"]
    if not options.no_pictures:
        from exu_press.plots.paper import save_paper

        written += [path.name for path in save_paper(report, directory)]
    if not options.quiet:
        print("\n".join(report_lines(report)))
        print("\nwritten:", ", ".join(written), f"in {directory}")
    for name, reason in report.stopped.items():
        print(f"exu-press: {name}: {reason}", file=sys.stderr)
    return 3 if report.stopped else 0
