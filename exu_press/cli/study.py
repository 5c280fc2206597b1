"""The command of a study: its report is printed, drawn and written."""

import argparse
import sys
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from exu_press.cli.options import (
    add_scene_arguments,
    add_study_arguments,
    add_worker_arguments,
    directory_of,
    scene_of,
    show_warnings,
)
from exu_press.errors import InputError
from exu_press.files.lock import lock_directory, remove_unused
from exu_press.files.output_directory import FORMATS, REPORT_FILE, output_directory
from exu_press.plots.format import picture_format
from exu_press.studies.base.command import SceneCommand, StudyCommand
from exu_press.studies.base.report import Report
from exu_press.studies.base.study import Study

__all__ = ["Command", "command_of", "show_report"]

STOPPED = 3


@dataclass(frozen=True)
class Command:
    """A study's command in the form of the modules of commands."""

    EXAMPLE: str
    add_arguments: Callable[[argparse.ArgumentParser], None]
    execute: Callable[[argparse.Namespace], int]


def command_of(study: type[StudyCommand]) -> Command:
    """Return the command of a study."""

    def add_arguments(parser: argparse.ArgumentParser) -> None:
        """Add the command's arguments."""
        if issubclass(study, SceneCommand):
            add_scene_arguments(parser)
        else:
            add_study_arguments(parser)
        if study.uses_workers:
            add_worker_arguments(parser)
        study.add_arguments(parser)

    return Command(study.example, add_arguments, lambda options: _execute(study, options))


def _execute(command: type[StudyCommand], options: argparse.Namespace) -> int:
    """Run the study; return its report's exit status, or 3 after Ctrl-C."""
    if issubclass(command, SceneCommand):
        _refuse_replaced(command, options)
        study: Study = command.study_of(scene_of(options), options)
        file = options.scene
    else:
        study, file = command.load(options), options.study
    target = directory_of(options, file)
    is_new = not target.exists()
    how = {name: getattr(options, name) for name in ("workers", "dask") if name in options}
    with lock_directory(output_directory(target)) as directory:
        try:
            report = command.run(study, directory, quiet=options.quiet, **how)
            return show_report(command.select(report, options), directory, options)
        except KeyboardInterrupt:
            if not command.uses_workers:
                raise
            print(
                f"exu-press: interrupted: finished runs are kept in {directory}; the same command "
                "goes on with them",
                file=sys.stderr,
            )
            return STOPPED
        finally:
            if is_new:
                remove_unused(directory)


def _refuse_replaced(command: type[SceneCommand], options: argparse.Namespace) -> None:
    """Raise InputError where --set changes a key that the command has an argument for."""
    for name in (assignment.partition("=")[0].strip() for assignment in options.set):
        if name in command.replaced_keys:
            raise InputError(
                f"--set {name}: {options.command} has its own; allowed is "
                f"{command.replaced_keys[name]} N"
            )


def show_report(report: Report, directory: Path, options: argparse.Namespace) -> int:
    """Save, print and draw a report; return its exit status.

    Args:
        options: with `quiet` and `no_pictures`.
    """
    report.save(directory)
    if not options.quiet:
        print("\n".join(report.lines()), flush=True)
        show_warnings(report.warnings(), directory / REPORT_FILE)
    files = list(report.files)
    for picture in report.pictures():
        for old in FORMATS:
            (directory / f"{picture.name}{old}").unlink(missing_ok=True)
        if not options.no_pictures and (figure := picture.draw(report)) is not None:
            from exu_press.plots.file import save_figure

            path = directory / f"{picture.name}{picture_format().ending}"
            files.append(save_figure(figure, path, {"": report.provenance()}).name)
    if not options.quiet:
        print("written:", ", ".join(files), f"in {directory}")
    for failure in report.failures:
        print(f"exu-press: {failure}", file=sys.stderr)
    return report.exit_status
