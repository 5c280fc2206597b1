"""Run a sensitivity study."""

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from exu_press.errors import InputError
from exu_press.files.output_directory import write_json
from exu_press.numerics.arrays import Array
from exu_press.schema.csv_table import write_csv
from exu_press.studies.base import Runs
from exu_press.studies.base.evaluation import Evaluation, error_in, with_errors_of
from exu_press.studies.sensitivity.indices import Indices, Sample, indices, sample
from exu_press.studies.sensitivity.spread import Spread, spread, tornado
from exu_press.studies.sensitivity.study import Sensitivity

__all__ = ["Report", "sensitivity"]

WRITTEN = ("sensitivity.json", "samples.csv")


@dataclass(frozen=True)
class Report:
    """The result of a sensitivity study; quantities and keys in the study's order.

    Attributes:
        study: whose report this is.
        sample: values at the sampled points.
        indices: of each quantity; None of one that does not move.
        spreads: of each quantity.
        middle: values with all keys at their medians, (s,).
        bars: values with one key at the ends of its distribution, (k, 2, s).
        errors: of each quantity in the run with all keys at their medians; None where unknown.
        told: how many runs gave numbers, in lines.
    """

    study: Sensitivity
    sample: Sample
    indices: list[Indices | None]
    spreads: list[Spread]
    middle: Array
    bars: Array
    errors: list[float | None]
    told: list[str]

    def to_dict(self) -> dict[str, Any]:
        """Return the contents of sensitivity.json."""
        names = self.study.sensitivity.quantities
        found = {name: self._of(place) for place, name in enumerate(names)}
        return {"runs": self.told, "drawn": self.sample.drawn, "quantities": found}

    def columns(self) -> dict[str, list[float]]:
        """Return keys and quantities of the two independent samples, the contents of samples.csv.

        These presses are drawn from the distributions, and no key is the same in two of them.
        """
        shares = np.concatenate(self.sample.shares)
        points = [self.study.point_at(share) for share in shares]
        found = {name: [point[name] for point in points] for name in self.study.keys}
        names = self.study.sensitivity.quantities
        return found | dict(zip(names, self.sample.values.tolist(), strict=True))

    def _of(self, place: int) -> dict[str, Any]:
        """Return the entry of one quantity."""
        one, each = self.indices[place], self.spreads[place]
        keys: dict[str, Any] = {}
        for n, key in enumerate(self.study.keys):
            ends = self.bars[n, :, place]
            keys[key] = {"alone": [None if np.isnan(end) else float(end) for end in ends]}
            if one is not None:
                keys[key]["first_order"] = _told(one.first, one.first_bounds, n)
                keys[key]["total_order"] = _told(one.total, one.total_bounds, n)
        return {
            "percentiles": {"5": each.low, "50": each.middle, "95": each.high},
            "mean": each.mean,
            "deviation": each.deviation,
            "share": self.study.sensitivity.share,
            "half_width": each.half,
            "half_width_standard_error": each.half_error,
            "error_of_a_run": self.errors[place],
            "moves": one is not None,
            "keys": keys,
        }


def _told(values: Array, bounds: Array, place: int) -> dict[str, float]:
    low, high = map(float, bounds[place])
    return {"value": float(values[place]), "low": low, "high": high}


def sensitivity(study: Sensitivity, directory: str | Path, **how: Any) -> Report:
    """Do the runs that are missing, write sensitivity.json and samples.csv; return the result.

    Called again after a kill or Ctrl-C, it goes on.

    Args:
        study: to be run.
        directory: of this study alone.
        how: workers, dask, quiet of `exu_press.studies.base.Runs`.

    Raises:
        InputError: the directory cannot be used or belongs to another study, no scheduler answers,
            or so many runs fail that no sample is left.
    """
    asked, keys = study.sensitivity, study.keys
    with Runs(study, directory, written=WRITTEN, label="sensitivity", **how) as runs:
        evaluation = Evaluation(study, asked.quantities, runs.of)

        def evaluate(shares: Array) -> Array:
            return evaluation([study.point_at(share) for share in shares])

        middle, bars = tornado(evaluate, len(keys))
        found = sample(evaluate, len(keys), asked.samples, asked.seed)
        if found is None:
            raise InputError(
                f"{'; '.join(evaluation.told())}: too few for {asked.samples} samples; the cure is "
                "narrower distributions, or what the runs' reasons say"
            )
    medians = study.scene_at(study.point_at(np.full(len(keys), 0.5)))
    (checked,) = with_errors_of(study, directory, [medians], **how)
    report = Report(
        study,
        found,
        indices(found),
        [spread(values, asked.share) for values in found.values],
        middle,
        bars,
        [error_in(checked, name) for name in asked.quantities],
        evaluation.told(),
    )
    write_json(Path(directory) / "sensitivity.json", report.to_dict())
    write_csv(Path(directory) / "samples.csv", report.columns())
    return report
