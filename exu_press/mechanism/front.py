"""A mechanism from the front over a revolution, as animation and page show it."""

import numpy as np

from exu_press.mechanism.mechanism import Mechanism
from exu_press.mechanism.shapes import Mark, marks, rails, shapes_of, swept_outlines
from exu_press.numerics.arrays import Array

__all__ = ["Front"]


class Front:
    """Shapes of the bodies, where they pass with ideal joints, and what stands still behind them.

    Attributes:
        shapes: by body.
        everywhere: all places (n, 2) of every body's outline.
        low: least x and y of them, m.
        high: largest ones.
        unit: of words and pins, m: the larger of height and width.
    """

    def __init__(self, mechanism: Mechanism) -> None:
        self._mechanism = mechanism
        self.shapes = shapes_of(mechanism)
        self.everywhere = swept_outlines(mechanism, self.shapes)
        corners = np.vstack(list(self.everywhere.values()))
        self.low, self.high = corners.min(axis=0), corners.max(axis=0)
        self.unit = float((self.high - self.low).max())

    def layer(self, body: str) -> int:
        """Return a body's layer: the slider, other blocks, links, and the crank in front."""
        if body == self._mechanism.slider:
            return -1
        return {"block": 0, "crank": 2}.get(self.shapes[body].role, 1)

    def rails(self) -> list[Array]:
        """Return the rails on both sides of every guided body, their corners (4, 2)."""
        return [
            rail
            for guide in self._mechanism.guides
            for rail in rails(guide, self.everywhere[guide.body], self.unit)
        ]

    def dead_centres(self) -> list[Mark]:
        """Return the slider's ideal dead centres, none where it has none."""
        return marks(self._mechanism, self.everywhere[self._mechanism.slider])
