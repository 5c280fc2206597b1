"""The page that one can zoom and play: curves, the mechanism in motion, studies."""

from exu_press.page.document import Live, has_library

__all__ = ["Live", "has_library"]
