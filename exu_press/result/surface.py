"""The surface of a flexible body with its modes, for pictures from a file."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from exu_press.errors import InputError

if TYPE_CHECKING:
    from exu_press.model.placed_part import PlacedPart

__all__ = ["ARRAYS", "Surface", "surfaces_of"]

Array = NDArray[np.float32]

ARRAYS: dict[str, tuple[tuple[str, ...], str, str]] = {
    "nodes": (("node", "space"), "m", "surface nodes in the body's frame, undeformed"),
    "triangles": (("triangle", "corner"), "1", "surface triangles, by node"),
    "modes": (("node", "space", "mode"), "kg^-0.5", "displacement of the nodes, by mode"),
    "stress": (("node", "stress", "mode"), "Pa kg^-0.5 m^-1", "xx yy zz yz xz xy, by mode"),
}
"""Array -> dimensions, unit and meaning; the file's variable is called BODY_surface_ARRAY."""


@dataclass(frozen=True)
class Surface:
    """Nodes, triangles and modes of a body's surface, in single precision.

    The modal coordinates over time are the result's channel BODY_modes, (n, modes).

    Attributes:
        nodes: (s, 3), m, in the frame whose pose is in `body_position`.
        triangles: (t, 3), corners by node, outwards counter-clockwise.
        modes: (s, 3, modes).
        stress: (s, 6, modes), Pa per unit of the modal coordinate; (0, 6, modes) if unknown.

    Raises:
        InputError: an array has another shape, a corner is no node, or a value is no number.
    """

    nodes: Array
    triangles: NDArray[np.int32]
    modes: Array
    stress: Array

    def __post_init__(self) -> None:
        count, modes = len(self.nodes), self.modes.shape[-1]
        shapes: dict[str, tuple[int, ...]] = {
            "nodes": (count, 3),
            "triangles": (len(self.triangles), 3),
            "modes": (count, 3, modes),
            "stress": (count if len(self.stress) else 0, 6, modes),
        }
        for name, shape in shapes.items():
            values: NDArray[Any] = getattr(self, name)
            if values.shape != shape or not (values.size or name == "stress"):
                raise InputError(f"{name}: shape {values.shape}; allowed is {shape}")
            if not np.isfinite(values).all():
                raise InputError(f"{name}: allowed are finite numbers")
        if self.triangles.min() < 0 or self.triangles.max() >= count:
            raise InputError(f"triangles: allowed are nodes 0 to {count - 1}")

    def displacement(self, coordinates: NDArray[Any]) -> Array:
        """Return the displacement (s, 3) of the nodes for modal coordinates (modes,), m."""
        return np.asarray(self.modes @ coordinates.astype(np.float32))

    def von_mises(self, coordinates: NDArray[Any]) -> Array:
        """Return the von Mises stress (s,) for modal coordinates (modes,), Pa."""
        xx, yy, zz, yz, xz, xy = (self.stress @ coordinates.astype(np.float32)).T
        normal = (xx - yy) ** 2 + (yy - zz) ** 2 + (zz - xx) ** 2
        return np.asarray(np.sqrt(0.5 * normal + 3.0 * (yz**2 + xz**2 + xy**2)))


def surfaces_of(parts: Mapping[str, "PlacedPart"]) -> dict[str, Surface]:
    """Return the surfaces of the flexible bodies that have modes, by body."""
    return {name: _surface(placed) for name, placed in parts.items() if placed.reduced.mode_count}


def _surface(placed: "PlacedPart") -> Surface:
    """Return a surface in the body's frame; the stresses' components stay the solid's."""
    solid = placed.reduced
    c, s = np.cos(placed.angle), np.sin(placed.angle)
    rotation = np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])  # from the body to the solid
    modes = solid.modes.reshape(len(solid.nodes), 3, -1)
    return Surface(
        nodes=((solid.nodes - (*placed.centre, 0.0)) @ rotation).astype(np.float32),
        triangles=solid.triangles.astype(np.int32),
        modes=np.einsum("nim,ij->njm", modes, rotation).astype(np.float32),
        stress=solid.stress.reshape(-1, 6, solid.mode_count).astype(np.float32),
    )
