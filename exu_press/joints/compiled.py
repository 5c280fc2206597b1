"""Whether joints and laws run compiled; setup.py compiles them, from the same sources."""

from pathlib import Path

from exu_press.joints import interface

__all__ = ["COMPILED"]

COMPILED = Path(interface.__file__).suffix != ".py"
"""Whether forces and Jacobians of the joints come from compiled code."""
