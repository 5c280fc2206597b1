"""Find keys of a scene from a measurement: best values, intervals, what it does not determine."""

import argparse
from pathlib import Path

from exu_press.cli.options import add_study_arguments, resumable, show_warnings
from exu_press.files.output_directory import remove_pictures
from exu_press.scene.warnings import scene_warnings

__all__ = ["EXAMPLE", "add_arguments", "execute"]

EXAMPLE = "exu-press fit measured.toml --out out/measured"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the command's arguments."""
    add_study_arguments(parser)


def execute(options: argparse.Namespace) -> int:
    """Run the fit; return 0, or 3 after Ctrl-C."""
    return resumable(_execute, options)


def _execute(options: argparse.Namespace, directory: Path) -> int:
    from exu_press.studies.base import load_study
    from exu_press.studies.fit import Fit, fit
    from exu_press.studies.fit.lines import report_lines

    study = load_study(options.study, Fit)
    report = fit(study, directory, workers=options.workers, dask=options.dask, quiet=options.quiet)
    remove_pictures(directory, "fit")
    written = ["fit.json", "fitted.toml"]
    if not options.no_pictures:
        from exu_press.plots.fit import save_fit

        written += [path.name for path in save_fit(report, directory)]
    if not options.quiet:
        print("\n".join(report_lines(report)))
        show_warnings(scene_warnings(report.scene))
        print("written:", ", ".join(written), f"in {directory}")
    return 0
