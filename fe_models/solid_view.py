"""A solid as seen: turned towards the eye, its visible triangles, and how much light is on them."""

import numpy as np
from numpy.typing import NDArray

from fe_models.arrays import Array

__all__ = ["facing", "turned_view"]

LIGHT = np.array([-0.35, 0.65, 0.67])
"""Direction towards the light: right, up, towards the eye."""


def turned_view(about_y: float, about_x: float) -> Array:
    """Return the rows right, up, towards the eye (3, 3), turned about y and then about x, rad."""
    c, s = np.cos(about_y), np.sin(about_y)
    turned = np.array([[c, 0, s], [0, 1, 0], [-s, 0, c]])
    c, s = np.cos(about_x), np.sin(about_x)
    return np.asarray(np.array([[1, 0, 0], [0, c, -s], [0, s, c]]) @ turned)


def facing(
    points: Array, triangles: NDArray[np.integer]
) -> tuple[Array, NDArray[np.integer], Array]:
    """Return the triangles that face the eye, far ones first.

    Args:
        points: as seen: right, up, towards the eye, (n, 3).
        triangles: indices of their corners, counter-clockwise from outside, (t, 3).

    Returns:
        Their corners (f, 3, 2) in the picture, their indices' rows (f, 3), and the light on them
        (f,), 0 to 1.
    """
    corners = points[triangles]
    normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normal /= np.maximum(np.linalg.norm(normal, axis=1, keepdims=True), 1e-300)
    order = np.argsort(corners[:, :, 2].mean(axis=1), kind="stable")
    order = order[normal[order, 2] > 0.0]
    light = np.clip(normal[order] @ (LIGHT / np.linalg.norm(LIGHT)), 0.0, 1.0)
    return corners[order][:, :, :2], triangles[order], light
