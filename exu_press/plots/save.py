"""The pictures of a run or a comparison, as files."""

import shutil
from collections.abc import Mapping
from functools import partial
from pathlib import Path

from matplotlib.figure import Figure

from exu_press.files.output_directory import replacing
from exu_press.plots.file import draw_figures, read_sources, save_figures
from exu_press.plots.force import force_figure
from exu_press.plots.format import picture_format
from exu_press.plots.orbit import MOST_JOINTS, orbit_figure
from exu_press.plots.slider import slider_figure
from exu_press.quantities.energy import has_balance
from exu_press.result import Result
from exu_press.scene.provenance import Provenance

__all__ = [
    "comparison_figures",
    "drawn_pictures",
    "save_comparison",
    "save_early_pictures",
    "save_pictures",
    "sources_of",
]

RUN = "simulated"
"""Label of a run that is drawn alone."""


def save_pictures(result: Result, directory: str | Path, early: Path | None = None) -> list[Path]:
    """Draw slider, orbit and force of one run, with errors of their peaks; return the files.

    Where the picture format asks for everything, press and energy too. There is no orbit of a scene
    without clearance joints, and no energy where the user's own items leave no balance.
    `directory` must exist.

    Args:
        result: of the run.
        directory: of the files.
        early: folder with those that `save_early_pictures` has drawn, which are copied; or None.

    Raises:
        InputError: a file cannot be written.
    """
    run = {RUN: result}
    draws = {"slider": partial(slider_figure, run)}
    if result.clearance_joints:
        draws["orbit"] = partial(orbit_figure, result)
    draws["force"] = partial(force_figure, run)
    if picture_format().everything:
        from exu_press.plots.energy import energy_figure
        from exu_press.plots.press import press_figure

        draws["press"] = partial(press_figure, result)
        if has_balance(result):
            draws["energy"] = partial(energy_figure, result)
    order = [*draws]
    there = [path for path in early.iterdir() if path.stem in draws] if early is not None else []
    for path in there:
        del draws[path.stem]
    files = [_copy(path, Path(directory)) for path in there]
    files += draw_figures(draws, directory, sources_of(run))
    return sorted(files, key=lambda file: order.index(file.stem))


def save_early_pictures(result: Result, folder: Path) -> list[Path]:
    """Draw what the errors of a run do not change: orbits without a table below; return the files.

    Raises:
        InputError: a file cannot be written.
    """
    if not 0 < len(result.clearance_joints) <= MOST_JOINTS:
        return []
    draws = {"orbit": partial(orbit_figure, result)}
    return draw_figures(draws, folder, sources_of({RUN: result}))


def _copy(file: Path, directory: Path) -> Path:
    """Copy a file into a directory and return it there."""
    with replacing(directory / file.name) as unfinished:
        shutil.copyfile(file, unfinished)
    return directory / file.name


def drawn_pictures(result: Result, directory: Path) -> list[Path]:
    """Return the PNG files of `save_pictures` in a directory, if all are there and of this run."""
    names = ["slider", *(["orbit"] if result.clearance_joints else []), "force"]
    files = [directory / f"{name}.png" for name in names]
    sources = sources_of({RUN: result})
    return files if sources and all(read_sources(file) == sources for file in files) else []


def comparison_figures(results: Mapping[str, Result]) -> dict[str, Figure]:
    """Return the pictures of runs by label over each other, by their names.

    Raises:
        InputError: the file of a run does not keep the channels that they show.
    """
    return {"compare_slider": slider_figure(results), "compare_force": force_figure(results)}


def save_comparison(results: Mapping[str, Result], directory: str | Path) -> list[Path]:
    """Draw runs by label over each other; return compare_slider.png and compare_force.png.

    Raises:
        InputError: a file cannot be written.
    """
    return save_figures(comparison_figures(results), directory, sources_of(results))


def sources_of(results: Mapping[str, Result]) -> dict[str, Provenance]:
    """Return the provenance of runs by label; files of older versions have none."""
    infos = {label: result.info for label, result in results.items()}
    return {label: info["provenance"] for label, info in infos.items() if "provenance" in info}
