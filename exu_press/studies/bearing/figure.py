"""A bearing's picture: pressure around it, the journal's locus, stiffness and damping."""

import math

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from exu_press.errors import InputError
from exu_press.laws.film.contract import film_scale
from exu_press.laws.film.grooved_table import CELLS, GroovedFilm
from exu_press.laws.film.grooves import GroovedFilmState
from exu_press.laws.film.reynolds import solve_reynolds
from exu_press.laws.film.tilted import TiltedFilm
from exu_press.numerics.arrays import Array
from exu_press.plots.legends import legend_above
from exu_press.plots.palette import COLOURS, GREY, colour_of
from exu_press.plots.panels import figure_with_panels, grid_rows
from exu_press.plots.style import with_style
from exu_press.studies.bearing.coefficients import (
    BearingCoefficients,
    bearing_coefficients,
    journal_joint,
)
from exu_press.studies.bearing.report import AXES, BearingReport

__all__ = ["bearing_figure"]

MOST_CURVES = 6
"""Of the pressure."""

STYLES = ("-", "--", "-.", ":")
"""Of lines of several speeds."""

BELOW, ABOVE = 3.0, 1.2
"""Widths of the lines of xx and xy, and of yx and yy: xy is seen below an equal yx."""

LOCUS = np.geomspace(0.02, 50.0, 25)
"""Loads of the locus over the first row's."""


@with_style
def bearing_figure(report: BearingReport) -> Figure:
    """Return four panels; the locus is that of the first speed."""
    title = f"Bearing {report.study.joint.replace('_', ' ')}"
    figure, panels = figure_with_panels(title, report.subtitle, grid_rows(4, 4), 4.0, 3.4)
    pressure, locus, stiffness, damping = panels
    _pressure(pressure, report)
    _locus(locus, report)
    _matrix(stiffness, report, "stiffness", "N/m")
    _matrix(damping, report, "damping", "N s/m")
    return figure


def _pressure(panel: Axes, report: BearingReport) -> None:
    for k, row in enumerate(report.rows[:MOST_CURVES]):
        angle, pressure = _largest_pressure(report, row)
        label = f"{math.hypot(*row.load):g} N, {row.speed_rpm:g} rpm"
        panel.plot(angle, 1e-6 * pressure, color=colour_of(k), label=label)
    panel.set_title("largest pressure over the length")
    panel.set(xlabel="angle from the x axis, deg", ylabel="MPa", xlim=(-180.0, 180.0))
    panel.set_xticks([-180, -90, 0, 90, 180])
    panel.legend(loc="best")


def _largest_pressure(report: BearingReport, row: BearingCoefficients) -> tuple[Array, Array]:
    """Return angles in the drawing, deg, and the largest pressure over the length there, Pa."""
    kind, sizes = journal_joint(report.study.scene, row.joint)
    length, radius = sizes.length, kind.radius
    eps, turning = min(row.eccentricity_ratio, 0.999), row.speed_rpm * math.tau / 60.0
    direction = math.atan2(row.eccentricity[1], row.eccentricity[0])
    law = kind.film_law()
    scale = film_scale(row.viscosity, length, radius, kind.clearance) / (length * radius)
    if isinstance(law, TiltedFilm):
        law.spin = turning
        theta, pressure = law.largest_pressure(eps, direction, 0.0, 0.5 * eps * turning)
        theta -= direction
    elif isinstance(law, GroovedFilm):
        state = GroovedFilmState(law.bearing, eps, direction, CELLS)
        theta, pressure = state.largest_pressure(
            0.0, 0.5 * eps * turning, sizes.law.supply_pressure / (12.0 * scale)
        )
    else:
        film = solve_reynolds(eps, 0.0, eps * turning, length / (2.0 * radius), math.pi)
        theta, pressure = film.theta, film.p.max(axis=1)
    degrees = np.degrees(np.remainder(theta + direction + math.pi, math.tau) - math.pi)
    order = np.argsort(degrees)
    return degrees[order], 12.0 * scale * pressure[order]


def _locus(panel: Axes, report: BearingReport) -> None:
    """Draw the journal's centre over the loads that it bears, in the circle of its clearance."""
    first = report.rows[0]
    clearance = journal_joint(report.study.scene, first.joint)[0].clearance
    path = []
    for share in LOCUS.tolist():
        load = share * first.load[0], share * first.load[1]
        try:
            bearing = bearing_coefficients(
                report.study.scene, first.joint, load=load, speed_rpm=first.speed_rpm
            )
        except InputError:
            if share > 1.0:
                break
        else:
            path.append(bearing.eccentricity)
    panel.plot(*np.reshape(path, (-1, 2)).T / clearance, color=colour_of(0))
    for row in report.rows:
        panel.plot(*(e / clearance for e in row.eccentricity), "o", color=COLOURS["vermilion"])
    turn = np.linspace(0.0, math.tau, 181)
    panel.plot(np.cos(turn), np.sin(turn), color=GREY)
    panel.set_title(f"journal's centre / clearance,\nline: {first.speed_rpm:g} rpm")
    panel.set(xlabel="x", ylabel="y", aspect="equal")
    panel.margins(0.05)


def _matrix(panel: Axes, report: BearingReport, name: str, unit: str) -> None:
    """Draw the entries of a matrix over the load, a line style for each speed; else over speed."""
    loads = np.array([math.hypot(*row.load) for row in report.rows])
    speeds = np.array([row.speed_rpm for row in report.rows])
    over_load = len(set(loads)) > 1 or len(report.rows) == 1
    across = loads if over_load else speeds
    entries = np.array([getattr(row, name).ravel() for row in report.rows])
    prefix, scale = ("M", 1e-6) if np.abs(entries).max() > 1e6 else ("k", 1e-3)
    unit = prefix + unit
    several = over_load and len(set(speeds)) > 1
    for index, speed in enumerate(sorted(set(speeds)) if several else [None]):
        rows = np.flatnonzero(speeds == speed) if several else np.arange(len(speeds))
        order = rows[np.argsort(across[rows])]
        style = STYLES[index % len(STYLES)]
        for k, axes in enumerate(AXES):
            (line,) = panel.plot(across[order], scale * entries[order, k], "o", ms=3)
            line.set(color=colour_of(k), linestyle=style, label="_" if index else axes)
            line.set_linewidth(BELOW if k < 2 else ABOVE)
        if several:
            panel.plot([], [], color=GREY, linestyle=style, label=f"{speed:g} rpm")
    panel.set_title(name)
    panel.set(xlabel="load, N" if over_load else "speed, rpm", ylabel=unit)
    panel.margins(0.05)
    legend_above(panel)
