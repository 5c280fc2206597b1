"""Fatigue life of flexible bodies: rainflow cycles of their stress, an S-N curve, Miner's sum."""

from collections.abc import Callable, Sequence

import numpy as np

from exu_press.quantities.acceleration import peak
from exu_press.quantities.kind import LOAD, MOTION
from exu_press.quantities.quantity import Extreme, Owner, Quantity
from exu_press.quantities.reading import Reading
from exu_press.scene import Flexible, Scene
from exu_press.scene.bodies import require_rainflow

__all__ = ["BODIES", "damage"]


def _is_flexible(scene: Scene, body: str) -> bool:
    return body in scene.bodies


def _has_sn_curve(scene: Scene, body: str) -> bool:
    return body in scene.bodies and scene.bodies[body].sn_stress is not None


def _peak_stress(run: Reading, body: str) -> float | None:
    stress = run.channel(f"{body}_stress")
    return None if stress is None else peak(stress)


def _of_cycles(
    read: Callable[[list[tuple[float, float]], int, Flexible], float | None],
) -> Callable[[Reading, str], float | None]:
    """Return a reader of the cycles of a body's stress in the last whole revolutions.

    Cycles of the stress at the most stressed place are counted by ASTM E1049-85, as of a history
    that repeats: from its largest value on. Its first instant is its last one, and counts once.
    The cycles' mean is not regarded, and no amplitude is too small to count (elementary Miner's
    rule).

    Args:
        read: of (amplitude, Pa, number) of the cycles, the number of revolutions and the body.
    """

    def value(run: Reading, body: str) -> float | None:
        stress = run.channel(f"{body}_stress")
        if run.whole is None or stress is None:
            return None
        stress = stress[run.time > run.whole]
        first = int(np.argmax(stress))
        cycles = require_rainflow().extract_cycles([*stress[first:], *stress[: first + 1]])
        amplitudes = [(0.5 * width, count) for width, _, count, *_ in cycles]
        return read(amplitudes, run.revolutions, run.result.scene.bodies[body])

    return value


def _life(cycles: list[tuple[float, float]], revolutions: int, body: Flexible) -> float | None:
    taken = damage(cycles, body)
    return revolutions / taken if taken else None


BODIES = (
    Quantity("peak_stress", "Pa", "largest von Mises stress of the flexible body",
             LOAD, _peak_stress, Owner.BODY, _is_flexible,
             title="von Mises stress, max", display_unit="MPa", extreme=Extreme.LARGEST),
    Quantity("fatigue.largest_amplitude", "Pa", "largest amplitude of the stress cycles",
             LOAD,
             _of_cycles(lambda cycles, _, __: max((width for width, _ in cycles), default=0.0)),
             Owner.BODY, _has_sn_curve),
    Quantity("fatigue.cycles", "", "number of stress cycles a revolution",
             MOTION,
             _of_cycles(lambda cycles, turns, _: float(sum(count for _, count in cycles)) / turns),
             Owner.BODY, _has_sn_curve),
    Quantity("fatigue.damage", "", "Miner's sum a revolution, 1 at the end of life",
             MOTION, _of_cycles(lambda cycles, turns, body: damage(cycles, body) / turns),
             Owner.BODY, _has_sn_curve),
    Quantity("fatigue.life", "", "revolutions until Miner's sum is 1",
             MOTION, _of_cycles(_life), Owner.BODY, _has_sn_curve,
             title="life, revolutions"),
)  # fmt: skip


def damage(cycles: Sequence[tuple[float, float]], body: Flexible) -> float:
    """Return Miner's sum of (amplitude in Pa, number) over the S-N curve, 1 at the end of life.

    >>> line = Flexible("linkage", sn_stress=1e8, sn_cycles=1e6, sn_slope=5.0)
    >>> damage([(1e8, 1e6)], line), damage([(2e8, 1e6)], line)
    (1.0, 32.0)
    """
    assert body.sn_stress is not None
    amplitudes, numbers = np.array(cycles, dtype=float).reshape(-1, 2).T
    relative = (amplitudes / body.sn_stress) ** body.sn_slope
    return float((numbers * relative).sum() / body.sn_cycles)
