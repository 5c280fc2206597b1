"""Pictures of mode shapes, like the paper's Figs. 8 and 9. Matplotlib without a display."""

from pathlib import Path
from typing import Any

import matplotlib
import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.collections import PolyCollection
from matplotlib.figure import Figure
from numpy.typing import NDArray

from fe_models.arrays import Array
from fe_models.clamped import MODE_NUMBERS, clamped_modes
from fe_models.part import Part
from fe_models.solid_view import facing, turned_view

__all__ = ["draw_mode_shapes"]

DEFLECTION = 0.07  # of the part's largest extent, at the mode's largest displacement
TURN, TILT = np.radians(-35.0), np.radians(22.0)  # of the view, about y and then about x
PLAIN = (0.64, 0.70, 0.76)


def draw_mode_shapes(solid: Part, file: Path, modes: tuple[int, ...] = MODE_NUMBERS) -> None:
    """Write a picture (.png): the undeformed part and modes clamped at the bearings, by number.

    Colour is the size of the displacement relative to the mode's largest.

    Args:
        solid: is meshed here.
        file: to write.
        modes: numbers, from 1.

    Raises:
        InputError: the solid cannot be meshed, or has no bearing to clamp.
    """
    frequencies, shapes, model = clamped_modes(solid, max(modes))
    long_part = np.ptp(model.nodes[:, 2]) > 2.0 * np.ptp(model.nodes[:, :2], axis=0).max()
    view = _view(long_part)
    columns = 2 if long_part else 3
    rows = -(-(len(modes) + 1) // columns)
    height = 2.0 if long_part else 2.9
    figure = Figure(figsize=(12.0, height * rows + 0.4), dpi=110, layout="constrained")
    FigureCanvasAgg(figure)
    grid = figure.subplots(rows, columns, squeeze=False, sharex=True, sharey=True)
    for axes, mode in zip(grid.flat, (0, *modes), strict=False):
        moved, level = model.nodes, None
        title = f"{solid.name}, undeformed"
        if mode:
            displacement = shapes[:, mode - 1].reshape(-1, 3)
            size = np.linalg.norm(displacement, axis=1)
            extent = float(np.ptp(model.nodes, axis=0).max())
            moved = model.nodes + DEFLECTION * extent / size.max() * displacement
            level = size / size.max()
            title = f"mode {mode}: {frequencies[mode - 1]:.0f} Hz"
        axes.add_collection(_surface(moved @ view.T, model.triangles, level))
        axes.set_title(title, fontsize=11)
    for axes in grid.flat:
        axes.set_aspect("equal")
        axes.set_axis_off()
        axes.autoscale_view()
    scale = matplotlib.cm.ScalarMappable(cmap="turbo")
    figure.colorbar(
        scale, ax=grid.ravel().tolist(), shrink=0.6, label="displacement / mode's largest"
    )
    figure.savefig(file)


def _view(long_part: bool) -> Array:
    """Return the rows right, up, towards the eye: y up, the long axis (z or x) to the right."""
    frame = np.array([[0, 0, 1], [0, 1, 0], [-1, 0, 0]]) if long_part else np.eye(3)
    return np.asarray(turned_view(0.5 * TURN if long_part else TURN, TILT) @ frame)


def _surface(points: Array, triangles: NDArray[np.int64], level: Array | None) -> Any:
    """Return the triangles that face the eye, far ones first, coloured by level and shaded."""
    corners, seen, light = facing(points, triangles)
    shade = 0.45 + 0.55 * light
    if level is None:
        colour = np.tile(PLAIN, (len(seen), 1))
    else:
        colour = matplotlib.colormaps["turbo"](level[seen].mean(axis=1))[:, :3]
    shaded = np.clip(colour * shade[:, None], 0.0, 1.0)
    return PolyCollection(list(corners), facecolors=shaded, edgecolors=shaded, linewidths=0.4)
