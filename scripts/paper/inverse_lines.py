"""Section 5 inverted, as a person reads it in a terminal."""

import math

from exu_press.terminal.columns import columns
from paper.inverse import FREE, OBSERVED, Inverse, Trial, distance
from paper.open_keys import OPEN, OURS, in_words

__all__ = ["inverse_lines", "inverse_rows"]

AGREES = 1.25
"""Ratio either way up to which a number agrees, as in the tables of section 5."""


def inverse_rows(report: Inverse) -> list[list[str]]:
    """Return for each number of section 5 whether it agrees, and under which reading."""
    head = ["number of section 5", "paper", "ours", "recommended", "nearest", "verdict"]
    rows = [head]
    for place, number in enumerate(report.numbers):
        nearest = report.nearest(place)
        ratio = _ratio(nearest, place)
        if _agrees(_ratio(report.ours_flexible, place)):
            verdict = "agrees"
        elif _agrees(_ratio(report.recommended, place)):
            verdict = "agrees with the recommended reading"
        elif _agrees(ratio):
            verdict = f"agrees with another reading: {_difference(nearest)}"
        else:
            verdict = "no reading reaches it"
        rows.append(
            [
                f"{number.figure}: {number.quantity}",
                f"{number.published:g}",
                *(
                    f"{_ratio(one, place):.2f}"
                    for one in (report.ours_flexible, report.recommended, nearest)
                ),
                verdict,
            ]
        )
    return rows


def inverse_lines(report: Inverse) -> list[str]:
    """Return how much any reading explains, what the numbers prefer and what they cannot tell."""
    tried = [one for one in report.trials if one.ratios is not None]
    lines = [
        f"{len(report.trials)} readings, {len(tried)} with numbers; "
        f"{report.runs} runs with those that differ from the best one in one key",
        f"{report.repeated} runs were repeated with a smaller tolerance, for their impacts",
        *(f"  {n} x {why}" for why, n in report.failures.most_common(3)),
        "",
        *columns(_distances(report)),
        "",
        "ratios with flexible bodies, ours over the paper's; nearest of all runs",
        *columns(inverse_rows(report)),
        "",
        "flexible bodies, from the best rigid reading on, one key elsewhere",
        *columns(_flexible(report)),
        "",
        "recommended reading, and what one key elsewhere adds to the distance of rigid bodies",
        *columns(_preferences(report)),
    ]
    if not report.alone:
        return lines
    free = ", ".join(report.free) or "nothing"
    return [*lines, f"the numbers cannot tell (distance changes by less than {FREE:g}): {free}"]


def _distances(report: Inverse) -> list[list[str]]:
    rows = [["root mean square of log ratios", "all, each capped at ln 4", "peaks", "within 25 %"]]
    peaks = [n for n, number in enumerate(report.numbers) if "acceleration" in number.measure]
    for name, one in (
        ("our reading, rigid", report.ours),
        ("best reading found, rigid", report.best),
        ("where the flexible search starts, rigid", report.from_rigid),
        ("our reading, flexible", report.ours_flexible),
        ("recommended reading, flexible", report.recommended),
    ):
        if one.ratios is None:
            rows.append([name, "a run failed", "", ""])
            continue
        of_peaks = distance([one.ratios[n] for n in peaks])
        agree = sum(map(_agrees, one.ratios))
        rows.append(
            [name, f"{one.distance:.3f}", f"{of_peaks:.3f}", f"{agree} of {len(one.ratios)}"]
        )
    return rows


def _flexible(report: Inverse) -> list[list[str]]:
    rows = [["elsewhere", "distance"]]
    for one in report.flexible:
        told = [
            f"{name}: {in_words(value)}"
            for name, value in one.reading.items()
            if value != report.from_rigid.reading[name] and name != OBSERVED
        ]
        rows.append(
            [", ".join(told) or "nothing", f"{one.distance:.3f}" if one.ratios else "a run failed"]
        )
    return rows


def _preferences(report: Inverse) -> list[list[str]]:
    rows = [["open", "ours", "recommended", "adds"]]
    for name in OPEN:
        told = [
            f"{in_words(one.reading[name])}: "
            + (f"{one.distance - report.base.distance:+.3f}" if one.ratios else "fails")
            for one in report.alone.get(name, [])
        ]
        if not (told or report.recommended.reading[name] != OURS[name]):
            continue
        rows.append(
            [
                name,
                in_words(OURS[name]),
                in_words(report.recommended.reading[name]),
                ", ".join(told),
            ]
        )
    return rows


def _ratio(one: Trial, place: int) -> float:
    return math.nan if one.ratios is None else one.ratios[place]


def _agrees(ratio: float) -> bool:
    return 1.0 / AGREES <= ratio <= AGREES


def _difference(one: Trial) -> str:
    """Return what matters most to a reader of a trial: bodies, observation and damping."""
    told = [f"{n} {in_words(one.reading[n])}" for n in ("observation", "damping")]
    return ", ".join([f"{one.bodies} bodies", *told])
