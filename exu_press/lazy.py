"""Objects whose modules are loaded on first use."""

from fe_models.lazy import named_object

TYPE_CHECKING = False  # that of typing takes longer to load than all of this

if TYPE_CHECKING:
    from typing import Any

__all__ = ["load_object"]


def load_object(home: str) -> "Any":
    """Return the class, function or other object "module:name" of this package."""
    return named_object(f"exu_press.{home}")
