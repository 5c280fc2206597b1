"""The end of a study's command: files, pictures, lines."""

import argparse
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import Any, Protocol

from exu_press.files.output_directory import write_json

__all__ = ["finish"]


class Report(Protocol):
    """The result of a study, as it is written and as a person reads it."""

    def to_dict(self) -> dict[str, Any]:
        """Return the content of the file."""
        ...

    def lines(self) -> list[str]:
        """Return the lines for the terminal."""
        ...


def finish(
    report: Report, file: Path, draw: Callable[[], Iterable[Path]], options: argparse.Namespace
) -> None:
    """Write, draw and print a report.

    Args:
        report: of any study.
        file: where it is written.
        draw: its pictures, and returns their files.
        options: with `no_pictures` and `quiet`.
    """
    write_json(file, report.to_dict())
    written = [file] if options.no_pictures else [file, *draw()]
    if not options.quiet:
        print("\n".join(report.lines()))
        print("written:", ", ".join(path.name for path in written), f"in {file.parent}")
