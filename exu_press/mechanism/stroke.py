"""The output over one revolution: stroke, dead centres, velocity, mechanical advantage."""

import math
from dataclasses import dataclass

import numpy as np

from exu_press.mechanism.mechanism import Mechanism
from exu_press.numerics.arrays import Array

__all__ = ["DeadCentre", "OutputUnits", "Stroke", "stroke_of", "units_of_output"]

STEPS = 1440
"""Crank angles of a revolution; dead centres are searched between two of them."""

REST = 1e-9
"""Velocity, relative to its peak, below which the output stands still."""


@dataclass(frozen=True)
class OutputUnits:
    """Units in which drawings show an output, and factors from those of SI.

    Attributes:
        position: name of its unit.
        position_scale: from m or rad.
        velocity: of its velocity per angular velocity of the crank.
        velocity_scale: from m/rad or rad/rad.
        speed: of its velocity, SI.
        advantage: of the mechanical advantage.
        ratio: what the mechanical advantage is.
    """

    position: str
    position_scale: float
    velocity: str
    velocity_scale: float
    speed: str
    advantage: str
    ratio: str


DISPLACEMENT = OutputUnits("mm", 1e3, "mm/rad", 1e3, "m/s", "N per N m", "force per torque, 1/m")
ROTATION = OutputUnits(
    "deg", math.degrees(1.0), "rad/rad", 1.0, "rad/s", "N m per N m", "torque per torque"
)


def units_of_output(mechanism: Mechanism) -> OutputUnits:
    """Return the units of a mechanism's output."""
    return ROTATION if mechanism.output.rotation else DISPLACEMENT


@dataclass(frozen=True)
class DeadCentre:
    """A position in which the output reverses.

    Attributes:
        angle: of the crank from the drawing, rad, to rounding.
        position: of the output, m or rad.
        top: whether it is a largest position, else a smallest one.
    """

    angle: float
    position: float
    top: bool


@dataclass(frozen=True)
class Stroke:
    """The ideal output over a revolution; arrays over n crank angles.

    Attributes:
        angle: of the crank from the drawing, (n,), rad.
        position: of the output, (n,), m or rad.
        velocity: per angular velocity of the crank, (n,), m/rad or rad/rad.
        dead_centres: in the order of their crank angles.
        peak_angle: of the crank at the largest velocity, rad, to 1e-5.
        peak_velocity: magnitude there, m/rad or rad/rad, to rounding.
    """

    angle: Array
    position: Array
    velocity: Array
    dead_centres: tuple[DeadCentre, ...]
    peak_angle: float
    peak_velocity: float

    @property
    def length(self) -> float:
        """Distance of the largest and the smallest position, m."""
        ends = [centre.position for centre in self.dead_centres]
        return max([*ends, float(self.position.max())]) - min([*ends, float(self.position.min())])

    @property
    def mechanical_advantage(self) -> Array:
        """Force of the output per torque of the crank without losses, omega / |v|, (n,), 1/m.

        Power in is power out, T omega = F v. It is infinite in dead centres.
        """
        speed = np.abs(self.velocity)
        with np.errstate(divide="ignore"):
            return np.asarray(np.where(speed > REST * speed.max(), 1.0 / speed, np.inf))


def stroke_of(mechanism: Mechanism, angle: Array) -> Stroke:
    """Return the ideal output for crank angles (n,), rad, and its dead centres of a revolution.

    Raises:
        InputError: the crank does not turn through a revolution.
    """
    position, velocity, _ = mechanism.ideal_slider(angle, 1.0)
    peak = _peak_velocity(mechanism)
    return Stroke(angle, position, velocity, _dead_centres(mechanism), *peak)


def _peak_velocity(mechanism: Mechanism) -> tuple[float, float]:
    """Return the crank angle and the magnitude of the largest velocity, on ever finer grids."""
    angle = np.arange(STEPS) * 2.0 * np.pi / STEPS
    step = angle[1]
    while True:
        speed = np.abs(mechanism.ideal_slider(angle, 1.0)[1])
        largest = int(speed.argmax())
        if step < 1e-5:
            return float(angle[largest]) % (2.0 * np.pi), float(speed[largest])
        angle = angle[largest] + np.linspace(-step, step, 21)
        step *= 0.1


def _dead_centres(mechanism: Mechanism) -> tuple[DeadCentre, ...]:
    """Return the sign changes of the output's velocity, by bisection."""
    angle = (np.arange(STEPS + 1) - 0.5) * 2.0 * np.pi / STEPS
    _, velocity, _ = mechanism.ideal_slider(angle, 1.0)
    moving = np.flatnonzero(np.abs(velocity) > REST * np.abs(velocity).max())
    if not len(moving):
        return ()
    signs = np.sign(velocity[moving])
    change = np.flatnonzero(signs[1:] != signs[:-1])
    if not len(change):
        return ()
    low, high, sign = angle[moving[change]], angle[moving[change + 1]], signs[change]
    for _ in range(50):
        middle = 0.5 * (low + high)
        same = np.sign(mechanism.ideal_slider(middle, 1.0)[1]) == sign
        low, high = np.where(same, middle, low), np.where(same, high, middle)
    roots = 0.5 * (low + high)
    roots = np.where(np.abs(np.sin(0.5 * roots)) < 1e-12, 0.0, roots % (2.0 * np.pi))
    position = mechanism.ideal_slider(roots, 1.0)[0]
    centres = [
        DeadCentre(float(a), float(p), bool(up > 0.0))
        for a, p, up in zip(roots, position, sign, strict=True)
    ]
    return tuple(sorted(centres, key=lambda centre: centre.angle))
