"""The study file of an optimisation."""

import dataclasses
from types import MappingProxyType

from exu_press.errors import InputError
from exu_press.quantities import quantity_of
from exu_press.schema.checks import key
from exu_press.schema.table import Table
from exu_press.studies.base import Range, Study, Values
from exu_press.studies.base.evaluation import require_key_kinds

__all__ = ["AUTO", "EVOLUTION", "NELDER_MEAD", "NSGA", "TPE", "Limit", "Objective", "Optimise"]

AUTO, NELDER_MEAD, EVOLUTION = "auto", "nelder_mead", "differential_evolution"
TPE, NSGA = "tpe", "nsga2"


@dataclasses.dataclass(frozen=True)
class Objective(Table):
    """A table [[objective]]: a quantity that is to be as small, or as large, as possible."""

    table = "objective"
    required = ("quantity",)

    quantity: str = key(None, "name of a quantity")
    sense: str = key(
        "least", "whether the least or the largest value is best", choices=("least", "largest")
    )
    weight: float = key(1.0, "where one point of a front is chosen", above=0)

    @property
    def sign(self) -> float:
        """Factor that makes less better."""
        return 1.0 if self.sense == "least" else -1.0


@dataclasses.dataclass(frozen=True)
class Limit(Table):
    """A table [[limit]]: a quantity that must stay below or above a number, or between two.

    Raises:
        InputError: both are missing, or above is not less than below.
    """

    table = "limit"
    required = ("quantity",)

    quantity: str = key(None, "name of a quantity")
    below: float | None = key(None, "upper limit, SI")
    above: float | None = key(None, "lower limit, SI")

    def __post_init__(self) -> None:
        super().__post_init__()
        low, high = self.above, self.below
        if (low is None and high is None) or (low is not None and high is not None and low >= high):
            raise InputError(
                f"limit of {self.quantity}: above = {low}, below = {high}; allowed are one of "
                "them, or above < below"
            )

    def violation(self, value: float) -> float:
        """Return the excess of a value over its limit, relative to the limit; 0 within."""
        over = 0.0 if self.below is None else (value - self.below) / (abs(self.below) or 1.0)
        under = 0.0 if self.above is None else (self.above - value) / (abs(self.above) or 1.0)
        return max(over, under, 0.0)


@dataclasses.dataclass(frozen=True)
class Search(Table):
    """The table [optimise]."""

    table = "optimise"

    method: str = key(
        AUTO,
        "of the search; the first two for one objective",
        choices=(AUTO, NELDER_MEAD, EVOLUTION, TPE, NSGA),
    )
    trials: int = key(100, "runs of the search, about", at_least=8)
    seed: int = key(0, "of its random numbers", at_least=0)


@dataclasses.dataclass(frozen=True)
class Optimise(Study):
    """An optimum's file, complete.

    Raises:
        InputError: not allowed, no objective, or a method that does not suit keys and objectives.
    """

    tables = MappingProxyType({"optimise": Search, "objective": Objective, "limit": Limit})

    objective: tuple[Objective, ...] = ()
    limit: tuple[Limit, ...] = ()
    optimise: Search = Search()

    def __post_init__(self) -> None:
        super().__post_init__()
        if not self.objective:
            raise InputError('no objective; allowed is [[objective]] quantity = "NAME"')
        require_key_kinds(self, "optimise", (Range, Values))
        for quantity in self.quantities:
            quantity_of(self.scene, quantity)
        names = [objective.quantity for objective in self.objective]
        if len(set(names)) < len(names):
            raise InputError("objective: two are of one quantity; allowed are different ones")
        scipy = self.optimise.method in (NELDER_MEAD, EVOLUTION)
        if scipy and (len(names) > 1 or self.has_values):
            why = f"{len(names)} objectives" if len(names) > 1 else "keys with [value, ...]"
            raise InputError(
                f'optimise.method = "{self.optimise.method}": with {why} allowed are "{AUTO}", '
                f'"{TPE}", "{NSGA}"'
            )

    @property
    def has_values(self) -> bool:
        """Whether a key has discrete values."""
        return any(isinstance(key, Values) for key in self.keys.values())

    @property
    def quantities(self) -> tuple[str, ...]:
        """Objectives, then limits."""
        return *(o.quantity for o in self.objective), *(limit.quantity for limit in self.limit)
