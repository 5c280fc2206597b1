"""What pictures cost: each default picture over an empty one, and a run with them over a bare run.

An empty picture has the size of the picture and as many axes in the same places (panels, colour
bars, insets), without limits and data; it is laid out and saved by the same functions.
"axes" has nothing else, "with text" also heading, titles and names of axes. They are drawn in turn,
and the least processor time of each counts. Commands are fresh processes; the least times count.
"""

import argparse
import os
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from functools import partial
from pathlib import Path
from typing import Any

from matplotlib.cm import ScalarMappable
from matplotlib.figure import Figure
from matplotlib.text import Annotation

from exu_press import Result
from exu_press.plots import force_figure, orbit_figure, slider_figure
from exu_press.plots.file import save_figure
from exu_press.plots.panels import lowest_panels
from exu_press.plots.style import with_style

RUNS = {"run press": (), "run press, dry": ("--set", "joints.crank_pin=dry")}
"""Label of a command -> its options."""

INSET = (0.7, 0.7, 0.27, 0.27)


@with_style
def empty_figure(picture: Figure, *, with_text: bool) -> Figure:
    """Return a figure with the axes of a picture in their places, and nothing in them."""
    figure = Figure(figsize=tuple(picture.get_size_inches()), layout="constrained")
    panels: list[Any] = [axes for axes in picture.axes if axes.get_subplotspec() is not None]
    grid = panels[0].get_subplotspec().get_gridspec()
    ratios = {"height_ratios": grid.get_height_ratios(), "width_ratios": grid.get_width_ratios()}
    places = figure.add_gridspec(grid.nrows, grid.ncols, **ratios)
    shares = panels[0].get_shared_x_axes().joined(panels[0], panels[-1])
    drawn: list[Any] = []
    for axes in panels:
        spec = axes.get_subplotspec()
        cells = places[
            spec.rowspan.start : spec.rowspan.stop, spec.colspan.start : spec.colspan.stop
        ]
        panel = figure.add_subplot(cells, sharex=drawn[0] if shares and drawn else None)
        for _ in axes.child_axes:
            panel.inset_axes(INSET).set(xticks=[], yticks=[])
        if with_text:
            panel.set(title=axes.get_title("left"))
            panel.set(xlabel=axes.get_xlabel(), ylabel=axes.get_ylabel())
            panel.set_title(axes.get_title("right"), loc="right")
        drawn.append(panel)
    for panel in set(drawn).difference(lowest_panels(drawn)) if shares else ():
        panel.tick_params(labelbottom=False)
    for panel in drawn[: len(picture.axes) - len(panels)]:
        figure.colorbar(ScalarMappable(), ax=panel, location="left")
    if with_text:
        figure.suptitle(picture.get_suptitle())
        for heading in (text for text in picture.artists if isinstance(text, Annotation)):
            figure.text(0.0, 1.0, heading.get_text()).set_in_layout(False)
    return figure


def least_times(draws: dict[str, Callable[[], Figure]], repeats: int) -> dict[str, float]:
    """Return the least processor time of drawing and saving each figure, s, drawn in turn."""
    least = dict.fromkeys(draws, float("inf"))
    with tempfile.TemporaryDirectory() as folder:
        for _ in range(repeats):
            for name, draw in draws.items():
                start = time.process_time()
                save_figure(draw(), Path(folder) / "picture.png")
                least[name] = min(least[name], time.process_time() - start)
    return least


def default_pictures(folder: Path) -> Iterator[tuple[str, str, Callable[[], Figure]]]:
    """Run the commands; yield command, name of the picture, and what draws it."""
    for label, options in RUNS.items():
        execute("run", "press", *options, "--no-pictures", "--out", str(folder / label))
        result = Result.load(folder / label / "run.nc")
        yield label, "slider", partial(slider_figure, {"simulated": result})
        yield label, "orbit", partial(orbit_figure, result)
        yield label, "force", partial(force_figure, {"simulated": result})
    execute("compare", "press", "--no-pictures", "--out", str(folder / "compare"))
    files = sorted((folder / "compare").glob("*/run.nc"))
    runs = {file.parent.name: Result.load(file) for file in files}
    yield "compare press", "slider", partial(slider_figure, runs)
    yield "compare press", "force", partial(force_figure, runs)


def execute(*command: str) -> tuple[float, float]:
    """Execute exu-press; return the processor time of all its processes and the time, s."""
    before, start = os.times(), time.perf_counter()
    program = [sys.executable, "-m", "exu_press", *command, "--quiet"]
    subprocess.run(program, check=True, stdout=subprocess.DEVNULL)
    after, stop = os.times(), time.perf_counter()
    user, system = after[2] - before[2], after[3] - before[3]
    return user + system, stop - start


def command_times(folder: Path, repeats: int) -> dict[str, list[float]]:
    """Return the least processor time and time of a bare run, one with pictures, and a report."""
    out = str(folder / "run")
    commands = {
        "bare run with errors": ("run", "press", "--no-pictures", "--out", out),
        "with pictures": ("run", "press", "--out", out),
        "report": ("report", out),
    }
    times: dict[str, list[tuple[float, float]]] = {name: [] for name in commands}
    for _ in range(repeats):
        for name, command in commands.items():
            times[name].append(execute(*command))
    return {
        name: [min(column) for column in zip(*rows, strict=True)] for name, rows in times.items()
    }


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--repeats", type=int, default=5, help="of everything (default: 5)")
    repeats = parser.parse_args().repeats
    with tempfile.TemporaryDirectory() as name:
        times = command_times(Path(name), repeats)
        bare = times["bare run with errors"]
        times["pictures and report"] = [
            sum(pair) for pair in zip(times["with pictures"], times["report"], strict=True)
        ]
        print(f"{'':22}  processor time, s  over bare  time, s  over bare")
        for label, (processor, wall) in times.items():
            row = f"{label:22}  {processor:17.2f}  {processor / bare[0]:9.2f}"
            print(f"{row}  {wall:7.2f}  {wall / bare[1]:9.2f}")
        print(f"\n{'command':15} picture  time, s  over axes  over axes with text")
        for command, picture, draw in default_pictures(Path(name)):
            drawn = draw()
            empties = {text: partial(empty_figure, drawn, with_text=text) for text in (False, True)}
            least = least_times(
                {"picture": draw, "axes": empties[False], "text": empties[True]}, repeats
            )
            ratios = (
                f"{least['picture'] / least['axes']:9.2f}  {least['picture'] / least['text']:.2f}"
            )
            print(f"{command:15} {picture:7}  {least['picture']:7.3f}  {ratios}", flush=True)


if __name__ == "__main__":
    main()
