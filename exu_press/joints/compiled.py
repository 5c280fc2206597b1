"""Whether the laws and joints that are called in every iteration are compiled."""

from pathlib import Path

import exu_press.joints.interface

__all__ = ["COMPILED"]

COMPILED = Path(exu_press.joints.interface.__file__).suffix != ".py"
"""True where forces and Jacobians are compiled; setup.py compiles the same sources."""
