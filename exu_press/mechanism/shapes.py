"""Outlines of a mechanism's bodies as seen from the front, and what stands still behind them.

Outlines are drawn, not measured: links have one width, blocks grow with the cube root of their
mass. Only the joints' positions are the mechanism's.
"""

import math
from dataclasses import dataclass

import numpy as np

from exu_press.mechanism.guide_motion import guide_path
from exu_press.mechanism.mechanism import Mechanism
from exu_press.mechanism.parts import GROUND, Guide
from exu_press.mechanism.pitch_circles import pitch_circles
from exu_press.mechanism.slots import slot_outline
from exu_press.mechanism.spring_motion import spring_ends
from exu_press.numerics.arrays import Array

__all__ = [
    "COLOURS",
    "FrontView",
    "Mark",
    "Shape",
    "rail_corners",
    "shapes_of",
    "swept_points",
    "transform_points",
]

COLOURS = {
    "crank": "#F2C14E",
    "bearing": "#8FC1E3",
    "link": "#C3D0DA",
    "block": "#DADFE3",
    "slide": "#DADFE3",
}
"""By role; "bearing" is the body on the pin that is farthest from the crank's shaft."""

ROD = 0.011
"""Half the width of a link, relative to the mechanism's height."""

BLOCK = 0.07
"""Margin of the heaviest block around its joints, relative to the mechanism's height."""

SLOT = 0.008
"""Half the width of a slot, relative to the mechanism's height."""

LEVEL = 1e-6
"""Slope below which a direction is horizontal."""

CORNERS = 48
"""Corners of a link's outline, most of them at its round ends."""

REVOLUTION = np.linspace(0.0, 2.0 * np.pi, 73)
"""Crank angles of a revolution, rad, of which outlines are drawn."""


@dataclass(frozen=True)
class Shape:
    """A body's outline in its own frame, m.

    Attributes:
        outline: (n, 2) corners of a polygon, counter-clockwise.
        slots: corners of its slots, (m, 2) each.
        role: "crank", "bearing", "link", "block" in the frame, or "slide" in a moving
            guide.
    """

    outline: Array
    role: str
    slots: tuple[Array, ...] = ()

    @property
    def colour(self) -> str:
        """Its fill."""
        return COLOURS[self.role]

    def outline_at(self, pose: Array) -> Array:
        """Return the outline (n, 2) for a pose (x, y, angle)."""
        return transform_points(self.outline, pose)


def shapes_of(mechanism: Mechanism, height: float | None = None) -> dict[str, Shape]:
    """Return every body's shape by name; the height, m, is that of a revolution unless given."""
    if height is None:
        height = float(np.ptp(swept_points(mechanism)[:, 1]))
    guides = {guide.body: guide for guide in mechanism.guides if not guide.is_slot}
    heaviest = max(body.mass for body in mechanism.bodies)
    shapes = {}
    for body in mechanism.bodies:
        points = np.array(mechanism.points(body.name) or [(0.0, 0.0)])
        paths = [
            np.array([body.local(point) for point in path])
            for path in _guide_paths(mechanism, body.name, height)
        ]
        if body.name in guides:
            points = np.vstack([points, *paths])
            margin = BLOCK * height * float(np.cbrt(body.mass / heaviest))
            x, y = guides[body.name].direction
            turn = 0.0 if guides[body.name].is_rail else math.atan2(y, x) - body.angle
            pose = np.array([0.0, 0.0, turn])
            outline = transform_points(_block(transform_points(points, -pose), margin), pose)
        else:
            margin = ROD * height * (1.6 if body.name == mechanism.crank else 1.0)
            outline = _link(np.vstack([points, *paths]), margin)
        slots = tuple(
            np.array([body.local(point) for point in corners])
            for corners in slot_outlines(mechanism, body.name, height)
        )
        shapes[body.name] = Shape(outline, _role(mechanism, body.name), slots)
    return shapes


def slot_outlines(mechanism: Mechanism, body: str, height: float) -> list[Array]:
    """Return the corners (m, 2) in the drawing of the slots of a body, or of the frame."""
    return [
        slot_outline(mechanism, guide, REVOLUTION, SLOT * height)
        for guide in mechanism.guides
        if guide.is_slot and guide.on == body
    ]


def _guide_paths(mechanism: Mechanism, body: str, height: float) -> list[Array]:
    """Return the paths (n, 2) in the drawing of what slides on a body, and corners of its slots."""
    paths = [
        guide_path(mechanism, guide, REVOLUTION)
        for guide in mechanism.guides
        if guide.on == body and not guide.is_slot
    ]
    return paths + slot_outlines(mechanism, body, height)


def swept_points(mechanism: Mechanism) -> Array:
    """Return the joints' positions (n, 2) over a revolution of the ideal mechanism, m."""
    motion = mechanism.motion(REVOLUTION, 1.0)
    points = {body.name: np.array(mechanism.points(body.name)) for body in mechanism.bodies}
    return np.vstack(
        [
            transform_points(local, pose)
            for name, local in points.items()
            if len(local)
            for pose in motion[name].position
        ]
    )


def transform_points(points: Array, pose: Array) -> Array:
    """Return points (n, 2) of a body's frame for a pose (x, y, angle) of the body."""
    c, s = np.cos(pose[2]), np.sin(pose[2])
    return np.asarray(points @ np.array([[c, s], [-s, c]]) + pose[:2])


def rail_corners(guide: Guide, outline: Array, unit: float) -> list[Array]:
    """Return the corners (4, 2) of the rails on both sides of a body in its guide.

    The outlines (n, 2) are those over a revolution; the unit is the drawing's size, m.
    """
    gap, width = 0.004 * unit, 0.008 * unit
    axes = np.array([guide.normal, guide.direction])
    (left_edge, low), (right_edge, high) = (
        end(outline @ axes.T, axis=0) for end in (np.min, np.max)
    )
    return [
        np.array([[edge, low], [edge + width, low], [edge + width, high], [edge, high]]) @ axes
        for edge in (left_edge - gap - width, right_edge + gap)
    ]


@dataclass(frozen=True)
class Mark:
    """The mark of a dead centre beside the slider, at the edge that leads upwards.

    Attributes:
        label: "TDC" or "BDC".
        position: at the side of the slider's outline, m.
        direction: unit vector away from the slider: to the left, or downwards.
        is_above: whether the mark of the opposite dead centre lies below.
    """

    label: str
    position: Array
    direction: Array
    is_above: bool


class FrontView:
    """A mechanism from the front over a revolution, as animation and page show it.

    Attributes:
        shapes: name of a body -> its shape.
        swept: name of a body -> its outlines over a revolution of the ideal mechanism, (n, 2), m.
        low: least x and y of them, of springs and of pitch circles, m.
        high: largest x and y of these, m.
        unit: of labels and pins, m: the larger of height and width.
    """

    def __init__(self, mechanism: Mechanism) -> None:
        self._mechanism = mechanism
        self.shapes = shapes_of(mechanism)
        motion = mechanism.motion(REVOLUTION, 1.0)
        self.swept = {
            name: np.vstack([shape.outline_at(pose) for pose in motion[name].position])
            for name, shape in self.shapes.items()
        }
        spring_paths = [
            transform_points(np.array([point]), pose)
            for spring in mechanism.springs
            for body, point in spring_ends(mechanism, spring)
            for pose in (motion[body].position if body in motion else np.zeros((1, 3)))
        ]
        corners = np.vstack([*self.swept.values(), *pitch_circles(mechanism), *spring_paths])
        self.low, self.high = corners.min(axis=0), corners.max(axis=0)
        self.unit = float((self.high - self.low).max())

    def layer(self, body: str) -> int:
        """Return a body's layer: the slider, other blocks, links, and in front crank and slides."""
        if body == self._mechanism.slider:
            return -1
        return {"block": 0, "slide": 2, "crank": 2}.get(self.shapes[body].role, 1)

    def rails(self) -> list[Array]:
        """Return the corners (4, 2) of the frame's rails beside its bodies, and of its slots."""
        return slot_outlines(self._mechanism, GROUND, self.unit) + [
            corners
            for guide in self._mechanism.guides
            if guide.is_rail
            for corners in rail_corners(guide, self.swept[guide.body], self.unit)
        ]

    def dead_centres(self) -> list[Mark]:
        """Return the marks of the slider's ideal dead centres, none where it has none."""
        mechanism = self._mechanism
        if mechanism.dead_centres is None or mechanism.output.rotation:
            return []
        motion = mechanism.motion(np.linspace(0.0, 2.0 * np.pi, 721), 1.0)[mechanism.slider]
        outline, along = self.swept[mechanism.slider], np.array(mechanism.output.direction)
        sideways = np.array([-along[1], along[0]])
        if sideways @ (1.0, LEVEL) > 0.0:
            sideways = -sideways
        heights = motion.position[:, :2] @ along
        edge = (outline @ along).max() - heights.max()
        side = (outline @ sideways).max() * sideways
        return [
            Mark(label, (height + edge) * along + side, sideways, bool(upwards > LEVEL))
            for label, height, upwards in (
                ("TDC", heights.max(), along[1]),
                ("BDC", heights.min(), -along[1]),
            )
        ]


def _role(mechanism: Mechanism, body: str) -> str:
    if body == mechanism.crank:
        return "crank"
    guides = [guide for guide in mechanism.guides if guide.body == body and not guide.is_slot]
    if guides:
        return "block" if any(guide.is_rail for guide in guides) else "slide"
    if not mechanism.crank_pins:
        return "link"
    pin = max(mechanism.crank_pins, key=mechanism.crank_pins.__getitem__)
    on_pin = any(joint.name == pin for joint in mechanism.joints_of(body))
    return "bearing" if on_pin else "link"


def _block(points: Array, margin: float) -> Array:
    (x_min, y_min), (x_max, y_max) = points.min(axis=0) - margin, points.max(axis=0) + margin
    return np.array([[x_min, y_min], [x_max, y_min], [x_max, y_max], [x_min, y_max]])


def _link(points: Array, half_width: float) -> Array:
    """Return an outline around all joints of a body, round at each: a rod where there are two."""
    angle = np.linspace(0.0, 2.0 * np.pi, CORNERS, endpoint=False)
    outwards = np.column_stack([np.cos(angle), np.sin(angle)])
    size = half_width if len(points) > 1 else 2.0 * half_width
    return np.asarray(points[np.argmax(outwards @ points.T, axis=1)] + size * outwards)
