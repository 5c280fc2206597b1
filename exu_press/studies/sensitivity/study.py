"""The study file of a sensitivity study."""

import dataclasses
from types import MappingProxyType
from typing import Any, cast

from exu_press.errors import InputError
from exu_press.quantities import quantity_of
from exu_press.schema.checks import key
from exu_press.schema.table import Table
from exu_press.studies.base import Normal, Range, Study
from exu_press.studies.base.evaluation import require_key_kinds
from exu_press.studies.base.study import names_in

__all__ = ["Sensitivity", "SensitivitySettings"]


@dataclasses.dataclass(frozen=True)
class SensitivitySettings(Table):
    """The table [sensitivity].

    Attributes:
        quantities: full names.

    Raises:
        InputError: no quantity, or samples that are no power of two.
    """

    table = "sensitivity"

    quantities: tuple[str, ...] = ()
    samples: int = key(128, "base samples; runs are samples times keys + 2", at_least=8)
    seed: int = key(0, "of the samples", at_least=0)
    share: float = key(0.95, "of the presses built, between whose bounds", above=0, at_most=0.999)

    def __post_init__(self) -> None:
        super().__post_init__()
        names = names_in("sensitivity.quantities", self.quantities)
        object.__setattr__(self, "quantities", names)
        if self.samples & (self.samples - 1):
            raise InputError(
                f"sensitivity.samples = {self.samples}: allowed is a power of two, as 64 or 128"
            )


@dataclasses.dataclass(frozen=True)
class Sensitivity(Study):
    """A sensitivity study's file, complete."""

    tables = MappingProxyType({"sensitivity": SensitivitySettings})

    sensitivity: SensitivitySettings = dataclasses.field(default=cast(Any, None))

    def __post_init__(self) -> None:
        super().__post_init__()
        require_key_kinds(self, "sensitivity", (Range, Normal))
        for name in self.sensitivity.quantities:
            quantity_of(self.scene, name)
