"""The [wear] table of a scene."""

from dataclasses import dataclass
from typing import ClassVar

from exu_press.schema.checks import Table, demand_keys, key

__all__ = ["Wear"]


@dataclass(frozen=True)
class Wear(Table):
    """Archard's law for the dry revolute joints of a scene; it changes nothing in the run."""

    table: ClassVar[str] = "wear"
    coefficient: float = key(
        None, "Archard's, of each of the two surfaces", above=0, at_most=1, example=1e-5
    )
    hardness: float = key(None, "of the surfaces", "Pa", above=0, example=2e9)
    length: float = key(None, "of the bearings along their axis", "m", above=0, example=0.1)

    def __post_init__(self) -> None:
        """Check the keys; all are asked for, as they decide the result."""
        super().__post_init__()
        demand_keys("[wear]", self, ("coefficient", "hardness", "length"), "wear", "[wear]")
