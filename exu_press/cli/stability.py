"""Stiff and extreme cases: each is right, stopped with a reason, or wrong; stability.json."""

import argparse
from pathlib import Path

from exu_press.errors import InputError
from exu_press.output import output_directory, write_json

__all__ = ["EXAMPLE", "add_arguments", "execute"]

EXAMPLE = "exu-press stability --quick --out out/stability"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the command's arguments."""
    parser.add_argument(
        "--quick", action="store_true", help="a fixed sample with every axis in it, two minutes"
    )
    parser.add_argument(
        "--axis",
        action="append",
        default=[],
        metavar="NAME",
        help="only the cases of one axis; may be repeated (default: all)",
    )
    parser.add_argument("--workers", type=int, metavar="N", help="processes (default: the cores)")
    parser.add_argument("--out", metavar="DIR", help="where to write (default: out/stability)")
    parser.add_argument("--quiet", action="store_true", help="print nothing but errors")
    parser.add_argument("--no-pictures", action="store_true", help="draw nothing")


def execute(options: argparse.Namespace) -> int:
    """Run the cases, going on where DIR was left; return 0, or 1 if one is wrong."""
    from exu_press.studies.stability import cases, quick_cases, stability

    table = quick_cases() if options.quick else cases()
    axes = dict.fromkeys(case.axis for case in table)
    for axis in options.axis:
        if axis not in axes:
            raise InputError(f"--axis {axis}: allowed are {', '.join(map(repr, axes))}")
    chosen = [case for case in table if not options.axis or case.axis in options.axis]
    directory = output_directory(options.out or Path("out") / "stability")
    report = stability(
        chosen, directory, quick=options.quick, workers=options.workers, quiet=options.quiet
    )
    write_json(directory / "stability.json", report.to_dict())
    written = ["stability.json"]
    if not options.no_pictures:
        from exu_press.plots.stability import save_stability

        written.append(save_stability(report, directory).name)
    if not options.quiet:
        print("\n".join(report.lines()))
        print("written:", ", ".join(written), f"in {directory}")
    return 1 if report.counts()["wrong"] else 0
