"""A planar mechanism as plain data: bodies, joints and guides in one assembled drawing."""

import math
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import combinations
from typing import Any

import numpy as np

from exu_press.mechanism.drawing import Drawing, require_kind
from exu_press.mechanism.gears import Gear
from exu_press.mechanism.kinematics import kinematics_of
from exu_press.mechanism.motion import Motion
from exu_press.mechanism.parts import FRAME, Body, Guide, Joint, Output, Point
from exu_press.mechanism.planar_constraints import PlanarConstraints, planar_constraints
from exu_press.mechanism.springs import SpringBetween
from exu_press.numerics.arrays import Array

__all__ = ["Mechanism"]


@dataclass(frozen=True)
class Mechanism(Drawing):
    """A drawing whose crank turns, with the motion of its bodies; attributes as of `Drawing`.

    Raises:
        InputError: names are used twice or unknown, a body has no mass, or the like.
            `exu_press.mechanism.turning` checks whether the crank turns.
    """

    def __post_init__(self) -> None:
        """Check the drawing, fill in the inertia of uniform rods, make directions unit vectors."""
        self._assign(
            bodies=require_kind(Body, "bodies", self.bodies),
            joints=require_kind(Joint, "joints", self.joints),
            guides=require_kind(Guide, "guides", self.guides),
            output=require_kind(Output, "output", [self.output])[0],
            gears=tuple(
                replace(gear, to=gear.to or self.crank)
                for gear in require_kind(Gear, "gears", self.gears)
            ),
            springs=require_kind(SpringBetween, "springs", self.springs),
        )
        self.check()
        self._assign(
            counterweight=tuple(self.counterweight),
            bodies=tuple(
                replace(body, inertia=self.rod_inertia(body)) if math.isnan(body.inertia) else body
                for body in self.bodies
            ),
            guides=tuple(replace(g, direction=_unit(_direction(g))) for g in self.guides),
            output=replace(self.output, direction=_unit(self.output.direction)),
        )

    def _assign(self, **values: Any) -> None:
        for name, value in values.items():
            object.__setattr__(self, name, value)

    def _repr_html_(self) -> str:
        """Return the drawing, for notebooks."""
        from exu_press import cell

        return cell(self)

    def rod_inertia(self, body: Body) -> float:
        """Return m l^2 / 12 of a uniform rod between a body's joints; nan unless at two points."""
        ends = self.held_points(body.name)
        return body.mass * math.dist(*ends) ** 2 / 12 if len(ends) == 2 else math.nan

    @property
    def slider(self) -> str:
        """Name of the output's body."""
        return self.output.body

    @property
    def shaft(self) -> Joint:
        """The crank's joint with the frame."""
        return next(joint for joint in self.joints_of(self.crank) if joint.on_frame)

    @property
    def crank_pins(self) -> dict[str, float]:
        """Joints of the crank with other bodies -> distance from its shaft, m."""
        shaft, joints = self.shaft, self.joints_of(self.crank)
        return {j.name: math.dist(shaft.at, j.at) for j in joints if j is not shaft}

    @property
    def crank_radius(self) -> float:
        """Largest distance of the crank's pins from its shaft, m.

        Where it has none, the largest one of two pins of a body that it turns by a gear, times the
        ratio; else the size of the drawing.
        """
        slots = [g.at for g in self.guides if g.body == self.crank and g.at is not None]
        pins = [*self.crank_pins.values(), *(math.dist(self.shaft.at, at) for at in slots)]
        geared = (
            abs(gear.ratio) * math.dist(*ends)
            for gear in self.gears
            if gear.to == self.crank
            for ends in combinations(self.held_points(gear.body), 2)
        )
        return max(pins or geared, default=self.size)

    def body(self, name: str) -> Body:
        """Return a body by its name, also the frame."""
        return next(body for body in (*self.bodies, FRAME) if body.name == name)

    def guide(self, name: str) -> Guide:
        """Return a guide by its name."""
        return next(guide for guide in self.guides if guide.name == name)

    def frame_guide(self, body: str) -> Guide | None:
        """Return the guide of the frame that holds a body, or None."""
        return next((g for g in self.guides if g.body == body and g.is_rail), None)

    def ends(self, joint: Joint) -> tuple[tuple[str, Point], tuple[str, Point]]:
        """Return (body, point in its frame) of a joint's journal and of its bearing."""
        return self.end(joint.journal, joint.at), self.end(joint.bearing, joint.at)

    def end(self, body: str, at: Point) -> tuple[str, Point]:
        """Return a body, or the frame, and a point of the drawing in its frame."""
        return body, self.body(body).local(at)

    def points(self, body: str) -> list[Point]:
        """Return the positions of a body's joints, pins, and centre in a moving guide, m."""
        points = [point for j in self.joints for name, point in self.ends(j) if name == body]
        moving = [guide for guide in self.guides if guide.body == body and not guide.is_rail]
        return points + [self.guided_end(guide)[1] for guide in moving]

    def guided_end(self, guide: Guide) -> tuple[str, Point]:
        """Return a guided body, and in its frame its pin in a slot, or its centre."""
        return self.end(guide.body, self.guided_point(guide))

    def guided_point(self, guide: Guide) -> Point:
        """Return the pin in a slot, or the centre of a body in a guide, in the drawing."""
        return guide.at or self.body(guide.body).centre_of_mass

    def line_of(self, guide: Guide) -> tuple[Point, float]:
        """Return a guide's line in the frame of the body that has it.

        Returns:
            A point of it, or the centre of a circular slot, m, and the angle of its normal, rad.
        """
        base, (x, y) = self.body(guide.on), guide.normal
        point = base.local(guide.centre or self.guided_point(guide))
        return point, math.atan2(y, x) - base.angle

    def motion(self, angle: Array, speed: float) -> dict[str, Motion]:
        """Return the motion (x, y, angle) of every body with ideal joints, by its name.

        Args:
            angle: (n,) crank angles from the drawing's, rad.
            speed: of the crank, constant, rad/s.

        Raises:
            InputError: the mechanism has not one degree of freedom, locks or branches.
        """
        bodies = sorted(self.bodies, key=lambda body: body.name == self.crank)
        joints = [joint for joint in self.joints if joint != self.shaft]
        constraints = planar_constraints(self, bodies, joints)
        motions = kinematics_of(self.name, constraints, self.shaft.at).motion(angle, speed)
        return {body.name: motions[body.name] for body in self.bodies}

    def ideal_slider(self, angle: Array, speed: float) -> tuple[Array, Array, Array]:
        """Return position (m, or rad), velocity and acceleration of the slider, ideal joints."""
        slider = self.motion(angle, speed)[self.slider]
        return (
            self.output_position(slider.position),
            self.output_component(slider.velocity),
            self.output_component(slider.acceleration),
        )

    @cached_property
    def dead_centres(self) -> tuple[float, float] | None:
        """Crank angles of the ideal slider's top and bottom dead centre, rad, to 1e-4.

        None where there are none: the output is in no guide, or does not reverse twice.
        """
        if self.frame_guide(self.slider) is None and not self.output.rotation:
            return None
        angle = np.linspace(0.0, 2.0 * np.pi, 721)[:-1]
        position, velocity, _ = self.ideal_slider(angle, 1.0)
        up = velocity[np.abs(velocity) > 1e-9 * np.abs(velocity).max()] > 0.0
        if (up != np.roll(up, 1)).sum() != 2:
            return None
        top, bottom = (self._reversal(angle[at]) for at in (position.argmax(), position.argmin()))
        return top, bottom

    @cached_property
    def bottom(self) -> float:
        """Lowest position of the ideal output, m or rad: heights count from there."""
        angle = np.linspace(0.0, 2.0 * np.pi, 721)[:-1]
        lowest = angle[self.ideal_slider(angle, 1.0)[0].argmin()]
        return float(self.ideal_slider(np.array([self._reversal(lowest)]), 1.0)[0][0])

    @cached_property
    def stroke(self) -> float:
        """Rise of the ideal output above its lowest position, m or rad."""
        angle = np.linspace(0.0, 2.0 * np.pi, 721)
        return float(self.ideal_slider(angle, 1.0)[0].max()) - self.bottom

    def _reversal(self, angle: float) -> float:
        """Return the nearest crank angle, rad, at which the ideal output reverses."""
        for _ in range(3):
            _, rate, slope = (level[0] for level in self.ideal_slider(np.array([angle]), 1.0))
            if abs(rate) < math.radians(0.5) * abs(slope):  # nor where both are rounding
                angle -= rate / slope
        return round(float(angle), 12) % (2.0 * math.pi)

    @property
    def output_reverses(self) -> bool:
        """Whether the ideal output returns in a revolution, instead of turning around."""
        begin, end = self.ideal_slider(np.array([0.0, 2.0 * np.pi]), 1.0)[0]
        return abs(float(end - begin)) < 1.0 or not self.output.rotation

    def output_position(self, position: Array) -> Array:
        """Return the output's position (n,), m, or its angle, rad, for its body's poses (n, 3)."""
        if self.output.rotation:
            return np.asarray(position[:, 2] - self.body(self.slider).angle)
        return self.output_component(position) - float(
            np.dot(self.output.origin, self.output.direction)
        )

    def lateral_displacement(self, position: Array) -> Array:
        """Return the displacement (n,), m, of the slider's centre (n, 2 or 3) to the right."""
        drawn = self.body(self.slider).centre_of_mass
        return np.asarray((position[:, :2] - np.array(drawn)) @ np.array(self.output.normal))

    def output_component(self, vectors: Array) -> Array:
        """Return the components (n,) of vectors (n, 3) in the output's direction, or about it."""
        if self.output.rotation:
            return np.asarray(vectors[:, 2])
        return np.asarray(vectors[:, :2] @ np.array(self.output.direction))

    @cached_property
    def constraints(self) -> PlanarConstraints:
        """Constraints of all joints and guides as ideal ones, and of gears."""
        return planar_constraints(self, self.bodies, self.joints)


def _direction(guide: Guide) -> Point:
    """Return the direction of a guide, of a circular slot counter-clockwise."""
    if guide.at is None or guide.centre is None:
        return guide.direction
    return guide.centre[1] - guide.at[1], guide.at[0] - guide.centre[0]


def _unit(direction: Point) -> Point:
    length = math.hypot(*direction)
    return direction[0] / length, direction[1] / length
