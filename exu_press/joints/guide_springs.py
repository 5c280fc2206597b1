"""The springs of an elastic guide on a moving body: across its line, and against tilting.

One massless item over the nodes of both bodies, since Exudyn's spring along an axis of a marker
exerts no moment on that marker's body by the arm of its force.
"""

from collections.abc import Sequence
from typing import Any

import exudyn as exu
import numpy as np

from exu_press.joints.guide_friction import SpringSide
from exu_press.joints.guide_line import TurningLine
from exu_press.joints.user_force import add_massless_item
from exu_press.numerics.arrays import Array

__all__ = ["GuideSprings"]

TILT = np.array([0.0, 0.0, 1.0, 0.0, 0.0, -1.0])
"""Tilt of the body by each coordinate of both bodies."""


class GuideSprings:
    """One massless item over the nodes of a guided body and of the one on which it slides."""

    def __init__(
        self,
        mbs: exu.MainSystem,
        nodes: Sequence[int],
        line: TurningLine,
        lateral: tuple[float, float],
        tilting: tuple[float, float],
        relaxed: float,
    ) -> None:
        """Add the springs to a system.

        Args:
            mbs: not yet assembled.
            nodes: of the guided body and of the one with the line.
            line: of the guide.
            lateral: stiffness and damping across it, N/m and N s/m.
            tilting: the same against tilting, N m/rad and N m s/rad.
            relaxed: tilt without moment, rad.
        """
        self._line, self._side, self._tilting = line, SpringSide(*lateral, line), tilting
        self._relaxed = relaxed
        self._tilts = np.outer(TILT, TILT)
        add_massless_item(mbs, nodes, self._forces, self._jacobian)

    def _forces(self, mbs: exu.MainSystem, time: float, item: int, q: Any, q_t: Any) -> Array:
        q, q_t = np.asarray(q), np.asarray(q_t)
        stiffness, damping = self._tilting
        moment = stiffness * (self._line.tilt(q) - self._relaxed) + damping * float(TILT @ q_t)
        normal = self._line.normal_row(q)
        return -self._side.force(q, q_t) * normal - moment * TILT

    def _jacobian(
        self,
        mbs: exu.MainSystem,
        time: float,
        item: int,
        q: Any,
        q_t: Any,
        by_q: float,
        by_q_t: float,
    ) -> exu.MatrixContainer:
        q, q_t = np.asarray(q), np.asarray(q_t)
        normal, turning = self._line.normal_row(q), self._line.turning(self._line.direction_row(q))
        by_places, by_rates = self._side.partials(q, q_t)
        row = by_q * by_places + by_q_t * by_rates
        matrix = np.outer(normal, row) + by_q * self._side.force(q, q_t) * turning
        stiffness, damping = self._tilting
        matrix += (by_q * stiffness + by_q_t * damping) * self._tilts
        container = exu.MatrixContainer()
        container.SetWithDenseMatrix(matrix)
        return container
