"""All pictures of the study as files."""

from collections.abc import Iterator, Sequence
from pathlib import Path

from matplotlib.figure import Figure

from exu_press.output import output_directory
from exu_press.plots.save import save_figure
from paper.damping import directory_of
from paper.plots.motion import LOOKS, motion_figure
from paper.plots.numbers import numbers_figure
from paper.plots.paths import paths_figure
from paper.plots.revolution import last_revolution
from paper.plots.side_by_side import side_by_side_figure
from paper.plots.sweeps import curves_figure, peaks_figure
from paper.plots.tornado import tornado_figure
from paper.plots.tradeoff import tradeoff_figure
from paper.published import Trend, published
from paper.report import Findings, Report
from paper.rows import Row
from paper.runs import ELASTIC, LOADS, run_name

__all__ = ["save_paper"]

Drawn = Iterator[tuple[str, Figure]]

MOTIONS = {"Fig. 14": "displacement", "Fig. 15": "velocity", "Fig. 16": "acceleration"}
SWEPT = {"bottom_dead_centre": "displacement", "peak_velocity": "velocity"}


def save_paper(report: Report, directory: str | Path) -> list[Path]:
    """Draw what can be drawn of a report; return the files, PNG, those of a reading together.

    Runs that stopped early are left out, and figures that need them.

    Raises:
        InputError: a file cannot be written, or a run's result cannot be read.
    """
    beside = Path(directory) / "side_by_side.png"
    written = [save_figure(side_by_side_figure(list(report.findings.values())), beside)]
    for damping, found in report.findings.items():
        place = output_directory(directory_of(Path(directory), damping))
        rows = (*found.rows, *report.frequencies)
        for drawn in (_numbers(found, rows), _motions(found), _paths(found), _sweeps(found)):
            written += [save_figure(figure, place / f"{name}.png") for name, figure in drawn]
    return written


def _numbers(found: Findings, rows: Sequence[Row]) -> Drawn:
    """Yield what the numbers come to: the table, what moves it, and the clearance."""
    yield "numbers", numbers_figure(rows)
    groups = {
        ("tornado_acceleration", "rigid"): "What moves the peak accelerations, rigid bodies",
        ("tornado_other", "rigid"): "What moves dead centres and peak velocities, rigid bodies",
        ("tornado_flexible", "flexible"): "What moves the peak accelerations, flexible bodies",
    }
    for (name, bodies), title in groups.items():
        some = [
            tornado
            for tornado in found.tornados
            if tornado.bodies == bodies
            and not tornado.number.reference  # the same bars as the number computed beside it
            and (tornado.number.measure == "peak_acceleration") == (name != "tornado_other")
        ]
        if some:
            yield name, tornado_figure(title, some)
    if found.choice.alike:
        yield "clearance", tradeoff_figure(found.choice)


def _motions(found: Findings) -> Drawn:
    """Yield Figs. 14-16."""
    names = {
        load: {
            joints: run_name(load, joints, "rigid" if joints == "ideal" else found.bodies)
            for joints in LOOKS
        }
        for load in LOADS
    }
    if found.has(*(name for some in names.values() for name in some.values())):
        loads = {
            load: {joints: last_revolution(found.result(name)) for joints, name in some.items()}
            for load, some in names.items()
        }
        for figure, kind in MOTIONS.items():
            yield _file(figure, kind), motion_figure(figure, kind, loads)


def _paths(found: Findings) -> Drawn:
    """Yield Figs. 17 and 18, the second one with elastic guides, where a ball moves sideways."""
    for figure, joint, guides in (("Fig. 17", "crank_pin", ""), ("Fig. 18", "ball_left", ELASTIC)):
        names = {
            f"{load}, {joints}": run_name(load, joints, found.bodies) + guides
            for load in LOADS
            for joints in ("lubricated", "dry")
        }
        if found.has(*names.values()):
            runs = {label: last_revolution(found.result(name)) for label, name in names.items()}
            readings = {label: found.runs[name] for label, name in names.items()}
            yield _file(figure, "path"), paths_figure(figure, joint, runs, readings)


def _sweeps(found: Findings) -> Drawn:
    """Yield Figs. 19-27."""
    for trend in published().beside(found.bodies).trends:
        if not trend.figure.startswith("Fig.") or trend.measure == "oscillation_frequency":
            continue
        if len(trend.runs) == 4 and found.has(*trend.runs):
            yield _sweep(found, trend)


def _sweep(found: Findings, trend: Trend) -> tuple[str, Figure]:
    """Return name and figure of one of Figs. 19-27."""
    runs = {name: last_revolution(found.result(name)) for name in trend.runs}
    if trend.measure in SWEPT:
        kind = SWEPT[trend.measure]
        figure = curves_figure(trend.figure, kind, runs, found.runs, trend.stated)
    else:
        kind = "acceleration"
        figure = peaks_figure(trend.figure, runs, found.runs, trend.stated)
    return _file(trend.figure, kind), figure


def _file(figure: str, kind: str) -> str:
    """Return a file's name.

    >>> _file("Fig. 14", "displacement")
    'fig14_displacement'
    """
    return f"fig{figure.removeprefix('Fig. ')}_{kind}"
