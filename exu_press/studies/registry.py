"""The studies by the names of their commands; a study's module is imported when it is named."""

from pathlib import Path
from typing import TYPE_CHECKING

from fe_models.lazy import named_object

if TYPE_CHECKING:
    from exu_press.studies.base.command import StudyCommand

__all__ = ["STUDIES", "study_command", "study_source"]

GROUP = "exu_press.studies"
"""Entry points by which installed distributions add studies."""

STUDIES = {
    "sweep": "exu_press.studies.sweep.run:SweepCommand",
    "attractor": "exu_press.studies.attractor.run:AttractorCommand",
    "bifurcation": "exu_press.studies.bifurcation.run:BifurcationCommand",
    "fit": "exu_press.studies.fit.run:FitCommand",
    "sensitivity": "exu_press.studies.sensitivity.run:SensitivityCommand",
    "optimise": "exu_press.studies.optimise.run:OptimiseCommand",
    "wear": "exu_press.studies.wear.run:WearCommand",
    "bearing": "exu_press.studies.bearing.run:BearingCommand",
    "precision": "exu_press.studies.precision.run:PrecisionCommand",
    "stability": "exu_press.studies.stability.run:StabilityCommand",
}


def study_command(name: str) -> "type[StudyCommand] | None":
    """Return the command of a study, also of one that an installed distribution registers.

    Raises:
        InputError: what a distribution registers is no such class.
    """
    if name in STUDIES:
        return named_object(STUDIES[name])  # type: ignore[no-any-return]
    from exu_press.schema.registered import registered_class  # seldom needed
    from exu_press.studies.base.command import StudyCommand

    return registered_class("study", name, StudyCommand, GROUP)


def study_source(name: str) -> Path:
    """Return the file of a study of the package; its first line says what its command does."""
    module = STUDIES[name].partition(":")[0]
    return Path(__file__).parents[1].joinpath(*module.split(".")[1:]).with_suffix(".py")
