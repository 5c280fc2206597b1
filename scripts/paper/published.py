"""What the paper publishes, as data: numbers, trends in words, frequencies."""

import tomllib
from dataclasses import dataclass, replace
from functools import cache
from pathlib import Path
from typing import Any

__all__ = ["Frequencies", "Number", "Published", "Trend", "published", "stated"]


@dataclass(frozen=True)
class Number:
    """A number of section 5.

    Attributes:
        name: short, unique.
        quantity: in words.
        figure: where the paper has it.
        measure: what of a run it is compared with, as in `readings`.
        published: SI units.
        run: name of our run beside it.
        reference: measured on the machine, not computed by the paper.
        note: what to know before comparing.
    """

    name: str
    quantity: str
    figure: str
    measure: str
    published: float
    run: str
    reference: bool = False
    note: str = ""


@dataclass(frozen=True)
class Trend:
    """What the paper states in words about runs in an order; `stated` as in `trends.TRENDS`."""

    name: str
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

    def beside(self, bodies: str) -> "Published":
        """Return the same beside runs with "rigid" bodies instead of flexible ones.

        What is said of flexible against rigid ones is left out then.
        """
        if bodies == "flexible":
            return self

        def named(run: str) -> str:
            return run.replace("flexible", bodies)

        trends = [
            replace(trend, runs=tuple(named(run) for run in trend.runs)) for trend in self.trends
        ]
        return replace(
            self,
            numbers=tuple(replace(number, run=named(number.run)) for number in self.numbers),
            trends=tuple(trend for trend in trends if len(set(trend.runs)) == len(trend.runs)),
        )


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


def stated(run: str, measure: str) -> float | None:
    """Return what the paper computed for a run of ours, by its name; None where it says nothing."""
    found = [
        number.published
        for number in published().numbers
        if number.run == run and number.measure == measure and not number.reference
    ]
    return found[0] if found else None
