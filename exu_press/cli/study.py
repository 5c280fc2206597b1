"""Commands on a study file: all have this form, and differ in what they run, print and draw."""

import argparse
import sys
from collections.abc import Callable, Iterable, Mapping, Sequence
from importlib import import_module
from pathlib import Path
from typing import Any

from exu_press.cli.options import (
    add_format_argument,
    add_study_arguments,
    check_format,
    directory_of,
    show_warnings,
)
from exu_press.files.lock import locked
from exu_press.files.output_directory import output_directory, remove_pictures
from exu_press.scene import Scene
from exu_press.scene.warnings import scene_warnings

__all__ = ["Parts", "study_command"]

STOPPED = 3

Parts = tuple[str, Callable[[argparse.ArgumentParser], None], Callable[[argparse.Namespace], int]]
"""EXAMPLE, add_arguments and execute of a command's module."""


def study_command(
    name: str,
    kind: str,
    figures: str,
    written: Sequence[str],
    *,
    example: str,
    add: Callable[[argparse.ArgumentParser], None] | None = None,
    asked: Callable[[argparse.Namespace, Any], Mapping[str, Any]] | None = None,
    warned: Callable[[Any, Any], Iterable[Scene]] = lambda study, report: [study.scene],
    stopped: Callable[[Any], str] = lambda report: "",
) -> Parts:
    """Return a command's parts.

    Args:
        name: of the command, of the package in `exu_press.studies` and of the function in it that
            runs a study and returns a report; its module `lines` has `report_lines`.
        kind: the class of its studies.
        figures: module and function of `exu_press.plots` that returns a report's figures by name.
        written: files that it writes beside pictures.
        example: of a call.
        add: adds arguments of its own.
        asked: checks these against the study, and returns them as keywords of lines and figures.
        warned: from study and report to the scenes whose warnings are shown.
        stopped: from a report to why the exit status is 3; nothing where it is 0.
    """

    def add_arguments(parser: argparse.ArgumentParser) -> None:
        """Add the command's arguments."""
        add_study_arguments(parser)
        add_format_argument(parser)
        if add is not None:
            add(parser)

    def execute(options: argparse.Namespace) -> int:
        """Run the study; return 0, or 3 after Ctrl-C or where it did not come to its end."""
        check_format(options)
        directory = directory_of(options, options.study)
        try:
            return _execute(options, directory)
        except KeyboardInterrupt:
            print(
                f"exu-press: interrupted: finished runs are kept in {directory}; the same command "
                "goes on with them",
                file=sys.stderr,
            )
            return STOPPED

    def _execute(options: argparse.Namespace, directory: Path) -> int:
        from exu_press.studies.base import load_study

        package: Any = import_module(f"exu_press.studies.{name}")
        lines: Any = import_module(f"exu_press.studies.{name}.lines")
        study = load_study(options.study, getattr(package, kind), allow_code=options.allow_code)
        more = {} if asked is None else asked(options, study)
        with locked(output_directory(directory)):
            report = getattr(package, name)(
                study, directory, workers=options.workers, dask=options.dask, quiet=options.quiet
            )
            remove_pictures(directory, name)
            files = list(written)
            if not options.no_pictures:
                from exu_press.plots.file import save_figures

                module, _, function = figures.partition(".")
                drawn = getattr(import_module(f"exu_press.plots.{module}"), function)(
                    report, **more
                )
                files += [path.name for path in save_figures(drawn, directory, options.format)]
        if not options.quiet:
            print("\n".join(lines.report_lines(report, **more)))
            show_warnings(w for scene in warned(study, report) for w in scene_warnings(scene))
            print("written:", ", ".join(files), f"in {directory}")
        if why := stopped(report):
            print(f"exu-press: {why}", file=sys.stderr)
            return STOPPED
        return 0

    return example, add_arguments, execute
