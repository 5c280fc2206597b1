"""Run many scenes, as a study file says: table.csv, table.nc and a picture; may be interrupted."""

import argparse
from dataclasses import replace
from pathlib import Path
from typing import Any

from exu_press.errors import InputError, error_prefix
from exu_press.parallel import FILE
from exu_press.quantities import quantities_of
from exu_press.studies.base import Runs, Study
from exu_press.studies.base.command import StudyCommand
from exu_press.studies.sweep.report import SweepReport, report_of
from exu_press.studies.sweep.study import Sweep

__all__ = ["SweepCommand", "sweep"]


def sweep(study: Sweep, directory: str | Path, **how: Any) -> SweepReport:
    """Run the points that are missing, write table.csv and table.nc, and return the report.

    Arguments and errors are those of `exu_press.studies.base.Runs`.
    """
    directory = Path(directory)
    with Runs(study, directory, report=SweepReport, **how) as runs:
        digits = len(str(len(study.points)))
        numbers = range(1, len(study.points) + 1)
        files = [f"runs/{n:0{digits}}.nc" for n in numbers] if study.save_runs else []
        rows = runs.run_scenes(study.scenes, files)
        with error_prefix(f"{directory / FILE}: not rows of a sweep: "):
            report = report_of(study, rows, files)
        report.save(directory)
    return report


class SweepCommand(StudyCommand):
    """`exu-press sweep`, with a choice of what is shown."""

    example = "exu-press sweep study.toml --workers 2 --out out/study"
    study = Sweep
    run = staticmethod(sweep)

    @classmethod
    def add_arguments(cls, parser: argparse.ArgumentParser) -> None:
        """Add what is shown."""
        parser.add_argument(
            "--over",
            action="append",
            default=[],
            metavar="KEY",
            help="key on a picture's axis; at most twice (default: the first two that vary)",
        )
        parser.add_argument(
            "--show",
            action="append",
            default=[],
            metavar="COLUMN",
            help="print and draw this column of the table; may be repeated",
        )

    @classmethod
    def load(cls, options: argparse.Namespace) -> Study:
        """Return the study; raise InputError where what is to be shown is none of it."""
        study = super().load(options)
        assert isinstance(study, Sweep)
        unknown = [key for key in options.over if key not in study.keys]
        if unknown:
            raise InputError(f"--over {unknown[0]}: allowed are {', '.join(study.keys)}")
        for name in options.show:
            if not any(name in quantities_of(scene) for scene in study.scenes):
                allowed = ", ".join(quantities_of(study.scenes[0]))
                raise InputError(f"--show {name}: allowed are {allowed}")
        return study

    @staticmethod
    def select(report: SweepReport, options: argparse.Namespace) -> SweepReport:
        """Return the report with the chosen axes and columns."""
        return replace(report, axes=options.over, selected=options.show)
