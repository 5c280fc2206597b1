"""Find a bearing's equilibrium, stiffness, damping, side flow, power and critical mass."""

import argparse
from pathlib import Path
from typing import Any

from exu_press.studies.base.command import SceneCommand
from exu_press.studies.bearing.coefficients import bearing_coefficients
from exu_press.studies.bearing.report import BearingReport
from exu_press.studies.bearing.study import BearingStudy

__all__ = ["BearingCommand"]


class BearingCommand(SceneCommand):
    """`exu-press bearing`."""

    example = "exu-press bearing press crank_pin --set film.law=finite --load 1e5 --speed 240"
    study = BearingStudy
    uses_workers = False

    @classmethod
    def add_arguments(cls, parser: argparse.ArgumentParser) -> None:
        """Add the joint, its loads and its speeds."""
        parser.add_argument("joint", metavar="JOINT", help="name of a lubricated journal")
        several: dict[str, Any] = {"nargs": "+", "type": float, "required": True}
        parser.add_argument(
            "--load", metavar="F", dest="loads", help="on the journal, N; or several", **several
        )
        parser.add_argument(
            "--speed", metavar="RPM", dest="speeds", help="of the journal; or several", **several
        )
        parser.add_argument(
            "--direction",
            type=float,
            default=-90.0,
            metavar="DEG",
            help="of the load, from the drawing's x axis (-90, down)",
        )

    @staticmethod
    def run(study: BearingStudy, directory: Path, **how: Any) -> BearingReport:
        """Compute each load at each speed."""
        rows = [
            bearing_coefficients(
                study.scene, study.joint, load=study.load_vector(load), speed_rpm=speed
            )
            for speed in study.speeds
            for load in study.loads
        ]
        return BearingReport(study, rows)
