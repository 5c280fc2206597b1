"""The study file of a sensitivity study."""

import dataclasses
from typing import Any, cast

from exu_press.errors import InputError
from exu_press.quantities import quantity_of
from exu_press.schema.checks import Table, key, table_from
from exu_press.studies.base import Normal, Range, Study
from exu_press.studies.base.evaluation import ranged

__all__ = ["Asked", "Sensitivity"]


@dataclasses.dataclass(frozen=True)
class Asked(Table):
    """The table [sensitivity].

    Attributes:
        quantities: full names of what is looked at.

    Raises:
        InputError: no quantity, or samples that are no power of two.
    """

    table = "sensitivity"

    quantities: tuple[str, ...] = ()
    samples: int = key(128, "base samples; runs are samples times keys + 2", at_least=8)
    seed: int = key(0, "of the samples", at_least=0)
    share: float = key(0.95, "of the presses built, between whose bounds", above=0, at_most=0.999)

    def __post_init__(self) -> None:
        """Check the names and the number."""
        super().__post_init__()
        names = self.quantities
        if isinstance(names, str) or not all(isinstance(n, str) for n in names) or not names:
            raise InputError(
                f"sensitivity.quantities = {names!r}: allowed is a list of names of quantities"
            )
        object.__setattr__(self, "quantities", tuple(names))
        if self.samples & (self.samples - 1):
            raise InputError(
                f"sensitivity.samples = {self.samples}: allowed is a power of two, as 64 or 128"
            )


@dataclasses.dataclass(frozen=True)
class Sensitivity(Study):
    """A sensitivity study's file, complete.

    Attributes:
        sensitivity: what is asked.
    """

    sensitivity: Asked = dataclasses.field(default=cast(Any, None))

    def __post_init__(self) -> None:
        """Check the keys and the quantities."""
        if self.sensitivity is None:
            raise InputError('no [sensitivity]; allowed is [sensitivity] quantities = ["NAME"]')
        object.__setattr__(self, "sensitivity", table_from(Asked, "sensitivity", self.sensitivity))
        super().__post_init__()
        ranged(self, "sensitivity", (Range, Normal))
        for name in self.sensitivity.quantities:
            quantity_of(self.scene, name)
