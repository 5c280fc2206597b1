"""What the paper publishes, as data: numbers, trends in words, frequencies."""

import tomllib
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

__all__ = ["Frequencies", "Number", "Published", "Trend", "published"]


@dataclass(frozen=True)
class Number:
    """A number of section 5.

    Attributes:
        quantity: in words.
        figure: where the paper has it.
        measure: what of a run it is compared with, as in `readings`.
        published: SI units.
        run: name of our run beside it.
        reference: measured on the machine, not computed by the paper.
        note: what to know before comparing.
    """

    quantity: str
    figure: str
    measure: str
    published: float
    run: str
    reference: bool = False
    note: str = ""


@dataclass(frozen=True)
class Trend:
    """What the paper states in words about runs in an order; `stated` as in `verdicts.TRENDS`."""

    quantity: str
    figure: str
    measure: str
    stated: str
    runs: tuple[str, ...]
    note: str = ""


@dataclass(frozen=True)
class Frequencies:
    """Natural frequencies of one flexible part, Hz, of the modes numbered beside them."""

    part: str
    figure: str
    mode_numbers: tuple[int, ...]
    hz: tuple[float, ...]


@dataclass(frozen=True)
class Published:
    """Everything; `clearance` is the recommended one, m."""

    numbers: tuple[Number, ...]
    trends: tuple[Trend, ...]
    frequencies: tuple[Frequencies, ...]
    clearance: dict[str, Any]

    @property
    def peaks(self) -> list[Number]:
        """Return the peak accelerations that the paper computed."""
        return [n for n in self.numbers if "acceleration" in n.measure and not n.reference]


@cache
def published() -> Published:
    """Return the paper's results."""
    data = tomllib.loads(Path(__file__).with_name("published.toml").read_text(encoding="utf-8"))
    modes = tuple(data["frequencies"].pop("mode_numbers"))
    return Published(
        numbers=tuple(Number(**entry) for entry in data["number"]),
        trends=tuple(Trend(**(entry | {"runs": tuple(entry["runs"])})) for entry in data["trend"]),
        frequencies=tuple(
            Frequencies(part, entry["figure"], modes, tuple(entry["hz"]))
            for part, entry in data["frequencies"].items()
        ),
        clearance=data["recommended_clearance"],
    )
