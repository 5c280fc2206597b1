"""Stiff and extreme scenes along every axis: each is right, stopped with a reason, or wrong.

Run with: python scripts/stability.py [--quick] [--axis NAME] [--out DIR] [--workers N]
"""

import argparse
import sys
from collections.abc import Sequence

from exu_press.cli.stability import run
from exu_press.errors import InputError
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


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the cases, going on where DIR was left; 0, 1 if one is wrong, 2 for wrong input."""
    options = parser().parse_args(arguments)
    table = quick_cases() if options.quick else cases()
    try:
        return run(table, "--axis", options.axis, options.out, options, quick=options.quick)
    except InputError as error:
        print(f"stability: {error}", file=sys.stderr)
        return 2


if __name__ == "__main__":
    sys.exit(main())
