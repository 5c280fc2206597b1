"""Whether fits recover known keys: 40 synthetic measurements with noise of three scenes.

Run with: python scripts/fit_recovers.py [--out DIR] [--workers N] [--measurements N]
"""

import argparse
import sys
from collections.abc import Sequence
from pathlib import Path

from exu_press.errors import InputError
from exu_press.terminal.columns import columns
from recovery.cases import CASES
from recovery.study import recover


def parser() -> argparse.ArgumentParser:
    found = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    found.add_argument("--out", metavar="DIR", default="out/recovery", help="where to write")
    found.add_argument("--workers", type=int, metavar="N", help="processes (default: the cores)")
    found.add_argument("--measurements", type=int, metavar="N", help="of each scene (13 or 14)")
    found.add_argument("--quiet", action="store_true", help="print nothing but the table")
    return found


def main(arguments: Sequence[str] | None = None) -> int:
    """Return 0, or 2 for wrong input."""
    options = parser().parse_args(arguments)
    rows = [("scene", "measurements", "key", "true", "mean of the fits", "in the 95 % interval")]
    held, every, runs = 0, 0, 0
    try:
        for name in CASES:
            found = recover(
                name,
                Path(options.out) / name.replace(" ", "_"),
                measurements=options.measurements,
                workers=options.workers,
                quiet=options.quiet,
            )
            number = len(found.reports)
            runs += found.runs
            for key, true in found.truth.items():
                mean = sum(one.values[key] for one in found.reports) / number
                rows.append(
                    (name, f"{number}", key, f"{true:g}", f"{mean:.4g}", f"{found.held(key)}")
                )
                held, every = held + found.held(key), every + number
    except InputError as error:
        print(f"fit_recovers: {error}", file=sys.stderr)
        return 2
    print("\n".join(columns(rows)))
    part = held / every
    print(f"{held} of {every} intervals hold the true key: {40 * part:.1f} of 40; {runs} runs")
    return 0


if __name__ == "__main__":
    sys.exit(main())
