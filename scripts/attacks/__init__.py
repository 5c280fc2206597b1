"""Totals and command line of the campaigns of attacks."""

import argparse
import tempfile
from collections import Counter
from collections.abc import Callable, Sequence
from pathlib import Path

__all__ = ["Attack", "Totals", "main"]


class Totals:
    """Counts how attacks end, and prints faults.

    Attributes:
        name: of the attacks, plural.
        faults: number of them.
    """

    def __init__(self, name: str) -> None:
        self.name, self.faults = name, 0
        self._counts = Counter[str]()

    def count(self, end: str) -> None:
        """Count how an attack ended."""
        self._counts[end] += 1

    def fault(self, seed: int, text: str) -> None:
        """Count and print a fault."""
        self.faults += 1
        self.count("FAULT")
        print(f"FAULT, seed {seed}, {self.name}: {text}", flush=True)

    def close(self, note: str = "") -> int:
        """Print the totals with a note, and return the number of faults."""
        ends = ", ".join(f"{count} {end}" for end, count in self._counts.most_common())
        print(f"{self._counts.total()} {self.name}: {ends or 'none'}{note}", flush=True)
        return self.faults


Attack = Callable[[Path, Sequence[int]], int]
"""Attacks in an empty folder, one for each seed; returns the number of faults."""


def main(
    description: str, attacks: dict[str, tuple[Attack, int, str]], arguments: Sequence[str] | None
) -> int:
    """Run attacks and return 0 without a fault, else 1.

    Args:
        description: first line of the help.
        attacks: option -> attack, usual number of attacks, and the help of the option.
        arguments: of the command line; None: those of the process.
    """
    parser = argparse.ArgumentParser(description=description.partition("\n")[0])
    for option, (_, count, text) in attacks.items():
        parser.add_argument(f"--{option}", type=int, default=count, metavar="N", help=text)
    parser.add_argument("--seed", type=int, default=0, metavar="S", help="of the first attack")
    options = parser.parse_args(arguments)
    faults = 0
    for option, (attack, _, _) in attacks.items():
        with tempfile.TemporaryDirectory() as folder:
            seeds = range(options.seed, options.seed + getattr(options, option))
            faults += attack(Path(folder), seeds)
    return int(bool(faults))
