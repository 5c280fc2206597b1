"""The long run over a key of the scene, up and down, or over two: periods, exponents."""

import argparse
from pathlib import Path

from exu_press.cli.options import (
    add_format_argument,
    add_study_arguments,
    check_format,
    resumable,
)

__all__ = ["EXAMPLE", "add_arguments", "execute"]

EXAMPLE = "exu-press bifurcation clearance.toml --out out/clearance"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the command's arguments."""
    add_study_arguments(parser)
    add_format_argument(parser)


def execute(options: argparse.Namespace) -> int:
    """Run the study; return 0, or 3 after Ctrl-C."""
    check_format(options)
    return resumable(_execute, options)


def _execute(options: argparse.Namespace, directory: Path) -> int:
    from exu_press.studies.base import load_study
    from exu_press.studies.bifurcation import Bifurcation, bifurcation

    study = load_study(options.study, Bifurcation)
    report = bifurcation(
        study, directory, workers=options.workers, dask=options.dask, quiet=options.quiet
    )
    written = ["bifurcation.json"]
    if not options.no_pictures:
        from exu_press.plots.bifurcation import bifurcation_figure
        from exu_press.plots.file import save_figure
        from exu_press.plots.period_map import period_map_figure

        figure = (bifurcation_figure if study.second is None else period_map_figure)(report)
        written.append(save_figure(figure, directory / f"bifurcation{options.format}").name)
    if not options.quiet:
        print("\n".join(report.lines()))
        print("written:", ", ".join(written), f"in {directory}")
    return 0
