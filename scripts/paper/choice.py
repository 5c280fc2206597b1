"""The clearance to choose at a speed and a load: acceleration against losses.

Wider balls make impacts harder and positions worse; a narrow pin costs power in its sheared film, a
wide one in the film that the journal presses out. Acceleration and power have no price in each
other's unit; what needs none is the point where one per cent less of the one costs one per cent
more of the other: the least product. A weight says how many per cent of power one per cent of
acceleration is worth.
"""

from collections.abc import Callable, Sequence
from itertools import product as combinations

from exu_press.scene import Scene
from paper.readings import OBSERVED
from paper.runs import rigid_twin
from paper.value import Value, product

__all__ = ["LINE", "MAP", "WEIGHTS", "cost", "least", "radii", "separate"]

LINE = (1e-5, 2.5e-5, 5e-5, 1e-4, 1.5e-4, 2e-4, 2.5e-4, 3e-4, 3.5e-4, 4e-4, 6e-4, 8e-4)
"""Radial clearance of pin and balls alike, as in the paper, m."""

MAP = (1e-5, 5e-5, 1e-4, 2e-4, 4e-4)
"""Of pin and balls, every combination, m."""

WEIGHTS = (0.5, 1.0, 2.0)

Measure = Callable[[Scene, str], Value | None]


def separate(scene: Scene, radii: Sequence[float]) -> list[Scene]:
    """Return rigid scenes with every combination of clearances (m) of pin and balls."""
    return [
        rigid_twin(scene).replace({"joints.crank_pin.clearance": a, "joints.balls.clearance": b})
        for a, b in combinations(radii, radii)
    ]


def radii(scene: Scene) -> tuple[float, float]:
    """Return the radial clearances of pin and balls, m."""
    return scene.joints["crank_pin"].clearance, scene.joints["ball_left"].clearance


def cost(of: Measure, scene: Scene, weight: float = 1.0) -> Value | None:
    """Return the product of the power lost and the peak acceleration to the weight."""
    power, peak = of(scene, "power"), of(scene, f"peak_acceleration.{OBSERVED}")
    return None if power is None or peak is None else product(power, peak, weight)


def least(of: Measure, line: Sequence[Scene], weight: float) -> Value | None:
    """Return the clearance of least cost, m, between the neighbours of those that it may be.

    It may be each whose cost may be as low as the least; with one least cost, it lies between the
    neighbours of these.

    Args:
        of: returns a measure of a scene.
        line: scenes of increasing clearance.
        weight: of the acceleration.
    """
    found = [(radii(scene)[1], value) for scene in line if (value := cost(of, scene, weight))]
    if not found:
        return None
    sizes = [size for size, _ in found]
    most = min(value.high for _, value in found)
    may_be = [place for place, (_, value) in enumerate(found) if value.low <= most]
    best = min(found, key=lambda each: each[1].value)[0]
    return Value(
        best, sizes[max(may_be[0] - 1, 0)], sizes[min(may_be[-1] + 1, len(sizes) - 1)], False
    )
