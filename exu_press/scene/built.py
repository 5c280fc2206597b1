"""The built model of a scene, as its users see it."""

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, Protocol

if TYPE_CHECKING:
    import exudyn as exu

    from exu_press.integrate import Outcome

__all__ = ["AssembledModel"]


class AssembledModel(Protocol):
    """An assembled Exudyn system; `exu_press.model.Model` has all of its parts."""

    @property
    def mbs(self) -> "exu.MainSystem":
        """Exudyn's main system."""
        ...

    @property
    def SC(self) -> "exu.SystemContainer":  # noqa: N802 - Exudyn's own name
        """Exudyn's system container."""
        ...

    @property
    def bodies(self) -> Mapping[str, int]:
        """Object numbers by the names of the bodies."""
        ...

    @property
    def clearance_joints(self) -> Mapping[str, Any]:
        """Joints with clearance by their names."""
        ...

    def solve(self, *, quiet: bool = True) -> "Outcome":
        """Run to the end time or to an early stop."""
        ...
