"""Flexible crank and linkage, deformed and exaggerated, coloured by displacement or stress."""

from dataclasses import dataclass

import matplotlib
import numpy as np
from matplotlib.collections import PolyCollection
from matplotlib.colors import Colormap, ListedColormap, Normalize
from matplotlib.figure import Figure
from matplotlib.gridspec import SubplotSpec

from exu_press.numerics.arrays import Array
from exu_press.result import Result
from exu_press.result.surface import Surface
from exu_press.view.instants import Instants
from exu_press.view.panel import mark_animated
from fe_models.errors import InputError
from fe_models.solid_view import facing, turned_view

__all__ = ["FlexiblePanel", "Look"]

TIMES_SIGN = "\N{MULTIPLICATION SIGN}"

DEFLECTION = 0.06
"""Largest displacement of the animation as drawn, over the bodies' extent."""

TURN, TILT = np.radians(-55.0), np.radians(20.0)
"""Angles of the view, about y and then about x."""

COLOURS: Colormap = ListedColormap(
    matplotlib.colormaps["YlGnBu"].resampled(256)(range(30, 256)), "YlGnBu without its palest end"
)
"""Light is little, dark is much: to be told apart by their lightness alone."""

KINDS = {"displacement": (1e6, "displacement, µm"), "stress": (1e-6, "von Mises stress, MPa")}


@dataclass(frozen=True)
class Look:
    """The look of flexible bodies.

    Attributes:
        colour: "displacement" or "stress".
        exaggerate: factor of the deformation; None: the largest is drawn as 6 % of the bodies.
    """

    colour: str = "displacement"
    exaggerate: float | None = None

    def __post_init__(self) -> None:
        if self.colour not in KINDS:
            raise InputError(f"--colour {self.colour}: allowed is one of {', '.join(KINDS)}")
        if self.exaggerate is not None and not 0.0 <= self.exaggerate <= 1e9:
            raise InputError(f"--exaggerate {self.exaggerate:g}: allowed is a number >= 0")


class FlexiblePanel:
    """The bodies' surfaces where they are, seen obliquely.

    Displacement and deformation are those from the body's own mean frame, without its rigid motion.
    """

    def __init__(
        self, figure: Figure, cell: SubplotSpec, result: Result, instants: Instants, how: Look
    ) -> None:
        """Find the largest values of the animation, for scale and colours."""
        self._surfaces = result.surfaces
        index = {name: result.bodies.index(name) for name in result.surfaces}
        stored = result["body_position"]
        self._poses = {name: stored[instants.step, i] for name, i in index.items()}
        self._modal = {name: result[f"{name}_modes"][instants.step] for name in result.surfaces}
        self._stress = how.colour == "stress"
        if self._stress and not all(len(s.stress) for s in result.surfaces.values()):
            raise InputError("--colour stress: the file holds no stresses; use displacement")
        frames_in_view = slice(1, 2) if instants.still else slice(None)
        modes = self._modal
        modal = [(name, q) for name in modes for q in modes[name][frames_in_view]]
        largest_displacement = max(self._largest_displacement(name, q) for name, q in modal)
        extent = max(float(np.ptp(s.nodes, axis=0).max()) for s in result.surfaces.values())
        automatic = (
            _round_down(DEFLECTION * extent / largest_displacement) if largest_displacement else 1.0
        )
        self._factor = automatic if how.exaggerate is None else how.exaggerate
        scale, words = KINDS[how.colour]
        largest = max(float(self._level(name, q).max()) for name, q in modal)
        self._view = turned_view(TURN, TILT)
        self._scale = scale
        norm = Normalize(0.0, scale * largest or 1.0)
        self._colours = matplotlib.cm.ScalarMappable(norm, COLOURS)
        axes = figure.add_subplot(cell)
        axes.set_aspect("equal", adjustable="box")
        axes.set_axis_off()
        bodies = " and ".join(sorted(result.surfaces))
        axes.set_title(f"Flexible {bodies}: deformation {TIMES_SIGN} {self._factor:g}")
        frames = np.arange(len(instants))[frames_in_view]
        sampled_frames = np.unique(np.linspace(frames[0], frames[-1], 60).astype(int))
        corners = np.vstack(
            [self._corners(name, frame) for name in modes for frame in sampled_frames]
        )
        low, high = corners[:, :2].min(axis=0), corners[:, :2].max(axis=0)
        margin = 0.02 * float((high - low).max())
        axes.set(xlim=(low[0] - margin, high[0] + margin), ylim=(low[1] - margin, high[1] + margin))
        figure.colorbar(
            self._colours, ax=axes, label=words, location="bottom", shrink=0.8, pad=0.02, aspect=35
        )
        self._drawn = PolyCollection([], linewidths=0.25, clip_on=False)
        axes.add_collection(self._drawn, autolim=False)
        self.artists = mark_animated(self._drawn)

    def show(self, frame: int) -> None:
        """Draw the surfaces of a frame, far triangles first."""
        triangles, levels, start = [], [], 0
        points = []
        for name, surface in self._surfaces.items():
            points.append(self._corners(name, frame))
            triangles.append(surface.triangles + start)
            levels.append(self._level(name, self._modal[name][frame]))
            start += len(surface.nodes)
        polygons, corner_numbers, light = facing(np.vstack(points), np.vstack(triangles))
        own = self._colours.to_rgba(self._scale * np.concatenate(levels))[:, :3]
        shade = 0.72 + 0.28 * light  # weak, so that it cannot be taken for a value
        colours = np.clip(own[corner_numbers].mean(axis=1) * shade[:, None], 0.0, 1.0)
        self._drawn.set_verts(list(polygons))
        self._drawn.set(facecolor=colours, edgecolor=colours)

    def _largest_displacement(self, name: str, modal: Array) -> float:
        """Return the largest displacement of a body's nodes, m."""
        return float(np.linalg.norm(self._surfaces[name].displacement(modal), axis=1).max())

    def _level(self, name: str, modal: Array) -> Array:
        """Return the values behind the nodes' colours, m or Pa."""
        surface: Surface = self._surfaces[name]
        if self._stress:
            return np.asarray(surface.von_mises(modal), dtype=float)
        return np.asarray(np.linalg.norm(surface.displacement(modal), axis=1), dtype=float)

    def _corners(self, name: str, frame: int) -> Array:
        """Return the nodes (s, 3) as seen: right, up, towards the eye."""
        surface, (x, y, angle) = self._surfaces[name], self._poses[name][frame]
        nodes = surface.nodes + self._factor * surface.displacement(self._modal[name][frame])
        c, s = np.cos(angle), np.sin(angle)
        turned = nodes @ np.array([[c, s, 0], [-s, c, 0], [0, 0, 1]]) + (x, y, 0.0)
        return np.asarray(turned @ self._view.T)


def _round_down(value: float) -> float:
    """Return the next smaller of 1, 2, 5, 10, ..."""
    decade = 10.0 ** np.floor(np.log10(value))
    return float(max(m for m in (1, 2, 5) if m * decade <= 1.0001 * value) * decade)
