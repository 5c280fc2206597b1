"""Costs of a run."""

from exu_press.quantities.kind import COST
from exu_press.quantities.quantity import Quantity
from exu_press.quantities.reading import Reading

__all__ = ["COSTS"]


def _statistic(
    name: str,
    meaning: str,
    unit: str = "",
    title: str = "",
    digits: int = 7,
    is_detail: bool = False,
) -> Quantity:
    def read(run: Reading, _: str) -> float | int | None:
        value = run.result.info.get(name)
        return value if isinstance(value, (int, float)) else None

    return Quantity(
        f"cost.{name}", unit, meaning, COST, read, title=title, digits=digits, is_detail=is_detail
    )


COSTS = (
    _statistic("steps", "accepted steps", title="steps"),
    _statistic(
        "rejected_steps", "steps repeated with a smaller size", title="rejected", is_detail=True
    ),
    _statistic("newton_iterations", "Newton iterations of all steps"),
    _statistic("law_evaluations", "evaluations of the clearance joints' forces"),
    _statistic("coordinates", "coordinates of the model"),
    _statistic("bodies", "bodies of the model"),
    _statistic("connectors", "connectors of the model"),
    _statistic("wall_time", "time of the integration alone", "s", "wall time", 3),
    _statistic("total_time", "time with building the model and recording", "s"),
)
