"""The ratios the package has set itself, computed from the rows of one run on one machine.

Of processor times: all runs have one thread, and another program beside them does not count.
"""

from collections.abc import Sequence
from dataclasses import dataclass

from exu_press.studies.precision.rows import Row, series_of
from exu_press.studies.precision.timing import FIXED, TOLERANCE

__all__ = ["Goal", "cheapest", "goals_of"]

PEAK, PEAK_LIMIT = "error_peak_acceleration", 5e-3
PEAKS, PEAKS_LIMIT = "error_peaks", 2e-2
POSITION, POSITION_LIMIT = "error_position", 1e-6

AGAINST_FIXED = (
    ("press_lubricated", PEAK, PEAK_LIMIT, 1 / 60),
    ("press_dry", PEAKS, PEAKS_LIMIT, 1.0),
    ("press_flexible_lubricated", PEAK, 1e-2, 1 / 20),
)
"""Case, kind of error, its limit, and the part of the best fixed step's time."""
IN_WORDS = {
    PEAK: "peak acceleration until the horizon",
    PEAKS: "mean and 95th percentile of the peaks of the whole run",
}
PEER_RATIOS = {"SciPy Radau": 1.0, "SciPy BDF": 1.0, "SciPy LSODA": 10.0}
PEER_CASE = "slider_crank_dry_0.1mm"
REAL_TIME = (
    ("press_ideal", PEAK, PEAK_LIMIT),
    ("press_lubricated", PEAK, PEAK_LIMIT),
    ("press_dry", PEAKS, PEAKS_LIMIT),
)


@dataclass(frozen=True)
class Goal:
    """One ratio of run times.

    Attributes:
        what: in words.
        ratio: our time over the other's; None where one of them did not get there.
        at_most: what is aimed at.
        ours: our run, in words.
        other: what it is compared with, in words.
    """

    what: str
    ratio: float | None
    at_most: float
    ours: str
    other: str

    @property
    def met(self) -> bool | None:
        """Whether the goal is met; None where there is nothing to compare."""
        return None if self.ratio is None else self.ratio <= self.at_most

    def lines(self) -> list[str]:
        """Return the goal for the terminal."""
        verdict = {True: "met", False: "NOT MET", None: "not to be told"}[self.met]
        ratio = "-" if self.ratio is None else f"{self.ratio:.3g}"
        return [
            f"goal {verdict}: {self.what}: {ratio}, wanted <= {self.at_most:.3g}",
            f"  {self.ours} against {self.other}",
        ]


def goals_of(rows: Sequence[Row], durations: dict[str, float]) -> list[Goal]:
    """Return every goal whose cases were run.

    Args:
        rows: of all cases.
        durations: case -> simulated time, s.
    """
    series, goals = series_of(rows), []
    for case, error, limit, ratio in AGAINST_FIXED:
        if case in durations:
            ours = cheapest(series.get((case, TOLERANCE), []), error, limit)
            other = cheapest(series.get((case, FIXED), []), error, limit)
            what = f"{case}: {IN_WORDS[error]} within {limit:.1%}, time over the best fixed step's"
            goals.append(_goal(what, ours, other, ratio))
    if PEER_CASE in durations:
        ours = cheapest(series.get((PEER_CASE, TOLERANCE), []), POSITION, POSITION_LIMIT)
        for peer, ratio in PEER_RATIOS.items():
            other = cheapest(series.get((PEER_CASE, peer), []), POSITION, POSITION_LIMIT)
            what = f"{PEER_CASE}: position within 1e-6 m, time over {peer}'s"
            goals.append(_goal(what, ours, other, ratio))
    for case, error, limit in REAL_TIME:
        if case in durations:
            ours = cheapest(series.get((case, TOLERANCE), []), error, limit)
            time, within = durations[case], f"{limit:.1%}"
            goals.append(
                Goal(
                    f"{case}: {IN_WORDS[error]} within {within}, run time over simulated time",
                    None if ours is None else ours.cpu_time / time,
                    1.0,
                    _words(ours),
                    f"{time:g} s simulated",
                )
            )
    return goals


def cheapest(series: Sequence[Row], error: str, limit: float) -> Row | None:
    """Return the quickest run with at most an error, among settings that are not just lucky.

    A setting counts where it and every finer one that was completed has at most this error.
    """
    good: list[Row] = []
    for row in reversed(series):
        if row.status != "completed":
            continue
        value = getattr(row, error)
        if value is None or value > limit:
            break
        good.append(row)
    return min(good, key=lambda row: row.cpu_time, default=None)


def _goal(what: str, ours: Row | None, other: Row | None, at_most: float) -> Goal:
    ratio = None if ours is None or other is None else ours.cpu_time / other.cpu_time
    return Goal(what, ratio, at_most, _words(ours), _words(other))


def _words(row: Row | None) -> str:
    if row is None:
        return "no setting that was run gets there"
    return f"{row.solver} at {row.value:g}: {row.cpu_time:.3g} s"
