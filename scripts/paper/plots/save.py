"""All pictures of the study as files."""

from collections.abc import Iterator
from pathlib import Path

from matplotlib.figure import Figure

from exu_press.plots.save import save_figure
from paper.plots.motion import LOOKS, motion_figure
from paper.plots.numbers import numbers_figure
from paper.plots.paths import paths_figure
from paper.plots.revolution import last_revolution
from paper.plots.sweeps import curves_figure, peaks_figure
from paper.plots.tornado import tornado_figure
from paper.plots.tradeoff import tradeoff_figure
from paper.published import Trend, published
from paper.report import Report
from paper.runs import ELASTIC, LOADS, run_name

__all__ = ["save_paper"]

Drawn = Iterator[tuple[str, Figure]]

MOTIONS = {"Fig. 14": "displacement", "Fig. 15": "velocity", "Fig. 16": "acceleration"}
SWEPT = {"low_dead_point": "displacement", "peak_velocity": "velocity"}


def save_paper(report: Report, directory: str | Path) -> list[Path]:
    """Draw what can be drawn of a report; return the files, PNG.

    Runs that stopped early are left out, and figures that need them.

    Raises:
        InputError: a file cannot be written, or a run's result cannot be read.
    """
    return [
        save_figure(figure, Path(directory) / f"{name}.png")
        for drawn in (_numbers(report), _motions(report), _paths(report), _sweeps(report))
        for name, figure in drawn
    ]


def _numbers(report: Report) -> Drawn:
    """Yield what the numbers come to: the table, what moves it, and the clearance."""
    yield "numbers", numbers_figure(report.rows)
    groups = {
        ("tornado_acceleration", "rigid"): "What moves the peak accelerations, rigid bodies",
        ("tornado_other", "rigid"): "What moves low dead points and peak velocities, rigid bodies",
        ("tornado_flexible", "flexible"): "What moves the peak accelerations, flexible bodies",
    }
    for (name, bodies), title in groups.items():
        some = [
            tornado
            for tornado in report.tornados
            if tornado.bodies == bodies
            and not tornado.number.reference  # the same bars as the number computed beside it
            and (tornado.number.measure == "peak_acceleration") == (name != "tornado_other")
        ]
        if some:
            yield name, tornado_figure(title, some)
    if report.choice.alike:
        yield "clearance", tradeoff_figure(report.choice)


def _motions(report: Report) -> Drawn:
    """Yield Figs. 14-16."""
    names = {
        load: {
            joints: run_name(load, joints, "rigid" if joints == "ideal" else report.bodies)
            for joints in LOOKS
        }
        for load in LOADS
    }
    if report.has(*(name for some in names.values() for name in some.values())):
        loads = {
            load: {joints: last_revolution(report.result(name)) for joints, name in some.items()}
            for load, some in names.items()
        }
        for figure, kind in MOTIONS.items():
            yield _file(figure, kind), motion_figure(figure, kind, loads)


def _paths(report: Report) -> Drawn:
    """Yield Figs. 17 and 18, the second one with elastic guides, where a ball moves sideways."""
    for figure, joint, guides in (("Fig. 17", "crank_pin", ""), ("Fig. 18", "ball_left", ELASTIC)):
        names = {
            f"{load}, {joints}": run_name(load, joints, report.bodies) + guides
            for load in LOADS
            for joints in ("lubricated", "dry")
        }
        if report.has(*names.values()):
            runs = {label: last_revolution(report.result(name)) for label, name in names.items()}
            readings = {label: report.runs[name] for label, name in names.items()}
            yield _file(figure, "path"), paths_figure(figure, joint, runs, readings)


def _sweeps(report: Report) -> Drawn:
    """Yield Figs. 19-27."""
    for trend in published().beside(report.bodies).trends:
        if len(trend.runs) < 4 or trend.measure == "oscillation_frequency":
            continue
        if report.has(*trend.runs):
            yield _sweep(report, trend)


def _sweep(report: Report, trend: Trend) -> tuple[str, Figure]:
    """Return name and figure of one of Figs. 19-27."""
    runs = {name: last_revolution(report.result(name)) for name in trend.runs}
    if trend.measure in SWEPT:
        kind = SWEPT[trend.measure]
        figure = curves_figure(trend.figure, kind, runs, report.runs, trend.stated)
    else:
        kind = "acceleration"
        figure = peaks_figure(trend.figure, runs, report.runs, trend.stated)
    return _file(trend.figure, kind), figure


def _file(figure: str, kind: str) -> str:
    """Return a file's name.

    >>> _file("Fig. 14", "displacement")
    'fig14_displacement'
    """
    return f"fig{figure.removeprefix('Fig. ')}_{kind}"
