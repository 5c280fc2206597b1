"""Section 5 of the paper, number by number, what moves each number, and the clearance to choose.

Run with: python scripts/paper.py [--quick] [--fit] [--out DIR] [--workers N]
"""

import argparse
import sys
from collections.abc import Sequence
from pathlib import Path

from exu_press.errors import InputError
from exu_press.files.output_directory import output_directory, write_json
from paper.study import paper
from paper.table import report_lines, tables


def parser() -> argparse.ArgumentParser:
    found = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    found.add_argument(
        "--quick",
        action="store_true",
        help="a reduced form in seconds, whose numbers say nothing of the paper",
    )
    found.add_argument(
        "--fit",
        action="store_true",
        help="which reading of what the paper leaves open brings its numbers nearest, instead",
    )
    found.add_argument(
        "--trials",
        type=int,
        default=16,
        metavar="N",
        help="readings that --fit tries (16); 0: flexible bodies alone, where a search led",
    )
    found.add_argument("--out", metavar="DIR", default="out/paper", help="where to write")
    found.add_argument(
        "--workers", type=int, metavar="N", help="processes at work (default: one a core)"
    )
    found.add_argument("--quiet", action="store_true", help="print nothing but errors")
    found.add_argument("--no-pictures", action="store_true", help="draw nothing")
    return found


def run(options: argparse.Namespace) -> int:
    """Run the study; return 0, or 3 if one of the paper's runs did not get to its end.

    Runs of the sensitivity study that stop are part of what it reports.
    """
    directory = output_directory(Path(options.out))
    if options.fit:
        return run_fit(options, directory)
    study = paper(directory, quick=options.quick, workers=options.workers, quiet=options.quiet)
    write_json(directory / "paper.json", study.to_dict() | {"tables": tables(study)})
    written = ["paper.json"]
    if not options.no_pictures:
        from paper.pictures import save_paper

        written += [path.name for path in save_paper(study, directory)]
    if not options.quiet:
        print("\n".join(report_lines(study)))
        print("\nwritten:", ", ".join(written), f"in {directory}")
    for name, reason in study.stopped.items():
        print(f"paper: {name}: {reason}", file=sys.stderr)
    return 3 if study.stopped else 0


def run_fit(options: argparse.Namespace, directory: Path) -> int:
    """Search the reading that brings the paper's numbers nearest; return 0."""
    from paper.inverse import inverse
    from paper.inverse_lines import inverse_lines, inverse_rows

    if 0 < options.trials < 8 or options.trials < 0:
        raise InputError(f"--trials {options.trials}: allowed is 0, or a whole number >= 8")
    found = inverse(
        directory,
        trials=options.trials,
        quick=options.quick,
        workers=options.workers,
        quiet=options.quiet,
    )
    write_json(directory / "inverse.json", found.to_dict() | {"table": inverse_rows(found)})
    if not options.quiet:
        print("\n".join(inverse_lines(found)))
        print("\nwritten: inverse.json in", directory)
    return 0


def main(arguments: Sequence[str] | None = None) -> int:
    """Return run's status, or 2 for wrong input."""
    try:
        return run(parser().parse_args(arguments))
    except InputError as error:
        print(f"paper: {error}", file=sys.stderr)
        return 2


if __name__ == "__main__":
    sys.exit(main())
