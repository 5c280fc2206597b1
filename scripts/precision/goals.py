"""The ratios the package has set itself, computed from the rows of one run on one machine.

Of processor times: all runs have one thread, and another program beside them does not count.
"""

from collections.abc import Sequence

from exu_press.studies.precision.own import FIXED, TOLERANCE
from exu_press.studies.precision.report import Goal
from exu_press.studies.precision.rows import Row, cheapest, series_of

__all__ = ["goals_of"]

PEAK, PEAK_LIMIT = "error_peak_acceleration", 5e-3
POSITION, POSITION_LIMIT = "error_position", 1e-6

AGAINST_FIXED = (
    ("press_lubricated", PEAK_LIMIT, 1 / 60),
    ("press_dry", PEAK_LIMIT, 1 / 20),
    ("press_flexible_lubricated", 1e-2, 1 / 20),
)
"""Case, error of the peak acceleration, and the part of the best fixed step's time."""
PEER_RATIOS = {"SciPy Radau": 1.0, "SciPy BDF": 1.0, "SciPy LSODA": 10.0}
PEER_CASE = "slider_crank_dry_0.1mm"
REAL_TIME = ("press_ideal", "press_lubricated", "press_dry")


def goals_of(rows: Sequence[Row], durations: dict[str, float]) -> list[Goal]:
    """Return every goal whose cases were run.

    Args:
        rows: of all cases.
        durations: case -> simulated time, s.
    """
    series, goals = series_of(rows), []
    for case, limit, ratio in AGAINST_FIXED:
        if case in durations:
            ours = cheapest(series.get((case, TOLERANCE), []), PEAK, limit)
            other = cheapest(series.get((case, FIXED), []), PEAK, limit)
            what = f"{case}: peak acceleration within {limit:.1%}, time over the best fixed step's"
            goals.append(_goal(what, ours, other, ratio))
    if PEER_CASE in durations:
        ours = cheapest(series.get((PEER_CASE, TOLERANCE), []), POSITION, POSITION_LIMIT)
        for peer, ratio in PEER_RATIOS.items():
            other = cheapest(series.get((PEER_CASE, peer), []), POSITION, POSITION_LIMIT)
            what = f"{PEER_CASE}: position within 1e-6 m, time over {peer}'s"
            goals.append(_goal(what, ours, other, ratio))
    for case in REAL_TIME:
        if case in durations:
            ours = cheapest(series.get((case, TOLERANCE), []), PEAK, PEAK_LIMIT)
            time, within = durations[case], f"{PEAK_LIMIT:.1%}"
            goals.append(
                Goal(
                    f"{case}: peak acceleration within {within}, run time over simulated time",
                    None if ours is None else ours.cpu_time / time,
                    1.0,
                    _words(ours),
                    f"{time:g} s simulated",
                )
            )
    return goals


def _goal(what: str, ours: Row | None, other: Row | None, at_most: float) -> Goal:
    ratio = None if ours is None or other is None else ours.cpu_time / other.cpu_time
    return Goal(what, ratio, at_most, _words(ours), _words(other))


def _words(row: Row | None) -> str:
    if row is None:
        return "no setting that was run gets there"
    return f"{row.solver} at {row.value:g}: {row.cpu_time:.3g} s"
