"""The scenes that are judged: a table's, or a user's one pushed to its extremes key by key."""

from dataclasses import dataclass

from exu_press.errors import InputError
from exu_press.scene import Scene
from exu_press.schema.csv_table import flat

__all__ = ["FACTORS", "PAIRS", "Case", "extremes"]

PAIRS = "pairs of extremes"
"""The axis of those cases that are at the end of two axes at once."""

FACTORS = (1e-3, 1e-2, 0.1, 10.0, 100.0, 1e3)
"""Times the scene's value; one that a scene refuses is left out."""

NOT_PUSHED = {
    *("mechanism", "revolutions", "start_angle_deg", "gravity", "press", "slider_crank"),
    *("solver.min_step", "solver.max_step_deg"),
}
"""Keys and tables that make another mechanism or task, and bounds of the step control."""

AS_IT_IS = "as it is"

BUDGET = 50_000
"""Most steps of a case, unless the scene allows fewer: it then stops, and says so."""


@dataclass(frozen=True)
class Case:
    """One scene of a table.

    Attributes:
        name: unique.
        axis: key or choice that is varied.
        value: in words, as the map shows it; of a pair, the two.
    """

    name: str
    axis: str
    value: str
    scene: Scene


def extremes(scene: Scene, name: str) -> tuple[Case, ...]:
    """Return the scene as it is, then with every number that it uses times each of FACTORS."""
    scene = scene.replace({"solver.max_steps": min(scene.solver.max_steps, BUDGET)})
    cases = [Case(f"{AS_IT_IS}, {name}", AS_IT_IS, AS_IT_IS, scene)]
    for key, value in flat(scene.to_dict()).items():
        is_fixed = {key, key.partition(".")[0]} & NOT_PUSHED
        if is_fixed or not isinstance(value, float) or value == 0.0:
            continue
        for factor in FACTORS:
            try:
                pushed = scene.replace({key: factor * value})
            except InputError:
                continue
            label = f"{factor * value:.3g}"
            cases.append(Case(f"{key} = {label}, {name}", key, label, pushed))
    return tuple(cases)
