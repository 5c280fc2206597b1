"""Numbers of ours beside those that others measured, printed or computed.

A test of these is marked `validation`, which says whose numbers they are, and it asks for the
fixture `compare`, which checks them and keeps them for `scripts/validation.py`.
"""

from dataclasses import asdict, dataclass

import numpy as np

KINDS = {
    "measurement": "Measurements",
    "table": "Published tables and solutions",
    "code": "Other codes",
    "closed form": "Closed forms",
    "independent": "Independent models",
}
"""Who has the numbers -> heading of the page: an independent model is written for the tests."""


@dataclass(frozen=True)
class Origin:
    """Whose numbers a test compares with: the arguments of its mark.

    Attributes:
        kind: of `KINDS`.
        subject: what is compared.
        source: author, title, year; a transcription names its repository.
        licence: of the numbers, or of what they are read from.
        remark: likely reason of what deviates.
    """

    kind: str
    subject: str
    source: str
    licence: str
    remark: str = ""

    def __post_init__(self):
        if self.kind not in KINDS:
            raise ValueError(f"validation({self.kind!r}, ...): allowed are {', '.join(KINDS)}")


@dataclass(frozen=True)
class Comparison:
    """A quantity by others and by us; of many values the one that deviates most.

    Attributes:
        error: of ours, of which 0 is exact; in the unit, as are theirs and ours. None where both
            solve the same equations, so that the deviation is the error.
        deviation: ours less theirs, in the unit, or over `scale`.
        allowed: largest deviation.
        is_relative: whether those two are over the scale.
        count: of the values compared.
    """

    quantity: str
    unit: str
    theirs: float
    ours: float
    error: float | None
    deviation: float
    allowed: float
    is_relative: bool
    count: int


class Compare:
    """Checks ours against theirs, and keeps the comparison with the test."""

    def __init__(self, node):
        mark = node.get_closest_marker("validation")
        self._origin = Origin(*mark.args, **mark.kwargs)
        self._properties = node.user_properties

    def __call__(
        self, quantity, theirs, ours, *, error, rel=None, abs=None, scale=None, unit="", show=1.0
    ):
        """Raise AssertionError where ours deviate by more than is allowed.

        Args:
            quantity: its name.
            theirs: a number or an array of them.
            ours: likewise.
            error: of ours: a number or an array, 0 for exact ones, None where the deviation is it.
            rel: largest deviation over theirs, or over `scale`; or
            abs: largest deviation.
            scale: what `rel` is a share of, unless of theirs themselves.
            unit: as the page has it.
            show: what the page multiplies the numbers by, to have them in the unit.
        """
        spread = 0.0 if error is None else error
        theirs, ours, spread = np.broadcast_arrays(*map(np.atleast_1d, (theirs, ours, spread)))
        assert (rel is None) != (abs is None), "either rel or abs"
        size = 1.0 / show if rel is None else np.abs(theirs) if scale is None else scale
        deviation = (ours - theirs) / size
        worst = np.unravel_index(np.nanargmax(np.abs(deviation)), deviation.shape)
        comparison = Comparison(
            quantity,
            unit,
            show * float(theirs[worst]),
            show * float(ours[worst]),
            None if error is None else show * float(spread[worst]),
            float(deviation[worst]),
            float(abs * show if rel is None else rel),
            abs is None,
            int(np.isfinite(deviation).sum()),
        )
        self._properties.append(("comparison", asdict(self._origin) | asdict(comparison)))
        assert np.abs(comparison.deviation) <= comparison.allowed, comparison
