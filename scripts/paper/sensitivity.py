"""Which assumption moves which published number, and by how much."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Any

from paper.comparison import observed, published_value
from paper.published import Number
from paper.readings import OBSERVED
from paper.settings import Setting

__all__ = ["Effect", "Tornado", "tornado_of"]

Row = Mapping[str, Any]


@dataclass(frozen=True)
class Effect:
    """What one setting makes of a number; value is None where the run did not get to its end."""

    factor: str
    label: str
    value: float | None
    status: str

    def change(self, baseline: float) -> float | None:
        """Return the relative change against a baseline."""
        return None if self.value is None or not baseline else self.value / baseline - 1.0


@dataclass(frozen=True)
class Tornado:
    """One published number and what moves ours, largest swing first.

    Attributes:
        number: the published one.
        bodies: "rigid" or "flexible".
        published: what it is judged by, SI; of a bottom dead centre, how far it lies below 0.47 m.
        baseline: ours, with every assumption as it is by default.
        effects: of every setting, by swing of its factor.
    """

    number: Number
    bodies: str
    published: float
    baseline: float
    effects: tuple[Effect, ...]

    def factors(self) -> dict[str, list[Effect]]:
        """Return effects by factor, the largest swing first."""
        grouped: dict[str, list[Effect]] = {}
        for effect in self.effects:
            grouped.setdefault(effect.factor, []).append(effect)
        return dict(sorted(grouped.items(), key=lambda item: -self.swing(item[1])))

    def nearest(self) -> Effect | None:
        """Return the effect that comes nearest to the published number, as a ratio."""
        known = [effect for effect in self.effects if effect.value and effect.value > 0.0]
        known = [effect for effect in known if effect.factor != "observation model"]
        return min(
            known,
            key=lambda effect: abs((effect.value or 0.0) / self.published - 1.0),
            default=None,
        )

    def to_dict(self) -> dict[str, Any]:
        """Return the entries of sensitivity.json."""
        return {
            "name": self.number.name,
            "quantity": self.number.quantity,
            "figure": self.number.figure,
            "bodies": self.bodies,
            "published": self.published,
            "baseline": self.baseline,
            "factors": [
                {
                    "factor": factor,
                    "swing": self.swing(effects),
                    "settings": [
                        {
                            "label": effect.label,
                            "value": effect.value,
                            "change": effect.change(self.baseline),
                            "status": effect.status,
                        }
                        for effect in effects
                    ],
                }
                for factor, effects in self.factors().items()
            ],
        }

    def swing(self, effects: list[Effect]) -> float:
        """Return the largest difference among a factor's values and the baseline."""
        values = [self.baseline, *(e.value for e in effects if e.value is not None)]
        return max(values) - min(values)


def tornado_of(
    number: Number, bodies: str, baseline: Row, runs: Iterable[tuple[Setting, Row]]
) -> Tornado | None:
    """Return what the settings make of a number; None if the baseline run did not get there.

    Args:
        number: the published one.
        bodies: of the runs.
        baseline: row of the run that nothing is changed in.
        runs: every setting with the row of its run.
    """
    value = observed(baseline, number.measure, OBSERVED)
    if value is None:
        return None
    return Tornado(
        number,
        bodies,
        published_value(number),
        value,
        tuple(
            Effect(
                setting.factor,
                setting.label,
                observed(row, number.measure, setting.model or OBSERVED, whole=setting.whole_run),
                row["status"],
            )
            for setting, row in runs
        ),
    )
