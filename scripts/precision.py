"""Error against run time of shipped scenes, beside other solvers on a hand-reduced model.

Run with: python scripts/precision.py [--quick] [--case NAME] [--out DIR]
"""

import argparse
import sys
from collections.abc import Sequence
from pathlib import Path

from exu_press.cli.study import show_report
from exu_press.errors import InputError
from exu_press.files.output_directory import output_directory, write_json
from exu_press.studies.precision import PrecisionReport, precision
from precision.cases import chosen
from precision.goals import goals_of
from precision.peers import left_out


def parser() -> argparse.ArgumentParser:
    found = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    found.add_argument(
        "--case",
        action="append",
        default=[],
        metavar="NAME",
        help="one case of the table; may be repeated (default: all)",
    )
    found.add_argument(
        "--quick",
        action="store_true",
        help="a reduced form, less than two minutes; times mean nothing",
    )
    found.add_argument("--out", metavar="DIR", default="out/precision", help="where to write")
    found.add_argument("--quiet", action="store_true", help="print nothing but errors")
    found.add_argument("--no-pictures", action="store_true", help="draw nothing")
    return found


def run(options: argparse.Namespace) -> int:
    """Run the study; return 0, as runs that fail are part of what it reports."""
    table = chosen(options.case)
    directory = output_directory(Path(options.out))

    def keep(so_far: PrecisionReport) -> None:
        write_json(directory / "precision.json", so_far.to_dict())

    report = precision(
        table,
        quick=options.quick,
        quiet=options.quiet,
        after_case=keep,
        left_out=left_out(),
    )
    show_report(report, directory, options)
    if not (options.quick or options.quiet):
        durations = {name: case["duration"] for name, case in report.cases.items()}
        goals = goals_of(report.rows, durations)
        print("\n".join(["", *(line for goal in goals for line in goal.lines())]))
    return 0


def main(arguments: Sequence[str] | None = None) -> int:
    """Return run's status, or 2 for wrong input."""
    try:
        return run(parser().parse_args(arguments))
    except InputError as error:
        print(f"precision: {error}", file=sys.stderr)
        return 2


if __name__ == "__main__":
    sys.exit(main())
