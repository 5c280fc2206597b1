"""Stiff and extreme scenes along every axis: each is right, stopped with a reason, or wrong.

Run with: python scripts/stability.py [--quick] [--axis NAME] [--out DIR] [--workers N]
"""

import argparse
import sys
from collections.abc import Sequence

from exu_press.cli.study import show_report
from exu_press.errors import InputError
from exu_press.files.lock import lock_directory
from exu_press.files.output_directory import output_directory
from exu_press.studies.stability import stability
from stability.cases import Campaign, QuickCampaign


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
    try:
        campaign = QuickCampaign if options.quick else Campaign
        study = campaign.along(tuple(options.axis))
        with lock_directory(output_directory(options.out)) as directory:
            report = stability(study, directory, workers=options.workers, quiet=options.quiet)
            return show_report(report, directory, options)
    except InputError as error:
        print(f"stability: {error}", file=sys.stderr)
        return 2


if __name__ == "__main__":
    sys.exit(main())
