"""Impacts of which other runs leave it open whether they happen."""

from collections.abc import Mapping

import numpy as np

from exu_press.quantities.joints import contact_onsets
from exu_press.result import Result

__all__ = ["are_doubtful"]


def are_doubtful(joint: str, run: Result, refinements: Mapping[float, Result]) -> bool:
    """Return whether surfaces touch more or less often if the gap is off by its error.

    Runs agree on a count by chance where a touch, or the flight between two, is no higher than
    their errors.

    Args:
        joint: its name.
        run: the part of it from which quantities are read.
        refinements: ratio of errors to the run's, see `error_ratio` -> run.
    """
    onset, gap = run.scene.joints[joint].onset, run.joints[joint].gap
    assert onset is not None
    errors = [
        np.abs(np.interp(run.time, refined.time, refined.joints[joint].gap) - gap) / abs(1.0 - r)
        for r, refined in refinements.items()
    ]
    error = np.max(errors, axis=0)
    depth = onset - gap
    counts = {len(contact_onsets(values)) for values in (depth - error, depth, depth + error)}
    return len(counts) > 1
