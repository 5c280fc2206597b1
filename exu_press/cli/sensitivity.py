"""Find out which tolerances decide: Sobol indices, a tornado, and what presses built will show."""

import argparse
from pathlib import Path

from exu_press.cli.options import add_study_arguments, resumable, show_warnings
from exu_press.files.output_directory import remove_pictures
from exu_press.scene.warnings import scene_warnings

__all__ = ["EXAMPLE", "add_arguments", "execute"]

EXAMPLE = "exu-press sensitivity tolerances.toml --out out/tolerances"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the command's arguments."""
    add_study_arguments(parser)


def execute(options: argparse.Namespace) -> int:
    """Run the study; return 0, or 3 after Ctrl-C."""
    return resumable(_execute, options)


def _execute(options: argparse.Namespace, directory: Path) -> int:
    from exu_press.studies.base import load_study
    from exu_press.studies.sensitivity import Sensitivity, sensitivity
    from exu_press.studies.sensitivity.lines import report_lines

    study = load_study(options.study, Sensitivity)
    report = sensitivity(
        study, directory, workers=options.workers, dask=options.dask, quiet=options.quiet
    )
    remove_pictures(directory, "sensitivity")
    written = ["sensitivity.json"]
    if not options.no_pictures:
        from exu_press.plots.sensitivity import save_sensitivity

        written.append(save_sensitivity(report, directory).name)
    if not options.quiet:
        print("\n".join(report_lines(report)))
        show_warnings(scene_warnings(study.scene))
        print("written:", ", ".join(written), f"in {directory}")
    return 0
