"""Section 5 inverted, as a person reads it in a terminal."""

import math

from exu_press.terminal.columns import columns
from paper.inverse import FREE, Inverse, Trial, distance
from paper.open_keys import OPEN, OURS, in_words

__all__ = ["inverse_lines", "inverse_rows"]

AGREES = 1.25
"""Ratio either way up to which a number agrees, as in the tables of section 5."""


def inverse_rows(report: Inverse) -> list[list[str]]:
    """Return for each number of section 5 whether it agrees, and under which reading."""
    rows = [["number of section 5", "paper", "ours", "recommended", "nearest", "verdict"]]
    for place, number in enumerate(report.numbers):
        nearest = report.nearest(place)
        ratio = _ratio(nearest, place)
        if _agrees(_ratio(report.ours, place)):
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
                    for one in (report.ours, report.recommended, nearest)
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
        f"{report.runs} runs with those that differ from the best reading in one key",
        *(f"  {n} x {why}" for why, n in report.failures.most_common(3)),
        "",
        *columns(_distances(report)),
        "",
        "ratios, ours over the paper's",
        *columns(inverse_rows(report)),
        "",
        "recommended reading, and by how much the distance grows with one key elsewhere",
        *columns(_preferences(report)),
    ]
    free = ", ".join(report.free) or "nothing"
    return [*lines, f"the numbers cannot tell (distance changes by less than {FREE:g}): {free}"]


def _distances(report: Inverse) -> list[list[str]]:
    rows = [["root mean square of log ratios", "all, each capped at ln 4", "peaks", "within 25 %"]]
    peaks = [n for n, number in enumerate(report.numbers) if "acceleration" in number.measure]
    for name, one in (
        ("our reading, rigid", report.ours),
        ("best reading found, rigid", report.best),
        ("recommended reading, rigid", report.recommended),
        ("recommended reading, flexible", report.flexible),
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


def _preferences(report: Inverse) -> list[list[str]]:
    rows = [["open", "ours", "recommended", "distance grows by"]]
    for name in OPEN:
        told = [
            f"{in_words(one.reading[name])}: "
            + (f"{one.distance - report.base.distance:+.3f}" if one.ratios else "fails")
            for one in report.alone.get(name, [])
        ]
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
    """Return the two choices of a reading that matter most to a reader: observation and damping."""
    return ", ".join(f"{n} {in_words(one.reading[n])}" for n in ("observation", "damping"))
