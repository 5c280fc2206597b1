"""How long flexible bodies last: rainflow cycles of their stress, a Woehler line, Miner's sum."""

import math
from collections.abc import Sequence

import numpy as np

from exu_press.observe.press import begin_of_whole_revolutions
from exu_press.result import Result
from exu_press.scene import Flexible
from exu_press.scene.bodies import require_rainflow

__all__ = ["damage", "fatigue_summary"]


def fatigue_summary(result: Result) -> dict[str, dict[str, float | None]]:
    """Return what the last whole revolutions take of the life of each body with a Woehler line.

    Cycles of the stress at the most stressed place are counted by ASTM E1049-85, as of a history
    that repeats: from its largest value on. Their mean is not regarded, and no amplitude is too
    small to count (elementary Miner's rule).
    """
    found: dict[str, dict[str, float | None]] = {}
    begin = begin_of_whole_revolutions(result)
    for name, body in result.scene.bodies.items():
        if body.woehler_stress is None or f"{name}_stress" not in result or begin is None:
            continue
        rainflow = require_rainflow()
        inside = result.time >= begin
        angle = result["crank_angle"][inside]
        revolutions = float(angle[-1] - angle[0]) / (2.0 * math.pi)
        stress = result[f"{name}_stress"][inside]
        first = int(np.argmax(stress))
        repeated = [*stress[first:], *stress[: first + 1]]
        cycles = list(rainflow.extract_cycles(repeated))
        taken = damage([(0.5 * width, count) for width, _, count, *_ in cycles], body)
        found[name] = {
            "largest_amplitude": max((0.5 * width for width, *_ in cycles), default=0.0),
            "cycles": float(sum(count for _, _, count, *_ in cycles)) / revolutions,
            "damage": taken / revolutions,
            "life": revolutions / taken if taken else None,
        }
    return found


def damage(cycles: Sequence[tuple[float, float]], body: Flexible) -> float:
    """Return Miner's sum of (amplitude in Pa, number) over the Woehler line, 1 at the end of life.

    >>> line = Flexible("linkage", woehler_stress=1e8, woehler_cycles=1e6, woehler_slope=5.0)
    >>> damage([(1e8, 1e6)], line), damage([(2e8, 1e6)], line)
    (1.0, 32.0)
    """
    assert body.woehler_stress is not None
    amplitudes, numbers = np.array(cycles, dtype=float).reshape(-1, 2).T
    relative = (amplitudes / body.woehler_stress) ** body.woehler_slope
    return float((numbers * relative).sum() / body.woehler_cycles)
