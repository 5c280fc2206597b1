"""The clearance to choose at a speed and a load: acceleration against losses, and the trade-off.

Wider balls make impacts harder and positions worse; a narrow pin costs power in its sheared film, a
wide one in the film that the journal presses out. Acceleration and power have no price in each
other's unit; what needs none is the point of the trade-off curve where one per cent less of the one
costs one per cent more of the other: the least product. A weight says how many per cent of power
one per cent of acceleration is worth.
"""

from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np

from exu_press.scene import Scene
from exu_press.scene.applied import applied_loads
from paper.comparison import observed
from paper.readings import MODELS, OBSERVED
from paper.runs import clearance

__all__ = ["ALIKE", "SEPARATE", "WEIGHTS", "Choice", "Point", "choose", "point_of", "scenes_of"]

ALIKE = (1e-5, 2.5e-5, 5e-5, 1e-4, 1.5e-4, 2e-4, 3e-4, 4e-4, 6e-4, 8e-4)
"""Radial clearance of pin and balls alike, as in the paper, m."""

SEPARATE = (1e-5, 2e-5, 5e-5, 1e-4, 2e-4, 4e-4, 8e-4)
"""Of pin and balls, every combination, m."""

WEIGHTS = (0.5, 1.0, 2.0)


@dataclass(frozen=True)
class Point:
    """One run.

    Attributes:
        pin, balls: radial clearances, m.
        acceleration: peak, m/s^2, by model of observation.
        force: largest in a ball, N.
        eccentricity_ratio: largest of the pin.
        deviation: how far the bottom dead centre lies below the ideal one, m.
        scatter: of the bottom dead centres of all strokes but the first, m; None with one alone.
        losses: W, of balls and pin.
    """

    pin: float
    balls: float
    acceleration: Mapping[str, float]
    force: float
    eccentricity_ratio: float
    deviation: float
    scatter: float | None
    losses: Mapping[str, float]

    @property
    def power(self) -> float:
        """All losses, W."""
        return sum(self.losses.values())

    def cost(self, weight: float = 1.0) -> float:
        """Return the product of power and acceleration to the power of the weight."""
        return float(self.power * self.acceleration[OBSERVED] ** weight)


@dataclass(frozen=True)
class Choice:
    """What the study found.

    Attributes:
        alike: points with one clearance for pin and balls, increasing; bodies as `bodies` says.
        separate: points of every combination, rigid bodies.
        bodies: of `alike`.
        speed_rpm, force: of what they were found at; the blanking force in N.
        best: of `alike`, by weight, m.
        best_separate: (pin, balls) of `separate`, by weight, m.
        stopped: pin and ball clearance (m) and reason of runs that did not get to their end.
    """

    alike: tuple[Point, ...]
    separate: tuple[Point, ...]
    bodies: str
    speed_rpm: float
    force: float
    best: Mapping[float, float | None]
    best_separate: Mapping[float, tuple[float, float] | None]
    stopped: tuple[tuple[float, float, str], ...] = ()

    def to_dict(self) -> dict[str, Any]:
        """Return the entries of clearance.json."""
        return {
            "speed_rpm": self.speed_rpm,
            "blanking_force": self.force,
            "bodies": self.bodies,
            "criterion": "least losses times peak acceleration (mean over 1 ms) to the weight",
            "best": [{"weight": w, "clearance": c} for w, c in self.best.items()],
            "best_separate": [
                {"weight": w, "pin": pair and pair[0], "balls": pair and pair[1]}
                for w, pair in self.best_separate.items()
            ],
            "stopped": [
                {"pin": pin, "balls": balls, "reason": reason}
                for pin, balls, reason in self.stopped
            ],
            "alike": [asdict(point) | {"power": point.power} for point in self.alike],
            "separate": [asdict(point) | {"power": point.power} for point in self.separate],
        }


def scenes_of(
    scene: Scene, alike: Sequence[float], separate: Sequence[float], revolutions: float
) -> tuple[list[Scene], list[Scene]]:
    """Return scenes with one clearance for all joints, and rigid ones with every combination.

    Args:
        scene: what the clearance is chosen for.
        alike: clearances, m.
        separate: clearances of pin and balls, m.
        revolutions: length of the rigid runs, several strokes for the scatter.
    """
    rigid = scene.replace({"bodies": {}, "revolutions": revolutions})
    return (
        [clearance(scene, radial) for radial in alike],
        [
            rigid.replace({"joints.crank_pin.clearance": pin, "joints.balls.clearance": balls})
            for pin in separate
            for balls in separate
        ],
    )


def clearances_of(scene: Scene) -> tuple[float, float]:
    """Return the radial clearances of the crank pin and of the balls, m."""
    return scene.joints["crank_pin"].clearance, scene.joints["ball_left"].clearance


def point_of(scene: Scene, row: Mapping[str, Any]) -> Point | None:
    """Return what a run says; None where it did not get to its end."""
    readings = row.get("readings")
    if not readings:
        return None
    pin, balls = clearances_of(scene)
    deviation = observed(row, "bottom_dead_centre", OBSERVED)
    assert deviation is not None
    strokes = readings["bottom_dead_centres"][1:]
    return Point(
        pin=pin,
        balls=balls,
        acceleration={model: readings["peak_acceleration"][model] for model in MODELS},
        force=max(joint["peak_force"] for n, joint in readings["joints"].items() if "ball" in n),
        eccentricity_ratio=readings["joints"]["crank_pin"]["max_eccentricity_ratio"],
        deviation=deviation,
        scatter=max(strokes) - min(strokes) if len(strokes) > 1 else None,
        losses=readings["losses"],
    )


def choose(
    scene: Scene,
    alike: Sequence[Point],
    separate: Sequence[Point],
    stopped: Sequence[tuple[float, float, str]] = (),
) -> Choice:
    """Return the clearances of least cost for each of WEIGHTS; the arguments as in `Choice`."""
    apart = {w: _cheapest(separate, w) for w in WEIGHTS}
    return Choice(
        alike=tuple(alike),
        separate=tuple(separate),
        bodies="flexible" if scene.bodies else "rigid",
        speed_rpm=scene.speed_rpm,
        force=max((load.curve.peak for load in applied_loads(scene).values()), default=0.0),
        best={w: _least(alike, w) for w in WEIGHTS},
        best_separate={w: None if p is None else (p.pin, p.balls) for w, p in apart.items()},
        stopped=tuple(stopped),
    )


def _cheapest(points: Sequence[Point], weight: float) -> Point | None:
    return min(points, key=lambda point: point.cost(weight), default=None)


def _least(points: Sequence[Point], weight: float) -> float | None:
    """Return the clearance of least cost, m: the least of a parabola through the three nearest.

    In logarithms, in which costs are nearly parabolas. At an end of the range it is the end.
    """
    if not points:
        return None
    size = np.log([point.balls for point in points])
    cost = np.log([point.cost(weight) for point in points])
    least = int(np.argmin(cost))
    if least in (0, len(points) - 1):
        return points[least].balls
    near = slice(least - 1, least + 2)
    bend, slope, _ = np.polyfit(size[near] - size[least], cost[near], 2)
    return float(np.exp(size[least] - slope / (2.0 * bend)))
