"""Find the keys that make a press best: one objective, or several against each other."""

import argparse
from pathlib import Path

from exu_press.cli.options import add_study_arguments, resumable, show_warnings
from exu_press.files.output_directory import remove_pictures
from exu_press.scene.warnings import scene_warnings

__all__ = ["EXAMPLE", "add_arguments", "execute"]

EXAMPLE = "exu-press optimise clearances.toml --out out/clearances"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the command's arguments."""
    add_study_arguments(parser)


def execute(options: argparse.Namespace) -> int:
    """Run the search; return 0, or 3 after Ctrl-C."""
    return resumable(_execute, options)


def _execute(options: argparse.Namespace, directory: Path) -> int:
    from exu_press.studies.base import load_study
    from exu_press.studies.optimise import Optimise, optimise
    from exu_press.studies.optimise.lines import report_lines

    study = load_study(options.study, Optimise)
    report = optimise(
        study, directory, workers=options.workers, dask=options.dask, quiet=options.quiet
    )
    remove_pictures(directory, "optimise")
    written = ["optimise.json", "trials.csv", "chosen.toml", "front/"]
    if not options.no_pictures:
        from exu_press.plots.front import save_front

        written.append(save_front(report, directory).name)
    if not options.quiet:
        print("\n".join(report_lines(report)))
        show_warnings(scene_warnings(report.scenes[report.chosen]))
        print("written:", ", ".join(written), f"in {directory}")
    return 0
