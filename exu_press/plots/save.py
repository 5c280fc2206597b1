"""All pictures of a run or a comparison, as PNG files."""

from collections.abc import Mapping
from pathlib import Path

from matplotlib.figure import Figure

from exu_press.plots.energy import energy_figure
from exu_press.plots.file import save_figures
from exu_press.plots.force import force_figure
from exu_press.plots.orbit import orbit_figure
from exu_press.plots.press import press_figure
from exu_press.plots.slider import slider_figure
from exu_press.quantities.energy import has_balance
from exu_press.result import Result
from exu_press.scene.provenance import Provenance

__all__ = ["comparison_figures", "save_comparison", "save_pictures", "sources_of"]


def save_pictures(result: Result, directory: str | Path) -> list[Path]:
    """Draw everything about one run; return the files: slider, orbit, force, press, energy .png.

    There is no orbit.png of a scene without clearance joints, and no energy.png where the user's
    own items leave no balance. `directory` must exist.

    Raises:
        InputError: a file cannot be written.
    """
    run = {"simulated": result}
    figures = {"slider": slider_figure(run)}
    if result.clearance_joints:
        figures["orbit"] = orbit_figure(result)
    figures["force"] = force_figure(run)
    figures["press"] = press_figure(result)
    if has_balance(result):
        figures["energy"] = energy_figure(result)
    return save_figures(figures, directory, sources_of(run))


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
