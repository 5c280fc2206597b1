"""One measured number."""

import dataclasses
from collections.abc import Mapping
from typing import Any

from exu_press.errors import InputError
from exu_press.schema.checks import key
from exu_press.schema.csv_table import flat
from exu_press.schema.table import Table

__all__ = ["MeasuredNumber", "dotted_keys"]


@dataclasses.dataclass(frozen=True)
class MeasuredNumber(Table):
    """A table [[measured]]: the reading of an instrument.

    Attributes:
        quantity: full name, with its kind of observation, as a peak averaged over 1 ms.
        under: key of the scene that differs in the measurement -> its value.
    """

    table = "measured"

    required = ("quantity", "value", "uncertainty")

    quantity: str = key(None, "name of a quantity")
    value: float = key(None, "reading, SI")
    uncertainty: float = key(None, "its standard deviation, SI", above=0)
    weight: float = key(1.0, "how often it counts", above=0)
    under: Mapping[str, Any] = dataclasses.field(default_factory=dict, hash=False)

    def __post_init__(self) -> None:
        super().__post_init__()
        object.__setattr__(self, "under", dotted_keys("measured", self.under))

    @property
    def name(self) -> str:
        """Its name in tables."""
        return self.quantity + "".join(f", {k} = {v:g}" if isinstance(v, float) else f", {k} = {v}"
                                       for k, v in self.under.items())  # fmt: skip


def dotted_keys(table: str, data: Any) -> dict[str, Any]:
    """Return the keys of a nested table by dotted names: TOML's a.b is its "a.b"."""
    if not isinstance(data, Mapping):
        raise InputError(f"{table}.under = {data!r:.80}: allowed is a table of keys of the scene")
    return flat(data)
