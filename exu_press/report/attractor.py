"""The report of a motion in the long run: its revolutions as points, and their figures."""

from pathlib import Path
from typing import Any

from exu_press.page import Live
from exu_press.page.study import Column, study_viewer
from exu_press.plots.words import ONE_LINE, describe
from exu_press.report.html import table
from exu_press.report.study import reading, shown_column, study_page
from exu_press.scene import Scene
from exu_press.studies.sweep.units import shown_unit

__all__ = ["attractor_report"]

HEAD = ("quantity", "unit", "mean", "scatter", "5 %", "50 %", "95 %")


def attractor_report(file: Path) -> str:
    """Return the page of a motion in the long run, from attractor.json."""
    with reading(file, "a motion of exu-press attractor") as told:
        scene = Scene.from_dict(told["scene"], resolve=False)
        found = [["period", str(told["period"]["in_words"])], *_exponent(told)]
        figures = [
            _figure(name, told["units"][name], one) for name, one in told["distributions"].items()
        ]
        live = _live(told)
        length = f"{told['revolutions']} revolutions after {told['skip']}"
        section = f"section at crank angle {told['section_deg']:g} deg"
    return study_page(
        file,
        f"In the long run: {describe([scene], ONE_LINE)}",
        f"{section}, {length}",
        [
            ("Motion", table(("", "value"), found)),
            ("Revolutions", live),
            ("Figures over revolutions", table(HEAD, figures)),
        ],
        "Section, phase portrait, transient, orders, values by revolution.",
        scene=scene,
        drawn="attractor.png",
    )


def _exponent(told: dict[str, Any]) -> list[list[str]]:
    """Return the lines of the largest Lyapunov exponent, and how far points lie apart."""
    one = told["lyapunov_exponent"]
    rows = []
    for name, parts in (
        ("per revolution", ("per_revolution", "low", "high")),
        ("1/s", ("per_second", "low_per_second", "high_per_second")),
    ):
        value, low, high = (one[part] for part in parts)
        if high is None:
            words = "not known of so few revolutions"
        elif low is None:
            words = f"below {high:.4g}"
        else:
            words = f"{value:.4g}, in {low:.4g} to {high:.4g}"
        rows.append([f"largest Lyapunov exponent, {name}", words])
    apart = f"{told['period']['distances'][0]:.3g}, known within {told['period']['error']:.3g}"
    return [
        *rows,
        ["motion", str(one["motion"])],
        ["points 1 revolution apart differ by up to (clearances)", apart],
    ]


def _figure(name: str, unit: str, one: dict[str, Any]) -> list[str]:
    unit, k = shown_unit(name, [one["mean"]["value"]], unit)
    both = [
        f"{k * one[part]['value']:.{digits}g} \N{PLUS-MINUS SIGN} {k * one[part]['error']:.2g}"
        for part, digits in (("mean", 6), ("scatter", 2))
    ]
    shares = [
        f"{k * at['value']:.5g} [{k * at['low']:.5g}, {k * at['high']:.5g}]"
        for at in one["percentiles"].values()
    ]
    return [name, unit, *both, *shares]


def _live(told: dict[str, Any]) -> Live | None:
    """Return every revolution: its point in the section and its figures."""
    points = told["points"]
    numbers = [told["skip"] + 1 + k for k in range(len(points))]
    section = [
        Column(f"section, coordinate {k + 1}", "", [float(point[k]) for point in points])
        for k in range(len(points[0]))
    ]
    figures = [
        shown_column(name, each, other=told["units"][name])
        for name, each in told["figures"].items()
    ]
    first = (section[0].name, section[1 % len(section)].name)
    return study_viewer(
        [Column("revolution", "", numbers)],
        [*section, *figures],
        [f"revolution {number}" for number in numbers],
        first,
        "revolution",
    )
