"""Find out which tolerances decide: Sobol indices, a tornado, and the spread of presses."""

from pathlib import Path
from typing import Any

import numpy as np

from exu_press.errors import InputError
from exu_press.numerics.arrays import Array
from exu_press.studies.base import Runs
from exu_press.studies.base.command import StudyCommand
from exu_press.studies.base.evaluation import Evaluation, error_in, with_errors_of
from exu_press.studies.sensitivity.indices import indices, sample
from exu_press.studies.sensitivity.report import SensitivityReport
from exu_press.studies.sensitivity.spread import spread, tornado
from exu_press.studies.sensitivity.study import Sensitivity

__all__ = ["SensitivityCommand", "sensitivity"]


def sensitivity(study: Sensitivity, directory: str | Path, **how: Any) -> SensitivityReport:
    """Do the runs that are missing, write sensitivity.json and samples.csv; return the result.

    Arguments and errors are those of `exu_press.studies.base.Runs`.

    Raises:
        InputError: also where so many runs fail that no sample is left.
    """
    settings, keys = study.sensitivity, study.keys
    with Runs(study, directory, report=SensitivityReport, **how) as runs:
        evaluation = Evaluation(study, settings.quantities, runs.run_scenes)

        def evaluate(shares: Array) -> Array:
            return evaluation([study.point_of(share) for share in shares])

        middle, bars = tornado(evaluate, len(keys))
        values = sample(evaluate, len(keys), settings.samples, settings.seed)
        if values is None:
            raise InputError(
                f"{evaluation.summary_line()}: too few for {settings.samples} samples; the cure "
                "is narrower distributions, or what the runs' reasons say"
            )
    medians = study.scene_at(study.point_of(np.full(len(keys), 0.5)))
    (checked,) = with_errors_of(study, directory, [medians], **how)
    report = SensitivityReport(
        study,
        values,
        indices(values),
        [spread(quantity, settings.share) for quantity in values.values],
        middle,
        bars,
        [error_in(checked, name) for name in settings.quantities],
        evaluation.run_summary(),
    )
    report.save(Path(directory))
    return report


class SensitivityCommand(StudyCommand):
    """`exu-press sensitivity`."""

    example = "exu-press sensitivity tolerances.toml --out out/tolerances"
    study = Sensitivity
    run = staticmethod(sensitivity)
