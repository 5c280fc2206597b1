"""A mechanism from the front over a revolution, as animation and page show it."""

import numpy as np

from exu_press.mechanism.mechanism import Mechanism
from exu_press.mechanism.parts import Point
from exu_press.mechanism.shapes import shapes_of, swept_outlines
from exu_press.numerics.arrays import Array

__all__ = ["Front"]


class Front:
    """Shapes of the bodies, where they pass with ideal joints, and what stands still behind them.

    Attributes:
        shapes: by body.
        everywhere: all places (n, 2) of every body's outline.
        low: least x and y of them, m.
        high: largest ones.
        unit: their height.
    """

    def __init__(self, mechanism: Mechanism) -> None:
        self._mechanism = mechanism
        self.shapes = shapes_of(mechanism)
        self.everywhere = swept_outlines(mechanism, self.shapes)
        corners = np.vstack(list(self.everywhere.values()))
        self.low, self.high = corners.min(axis=0), corners.max(axis=0)
        self.unit = float(self.high[1] - self.low[1])

    def layer(self, body: str) -> int:
        """Return a body's layer: the slider, other blocks, links, and the crank in front."""
        if body == self._mechanism.slider:
            return -1
        return {"block": 0, "crank": 2}.get(self.shapes[body].role, 1)

    def rails(self) -> list[Array]:
        """Return the rails on both sides of every guided body, their corners (4, 2)."""
        gap, width = 0.004 * self.unit, 0.008 * self.unit
        found = []
        for guide in self._mechanism.guides:
            outline = self.everywhere[guide.body]
            (left, low), (right, high) = outline.min(axis=0), outline.max(axis=0)
            for edge in (left - gap - width, right + gap):
                far = edge + width
                found.append(np.array([[edge, low], [far, low], [far, high], [edge, high]]))
        return found

    def dead_centres(self) -> dict[str, Point]:
        """Return the slider's upper left corner in its ideal dead centres, if it has any."""
        if self._mechanism.dead_centres is None:
            return {}
        slider = self._mechanism.slider
        outline = self.everywhere[slider]
        motion = self._mechanism.motion(np.linspace(0.0, 2.0 * np.pi, 721), 1.0)[slider]
        heights, left = motion.position[:, 1], float(outline[:, 0].min())
        edge = float(outline[:, 1].max() - heights.max())
        places = {"TDC": heights.max(), "BDC": heights.min()}
        return {name: (left, float(height) + edge) for name, height in places.items()}
