"""Arrays inside a page: base64 of gzip, their bytes ordered by significance, which packs better."""

import base64
import gzip
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

__all__ = ["Blocks"]

LEVEL = 6
"""Compression level of gzip: more takes three times as long for a hundredth of the size."""

KINDS = {"f4": "<f4", "f8": "<f8", "u4": "<u4", "i2": "<i2"}
"""Name that the page's script knows -> type of the numbers."""


@dataclass
class Blocks:
    """Arrays by number; each is an element of the page that no browser runs or shows."""

    elements: list[str] = field(default_factory=list)

    def add(self, values: NDArray[np.generic], kind: str = "f4") -> dict[str, object]:
        """Store an array, (n,) or (n, k), column after column; return its entry for the script.

        Args:
            values: numbers.
            kind: one of KINDS, in which they are stored.
        """
        columns = np.asarray(values, KINDS[kind])
        rows = len(columns)
        stored = np.ascontiguousarray(columns.reshape(rows, -1).T)
        size = stored.dtype.itemsize
        ordered = np.frombuffer(stored.tobytes(), np.uint8).reshape(-1, size).T
        packed = base64.b64encode(gzip.compress(ordered.tobytes(), LEVEL, mtime=0)).decode("ascii")
        name = f"block-{len(self.elements)}"
        self.elements.append(f'<script type="text/plain" id="{name}">{packed}</script>')
        return {"id": name, "kind": kind, "rows": rows, "columns": len(stored)}

    def html(self) -> str:
        """Return the elements."""
        return "\n".join(self.elements)
