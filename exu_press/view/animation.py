"""The whole picture: mechanism, joints magnified, curves; brought from frame to frame."""

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any, cast

import numpy as np
from matplotlib.artist import Artist
from matplotlib.colors import to_hex
from matplotlib.figure import Figure
from matplotlib.font_manager import findfont
from matplotlib.gridspec import SubplotSpec
from matplotlib.text import Text
from matplotlib.transforms import Bbox
from PIL import Image, ImageDraw, ImageFont

from exu_press.plots.busiest import busiest
from exu_press.plots.canvas import angle_words, dead_centres
from exu_press.plots.palette import GREY
from exu_press.plots.peaks import draw_rest
from exu_press.plots.scales import crank_angle_axis, impact_scale, note
from exu_press.plots.style import look, points
from exu_press.plots.typesetting import plain
from exu_press.plots.words import describe, early_stops
from exu_press.result import Result
from exu_press.scene import mechanism_of
from exu_press.view.flexible_panel import FlexiblePanel, Look
from exu_press.view.instants import Instants
from exu_press.view.joint_panel import JointPanel
from exu_press.view.mechanism_panel import MechanismPanel
from exu_press.view.panel import CurvePanel, Panel, mark_animated

__all__ = ["SIZE", "Animation", "Look"]

SIZE = (12.8, 7.2)
"""Inch."""

ABOVE = 10
"""Order of drawing, behind that of all still parts."""

MOST_JOINTS = 2
"""Joints that are magnified, the busiest ones; the rest stand in a table."""

CURVES = (
    ("slider_position", "Slider position", "m{unit}", 1e3),
    ("slider_velocity", "Slider velocity", "{unit}/s", 1.0),
    ("slider_acceleration", "Slider acceleration", "{unit}/s²", 1.0),
)


class Animation:
    """A figure that shows one frame after the other."""

    def __init__(
        self, result: Result, instants: Instants, figure: Figure, flexible: Look | None = None
    ) -> None:
        """Draw the still parts.

        Args:
            result: of the run.
            instants: the frames.
            figure: an empty one of SIZE.
            flexible: how flexible bodies are shown; None: as their defaults are.
        """
        self.figure, self.instants, self.result = figure, instants, result
        self.panels: list[Panel] = []
        with look():
            self._draw(flexible or Look())
        self.artists = [artist for panel in self.panels for artist in panel.artists]
        self.artists += mark_animated(self._clock)

    def show(self, frame: int) -> None:
        """Bring everything to a frame."""
        for panel in self.panels:
            panel.show(frame)
        step = int(self.instants.step[frame])
        degrees = np.degrees(self.result["crank_angle"][step])
        self._clock.set_text(
            f"t = {self.instants.time[frame] * 1e3:7.2f} ms    crank {degrees:6.1f}°"
        )

    def freeze(self) -> None:
        """Let the figure draw the moving parts itself, as it stands, over the still ones."""
        for number, artist in enumerate(self.artists):
            artist.set(animated=False, zorder=ABOVE + number)

    def draw(self, artists: Iterable[Artist]) -> None:
        """Draw some of the moving parts."""
        for artist in artists:
            self.figure.draw_artist(artist)

    def _draw(self, flexible: Look) -> None:
        """Lay out and draw all panels."""
        figure, result = self.figure, self.result
        width = 150
        lines = [describe([result.scene], width), early_stops({"": result}, width)]
        text = plain("\n".join(filter(None, lines)))
        figure.text(0.012, 0.975, text, fontsize=points(9.0), va="top")
        self._clock = figure.text(
            0.988, 0.972, "", fontsize=points(11), fontweight="bold", va="top", ha="right"
        )
        slow = self.instants.slow
        factor = f"{slow:.3g} times slower" if slow >= 1.0 else f"{1.0 / slow:.3g} times faster"
        speed = f"{factor} than the machine at {self.instants.fps:g}"
        if not self.instants.still:
            figure.text(0.012, 0.015, f"{speed} frames a second", fontsize=points(7.5), color=GREY)
        names = sorted(result.clearance_joints, key=lambda n: (result.joints[n].spherical, n))
        joints, rest = busiest([result], names, "eccentricity", MOST_JOINTS)
        columns = figure.add_gridspec(
            1,
            3,
            width_ratios=(1.0, 0.95 if joints else 0.01, 1.2),
            left=0.01,
            right=0.985,
            top=0.90,
            bottom=0.095,
            wspace=0.14,
        )
        self.panels.append(MechanismPanel(figure.add_subplot(columns[0]), result, self.instants))
        if joints:
            heights = [1.0] * len(joints) + [0.085 * (len(rest) + 2)] * bool(rest)
            rows = columns[1].subgridspec(len(heights), 1, hspace=0.16, height_ratios=heights)
            if rest:
                draw_rest(figure.add_subplot(rows[-1]), result, rest, points(9.0))
            for index, (name, title) in enumerate(joints.items()):
                axes = figure.add_subplot(rows[index])
                self.panels.append(JointPanel(axes, result, name, title, self.instants))
        if result.surfaces:
            right = columns[2].subgridspec(2, 1, height_ratios=(1.0, 1.0), hspace=0.22)
            self.panels.append(FlexiblePanel(figure, right[0], result, self.instants, flexible))
            self._draw_curves(right[1], (CURVES[0], CURVES[2]))
        else:
            self._draw_curves(columns[2], CURVES)

    def _draw_curves(
        self, cell: SubplotSpec, curves: tuple[tuple[str, str, str, float], ...]
    ) -> None:
        result, step = self.result, self.instants.step
        heights = (1.0, 1.0, 1.0) if len(curves) == 3 else (0.6, 1.0)
        rows = cell.subgridspec(len(curves), 1, hspace=0.33, height_ratios=heights)
        degrees = np.degrees(result["crank_angle"])
        output_unit = mechanism_of(result.scene).output.unit
        steps_in_view = slice(int(step[0]), int(step[-1]) + 1)
        panels = []
        for index, (channel, title, unit, scale) in enumerate(curves):
            axes = self.figure.add_subplot(rows[index])
            values = scale * result[channel]
            self.panels.append(CurvePanel(axes, result, values, self.instants))
            axes.set(title=title, ylabel=unit.format(unit=output_unit))
            if channel == "slider_acceleration":
                note(
                    axes,
                    impact_scale(
                        axes, [(degrees[steps_in_view], values[steps_in_view])], signed=True
                    ),
                )
            else:
                axes.margins(y=0.08)
            axes.tick_params(labelbottom=index == len(curves) - 1)
            panels.append(axes)
        panels[-1].set_xlabel(angle_words({"": result}))
        ends = degrees[steps_in_view].min(), degrees[steps_in_view].max()
        crank_angle_axis(panels, *ends, dead_centres({"": result}))


HALO: dict[str, Any] = {"stroke_width": 2, "stroke_fill": "white"}
"""Of a text with a box, which may lie on a body."""


@dataclass
class Painter:
    """Draws the frames of an animation into memory, each on the same background.

    Matplotlib takes half a frame's time for its three lines of text; Pillow writes them at once.
    """

    animation: Animation
    dpi: float

    def __post_init__(self) -> None:
        from matplotlib.backends.backend_agg import FigureCanvasAgg

        self.animation.figure.set_dpi(self.dpi)
        self._canvas = cast(Any, FigureCanvasAgg(self.animation.figure))
        with look():
            self._canvas.draw()
        self._background = self._canvas.copy_from_bbox(
            Bbox.from_bounds(0, 0, *self._canvas.get_width_height())
        )
        self._texts = [artist for artist in self.animation.artists if isinstance(artist, Text)]
        self._drawn = [artist for artist in self.animation.artists if not isinstance(artist, Text)]
        self._fonts = [_font(text, self.dpi) for text in self._texts]

    def paint(self, frame: int) -> Image.Image:
        """Return a frame's picture."""
        self.animation.show(frame)
        self._canvas.restore_region(self._background)
        with look():
            self.animation.draw(self._drawn)
        image = Image.fromarray(np.asarray(self._canvas.buffer_rgba())).convert("RGB")
        on_it = ImageDraw.Draw(image)
        for text, font in zip(self._texts, self._fonts, strict=True):
            x, y = text.get_transform().transform(text.get_position())
            anchor = {"left": "l", "right": "r"}[text.get_horizontalalignment()]
            anchor += {"top": "a", "center": "m", "bottom": "d"}[text.get_verticalalignment()]
            colour = to_hex(text.get_color())
            halo = {} if text.get_bbox_patch() is None else HALO
            on_it.text((x, image.height - y), text.get_text(), colour, font, anchor, **halo)
        return image


def _font(text: Text, dpi: float) -> ImageFont.FreeTypeFont:
    """Return the font of a text for Pillow."""
    properties = text.get_fontproperties()
    return ImageFont.truetype(findfont(properties), properties.get_size_in_points() * dpi / 72)
