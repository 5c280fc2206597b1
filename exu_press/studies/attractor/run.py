"""Analyse the motion in the long run: period, Lyapunov exponent, figures by revolution."""

import dataclasses
from pathlib import Path
from types import MappingProxyType
from typing import Any

from exu_press.schema.checks import key
from exu_press.studies.attractor.motion import attractor
from exu_press.studies.attractor.period import MOST
from exu_press.studies.attractor.report import AttractorReport
from exu_press.studies.base.command import SceneCommand, SceneStudy, list_of_texts

__all__ = ["AttractorCommand", "AttractorStudy"]


@dataclasses.dataclass(frozen=True)
class AttractorStudy(SceneStudy):
    """The long run of one scene."""

    revolutions: int = key(100, "after the transient; the scene's own do not count")
    skip: int = key(30, "revolutions of the transient")
    longest: int = key(MOST, "longest period looked for")
    quantity: tuple[str, ...] = list_of_texts(
        "keep this quantity, or channel, of each revolution (the headline ones)"
    )


class AttractorCommand(SceneCommand):
    """`exu-press attractor`."""

    example = "exu-press attractor press --set joints.crank_pin=dry --revolutions 100 --skip 30"
    study = AttractorStudy
    uses_workers = False
    replaced_keys = MappingProxyType({"revolutions": "--revolutions", "settle": "--skip"})

    @staticmethod
    def run(study: AttractorStudy, directory: Path, **how: Any) -> AttractorReport:
        """Run for long, and return the report."""
        motion = attractor(
            study.scene,
            revolutions=study.revolutions,
            skip=study.skip,
            names=study.quantity,
            most=study.longest,
            **how,
        )
        return AttractorReport(motion)
