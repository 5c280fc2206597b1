"""Wear a press over many strokes: clearances grow, their shapes follow, the runs are repeated."""

import argparse
from pathlib import Path

from exu_press.cli.options import add_study_arguments, resumable, show_warnings
from exu_press.files.output_directory import remove_pictures
from exu_press.scene.warnings import scene_warnings

__all__ = ["EXAMPLE", "add_arguments", "execute"]

EXAMPLE = "exu-press wear million.toml --out out/million"

STOPPED = 3


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the command's arguments."""
    add_study_arguments(parser)


def execute(options: argparse.Namespace) -> int:
    """Run the study; return 0, or 3 where not all strokes were done, or after Ctrl-C."""
    return resumable(_execute, options)


def _execute(options: argparse.Namespace, directory: Path) -> int:
    from exu_press.studies.base import load_study
    from exu_press.studies.wear import WearStudy, wear
    from exu_press.studies.wear.lines import report_lines

    study = load_study(options.study, WearStudy)
    report = wear(study, directory, workers=options.workers, dask=options.dask, quiet=options.quiet)
    remove_pictures(directory, "wear")
    written = ["wear.json", "worn.toml"]
    if not options.no_pictures:
        from exu_press.plots.file import save_figure
        from exu_press.plots.wear import wear_figure

        written.append(save_figure(wear_figure(report), directory / "wear.png").name)
    if not options.quiet:
        print("\n".join(report_lines(report)))
        show_warnings(scene_warnings(study.scene))
        print("written:", ", ".join(written), f"in {directory}")
    return STOPPED if report.reason else 0
