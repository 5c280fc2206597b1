"""Stiff and extreme scenes along every axis: each is right, stopped with a reason, or wrong.

Run with: python scripts/stability.py [--quick] [--axis NAME] [--out DIR] [--workers N]
"""

import argparse
import sys
from collections.abc import Sequence
from pathlib import Path

from exu_press.cli.stability import finish
from exu_press.errors import InputError
from exu_press.output import output_directory
from exu_press.studies.stability import stability
from stability.cases import cases, quick_cases


def parser() -> argparse.ArgumentParser:
    found = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    found.add_argument(
        "--quick", action="store_true", help="a fixed sample with every axis in it, two minutes"
    )
    found.add_argument(
        "--axis",
        action="append",
        default=[],
        metavar="NAME",
        help="only the cases of one axis; may be repeated (default: all)",
    )
    found.add_argument("--workers", type=int, metavar="N", help="processes (default: the cores)")
    found.add_argument("--out", metavar="DIR", default="out/stability", help="where to write")
    found.add_argument("--quiet", action="store_true", help="print nothing but errors")
    found.add_argument("--no-pictures", action="store_true", help="draw nothing")
    return found


def run(options: argparse.Namespace) -> int:
    """Run the cases, going on where DIR was left; return 0, or 1 if one is wrong."""
    table = quick_cases() if options.quick else cases()
    axes = dict.fromkeys(case.axis for case in table)
    for axis in options.axis:
        if axis not in axes:
            raise InputError(f"--axis {axis}: allowed are {', '.join(map(repr, axes))}")
    chosen = [case for case in table if not options.axis or case.axis in options.axis]
    directory = output_directory(Path(options.out))
    report = stability(
        chosen, directory, quick=options.quick, workers=options.workers, quiet=options.quiet
    )
    return finish(report, directory, options)


def main(arguments: Sequence[str] | None = None) -> int:
    """Return run's status, or 2 for wrong input."""
    try:
        return run(parser().parse_args(arguments))
    except InputError as error:
        print(f"stability: {error}", file=sys.stderr)
        return 2


if __name__ == "__main__":
    sys.exit(main())
