"""Report a run, a comparison or a study as one HTML page: to zoom, to play, to send."""

import argparse
from pathlib import Path

__all__ = ["EXAMPLE", "add_arguments", "execute", "name_missing_extra"]

EXAMPLE = "exu-press report out/press/run.nc --out report.html"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the command's arguments."""
    parser.add_argument(
        "path",
        metavar="PATH",
        help="a run.nc, or the directory of a run, a comparison or a study",
    )
    parser.add_argument(
        "--out", metavar="FILE.html", help="where to write (default: report.html beside it)"
    )
    parser.add_argument(
        "--from", dest="start", type=float, metavar="S", help="begin of the curves of runs (s)"
    )
    parser.add_argument("--to", dest="stop", type=float, metavar="S", help="their end (s)")
    parser.add_argument("--quiet", action="store_true", help="print nothing but errors")


def execute(options: argparse.Namespace) -> int:
    """Write the page; return 0."""
    from exu_press.report.find import find_output, report_of
    from exu_press.report.page_file import check_page, write_page

    kind, file = find_output(Path(options.path))
    target = Path(options.out) if options.out else file.parent / "report.html"
    check_page(target)
    write_page(report_of(kind, file, (options.start, options.stop)), target)
    if not options.quiet:
        print(f"written: {target} ({target.stat().st_size / 1e6:.1f} MB)")
        name_missing_extra()
    return 0


def name_missing_extra() -> None:
    """Print what the page lacks without the extra `page`."""
    from exu_press.page import has_library

    if not has_library():
        print("the page has pictures alone; to zoom and play: pip install exu-press[page]")
