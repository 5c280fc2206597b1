"""Analyse the motion in the long run: period, Lyapunov exponent, figures by revolution."""

import argparse
import dataclasses
from collections.abc import Mapping
from pathlib import Path
from types import MappingProxyType
from typing import Any

from exu_press.scene import Scene
from exu_press.schema.checks import Table, key
from exu_press.studies.attractor.period import MOST
from exu_press.studies.attractor.report import AttractorReport
from exu_press.studies.attractor.study import attractor
from exu_press.studies.base import Study
from exu_press.studies.base.command import SceneCommand
from exu_press.studies.base.keys import Key

__all__ = ["AttractorCommand", "AttractorStudy", "Revolutions"]


@dataclasses.dataclass(frozen=True)
class Revolutions(Table):
    """How long the run is, and what of it is read.

    Attributes:
        quantities: full names, and channels; the headline ones where there are none.
    """

    table = "attractor"

    revolutions: int = key(100, "after the transient")
    skip: int = key(30, "revolutions of the transient")
    longest: int = key(MOST, "longest period looked for, revolutions")
    quantities: tuple[str, ...] = ()


@dataclasses.dataclass(frozen=True)
class AttractorStudy(Study):
    """The long run of one scene.

    Attributes:
        attractor: how long it is.
    """

    with_keys = plain_runs = False
    tables = MappingProxyType({"attractor": Revolutions})

    keys: Mapping[str, Key] = dataclasses.field(default_factory=dict)
    attractor: Revolutions = Revolutions()


class AttractorCommand(SceneCommand):
    """`exu-press attractor`."""

    example = "exu-press attractor press --set joints.crank_pin=dry --revolutions 100 --skip 30"
    study = AttractorStudy
    uses_workers = False
    replaced_keys = MappingProxyType({"revolutions": "--revolutions", "settle": "--skip"})

    @staticmethod
    def add_arguments(parser: argparse.ArgumentParser) -> None:
        """Add the length of the run, and what of it is read."""
        parser.add_argument(
            "--revolutions",
            type=int,
            default=100,
            metavar="N",
            help="after the transient (100); the scene's own do not count",
        )
        parser.add_argument(
            "--skip", type=int, default=30, metavar="N", help="revolutions of the transient (30)"
        )
        parser.add_argument(
            "--longest", type=int, default=MOST, metavar="N", help="longest period looked for (16)"
        )
        parser.add_argument(
            "--quantity",
            action="append",
            default=[],
            metavar="NAME",
            help="keep this quantity of each revolution; may be repeated (the headline ones)",
        )

    @classmethod
    def study_of(cls, scene: Scene, options: argparse.Namespace) -> Study:
        """Return the study of a scene."""
        length = Revolutions(
            options.revolutions, options.skip, options.longest, tuple(options.quantity)
        )
        return AttractorStudy(scene, attractor=length)

    @staticmethod
    def run(study: AttractorStudy, directory: Path, **how: Any) -> AttractorReport:
        """Run for long, and return the report."""
        own = study.attractor
        motion = attractor(
            study.scene,
            revolutions=own.revolutions,
            skip=own.skip,
            names=own.quantities,
            most=own.longest,
            **how,
        )
        return AttractorReport(motion)
