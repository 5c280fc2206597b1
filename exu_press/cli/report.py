"""Report a run, a comparison or a sweep as one HTML page with everything in it."""

import argparse
from pathlib import Path

from exu_press.errors import InputError
from exu_press.output import check_writable, replacing

__all__ = ["EXAMPLE", "add_arguments", "execute"]

EXAMPLE = "exu-press report out/press/run.nc --out report.html"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the command's arguments."""
    parser.add_argument(
        "path",
        metavar="PATH",
        help="a run.nc, or the directory that run, compare or sweep wrote to",
    )
    parser.add_argument(
        "--out", metavar="FILE.html", help="where to write (default: report.html beside it)"
    )
    parser.add_argument("--quiet", action="store_true", help="print nothing but errors")


def execute(options: argparse.Namespace) -> int:
    """Write the page; return 0."""
    from exu_press.report.find import find_output, report_of

    kind, file = find_output(Path(options.path))
    target = Path(options.out) if options.out else file.parent / "report.html"
    if target.suffix.lower() not in (".html", ".htm"):
        raise InputError(f"--out {target}: allowed is a name ending in .html")
    check_writable(target)
    text = report_of(kind, file)
    with replacing(target) as partial:
        partial.write_text(text, encoding="utf-8")
    if not options.quiet:
        print(f"written: {target} ({target.stat().st_size / 1e6:.1f} MB)")
    return 0
