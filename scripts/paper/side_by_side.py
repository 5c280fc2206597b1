"""Both readings of the damping beside each other: how far the peaks lie from the paper's.

The distance is the root mean square of the logarithms of ours over the paper's, over all peak
accelerations that the paper computed. A factor of 2 in every one of them is 0.69.
"""

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from paper.comparison import observed
from paper.published import Number
from paper.readings import MODELS, OBSERVED
from paper.settings import AS_THEY_ARE, Setting

__all__ = ["Peaks", "distance", "distances_by_setting", "peaks_of"]

Row = Mapping[str, Any]
Values = tuple[float | None, ...]


@dataclass(frozen=True)
class Peaks:
    """The computed peak accelerations of section 5 with one reading and one kind of bodies.

    Attributes:
        bodies: "flexible" or "rigid".
        numbers: the published ones.
        values: ours, by model of observation, in the order of `numbers`, m/s^2; None where a run
            did not get to its end.
        whole: the same, observed from the start on and not in the last revolution alone.
        coarser: over 1 ms, at a tolerance ten times as large. Where it differs, the scene does not
            determine the peak: contacts that lose nothing amplify every difference.
    """

    bodies: str
    numbers: tuple[Number, ...]
    values: Mapping[str, Values]
    whole: Mapping[str, Values]
    coarser: Values

    def distances(self, values: Mapping[str, Values]) -> dict[str, float | None]:
        """Return the distance to the paper under every model of observation."""
        aims = [number.published for number in self.numbers]
        return {model: distance(values[model], aims) for model in values}

    def sampling(self) -> float | None:
        """Return the largest ratio of a resolved peak to the mean over 1 ms."""
        ratios = [
            resolved / mean
            for resolved, mean in zip(self.values["resolved"], self.values[OBSERVED], strict=True)
            if resolved is not None and mean is not None
        ]
        return max(ratios, default=None)

    def to_dict(self) -> dict[str, Any]:
        """Return the entries of paper.json."""
        return {
            "bodies": self.bodies,
            "names": [number.name for number in self.numbers],
            "published": [number.published for number in self.numbers],
            "values": {model: list(values) for model, values in self.values.items()},
            "whole_run": {model: list(values) for model, values in self.whole.items()},
            "mean_1ms_at_a_coarser_tolerance": list(self.coarser),
            "distances": self.distances(self.values),
            "distances_whole_run": self.distances(self.whole),
            "resolved_over_mean_1ms": self.sampling(),
        }


def peaks_of(
    bodies: str, numbers: Iterable[Number], rows: Mapping[str, Row], coarser: Mapping[str, Row]
) -> Peaks:
    """Return the peaks of runs.

    Args:
        bodies: of the runs.
        numbers: published ones, of any measure.
        rows: of the runs by name.
        coarser: of the same runs at a tolerance ten times as large.
    """
    some = computed_peaks(numbers)
    return Peaks(
        bodies,
        some,
        {m: tuple(observed(rows[n.run], n.measure, m) for n in some) for m in MODELS},
        {m: tuple(observed(rows[n.run], n.measure, m, whole=True) for n in some) for m in MODELS},
        tuple(observed(coarser[n.run], n.measure, OBSERVED) for n in some),
    )


def computed_peaks(numbers: Iterable[Number]) -> tuple[Number, ...]:
    """Return the peak accelerations that the paper computed."""
    return tuple(n for n in numbers if n.measure == "peak_acceleration" and not n.reference)


def distances_by_setting(
    numbers: Iterable[Number],
    baselines: Mapping[str, Row],
    varied: Mapping[str, Sequence[tuple[Setting, Row]]],
) -> dict[str, float | None]:
    """Return the distance with each setting alone, by its words, and first with none.

    What a setting does not touch stays.

    Args:
        numbers: published ones, of any measure.
        baselines: rows of runs that nothing is changed in, by name of the run.
        varied: every setting that applies to a run, with its row.
    """
    some = computed_peaks(numbers)
    known = {
        number.run: {setting.words: (setting, row) for setting, row in varied[number.run]}
        for number in some
    }
    labels = dict.fromkeys(label for changes in known.values() for label in changes)
    found = {}
    for label in (AS_THEY_ARE, *labels):
        values = [setting_value(known[n.run].get(label), baselines[n.run], n.measure) for n in some]
        found[label] = distance(values, [number.published for number in some])
    return found


def setting_value(changed: tuple[Setting, Row] | None, baseline: Row, measure: str) -> float | None:
    """Return a measure of a changed run, or of the baseline where the change does not apply."""
    if changed is None:
        return observed(baseline, measure, OBSERVED)
    setting, row = changed
    return observed(row, measure, setting.model or OBSERVED, whole=setting.whole_run)


def distance(values: Iterable[float | None], aims: Iterable[float]) -> float | None:
    """Return the root mean square of the logarithms of values over aims; None with one missing.

    >>> distance([2.0, 0.5], [1.0, 1.0]) == math.log(2.0)
    True
    """
    pairs = list(zip(values, aims, strict=True))
    logarithms = [math.log(value / aim) for value, aim in pairs if value]
    if not pairs or len(logarithms) < len(pairs):
        return None
    return math.sqrt(sum(x * x for x in logarithms) / len(logarithms))
