"""Flexible bodies in a page: surface, modes and stresses, as small as a picture allows."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from exu_press.page.blocks import Blocks
from exu_press.result import Result

__all__ = ["surfaces"]

STEPS = 32767
"""Largest integer of 16 bits, to which modes and stresses are rounded: far below a pixel."""

ENOUGH = 1e-3
"""A mode that never moves or stresses a body by more of the whole is left out."""


def surfaces(result: Result, blocks: Blocks) -> list[dict[str, Any]]:
    """Return the surfaces of a run's flexible bodies and the modes that show in it."""
    surface_entries = []
    for body, surface in result.surfaces.items():
        coordinates = np.abs(result[f"{body}_modes"]).max(axis=0)
        moved = np.abs(surface.modes).max(axis=(0, 1)) * coordinates
        stressed = np.zeros_like(moved)
        if len(surface.stress):
            stressed = np.abs(surface.stress).max(axis=(0, 1)) * coordinates
        shows = (moved > ENOUGH * moved.max()) | (stressed > ENOUGH * stressed.max())
        modes = np.flatnonzero(shows)
        surface_entries.append(
            {
                "body": body,
                "index": result.bodies.index(body),
                "modes": [int(mode) for mode in modes],
                "nodes": blocks.add(surface.nodes),
                "triangles": blocks.add(surface.triangles, "u4"),
                "shapes": _store_as_integers(surface.modes[:, :, modes], blocks),
                "stress": _store_as_integers(surface.stress[:, :, modes], blocks)
                if len(surface.stress)
                else None,
            }
        )
    return surface_entries


def _store_as_integers(values: NDArray[np.float32], blocks: Blocks) -> dict[str, Any]:
    """Store (s, components, modes) as integers, each mode with a scale of its own."""
    scale = np.abs(values).max(axis=(0, 1)) / STEPS
    whole = np.round(values / np.where(scale > 0.0, scale, 1.0)).astype(np.int16)
    flat = whole.reshape(len(values), -1)  # component by component, mode by mode
    return {"block": blocks.add(flat, "i2"), "scale": [float(s) for s in scale]}
