"""Shapes of the bodies from the front: links around their joints, blocks on guides.

Drawn, not measured: links have one width, blocks grow with the cube root of their mass. Only the
joints' positions are the mechanism's.
"""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from exu_press.mechanism.mechanism import Mechanism
from exu_press.mechanism.parts import Guide
from exu_press.numerics.arrays import Array

__all__ = [
    "COLOURS",
    "Mark",
    "Shape",
    "marks",
    "moved",
    "rails",
    "shapes_of",
    "swept",
    "swept_outlines",
]

COLOURS = {"crank": "#F2C14E", "bearing": "#8FC1E3", "link": "#C3D0DA", "block": "#DADFE3"}
"""By role; "bearing" is the body on the pin that is farthest from the crank's shaft."""

ROD = 0.011
"""Half the width of a link, relative to the mechanism's height."""

BLOCK = 0.07
"""Margin of the heaviest block around its joints, relative to the mechanism's height."""

LEVEL = 1e-6
"""Slope below which a direction is horizontal."""

CORNERS = 48
"""Corners of a link's outline, most of them at its round ends."""


@dataclass(frozen=True)
class Shape:
    """A body's outline in its own frame, m.

    Attributes:
        outline: (n, 2) corners of a polygon, counter-clockwise.
        role: "crank", "bearing", "link" or "block", which a guide holds.
    """

    outline: Array
    role: str

    @property
    def colour(self) -> str:
        """Its fill."""
        return COLOURS[self.role]

    def moved(self, pose: Array) -> Array:
        """Return the outline (n, 2) for a pose (x, y, angle)."""
        return moved(self.outline, pose)


def shapes_of(mechanism: Mechanism, height: float | None = None) -> dict[str, Shape]:
    """Return every body's shape by name.

    Args:
        mechanism: drawn.
        height: of the mechanism, m; that of a revolution unless given.
    """
    if height is None:
        height = float(np.ptp(swept(mechanism)[:, 1]))
    guided = {guide.body for guide in mechanism.guides}
    heaviest = max(body.mass for body in mechanism.bodies)
    shapes = {}
    for body in mechanism.bodies:
        points = np.array(mechanism.points(body.name) or [(0.0, 0.0)])
        if body.name in guided:
            margin = BLOCK * height * float(np.cbrt(body.mass / heaviest))
            outline = _block(points, margin)
        else:
            margin = ROD * height * (1.6 if body.name == mechanism.crank else 1.0)
            outline = _link(points, margin)
        shapes[body.name] = Shape(outline, _role(mechanism, body.name))
    return shapes


def swept(mechanism: Mechanism) -> Array:
    """Return every position that a joint passes through in a revolution of the ideal mechanism."""
    motion = mechanism.motion(np.linspace(0.0, 2.0 * np.pi, 73), 1.0)
    points = {body.name: np.array(mechanism.points(body.name)) for body in mechanism.bodies}
    positions = [moved(at, pose) for name, at in points.items() for pose in motion[name].position]
    return np.vstack(positions)


def swept_outlines(mechanism: Mechanism, shapes: Mapping[str, Shape]) -> dict[str, Array]:
    """Return all places (n, 2) of every body's outline over a revolution of the ideal mechanism."""
    motion = mechanism.motion(np.linspace(0.0, 2.0 * np.pi, 73), 1.0)
    return {
        name: np.vstack([shape.moved(pose) for pose in motion[name].position])
        for name, shape in shapes.items()
    }


def rails(guide: Guide, outline: Array, unit: float) -> list[Array]:
    """Return the corners (4, 2) of the rails on both sides of a body in its guide.

    Args:
        guide: that holds the body.
        outline: all places (n, 2) of the body's outline.
        unit: size of the drawing, m.
    """
    gap, width = 0.004 * unit, 0.008 * unit
    axes = np.array([guide.across, guide.direction])
    (left, low), (right, high) = (outline @ axes.T).min(axis=0), (outline @ axes.T).max(axis=0)
    return [
        np.array([[edge, low], [edge + width, low], [edge + width, high], [edge, high]]) @ axes
        for edge in (left - gap - width, right + gap)
    ]


@dataclass(frozen=True)
class Mark:
    """A dead centre beside the slider's way, at the edge that leads upwards.

    Attributes:
        label: "TDC" or "BDC".
        place: where the slider's outline ends sideways, m.
        aside: unit vector away from the slider: to the left, or downwards.
        above: whether the other one lies below.
    """

    label: str
    place: Array
    aside: Array
    above: bool


def marks(mechanism: Mechanism, outline: Array) -> list[Mark]:
    """Return the ideal slider's dead centres, none where it has none.

    Args:
        mechanism: drawn.
        outline: all places (n, 2) of the slider's outline.
    """
    if mechanism.dead_centres is None:
        return []
    motion = mechanism.motion(np.linspace(0.0, 2.0 * np.pi, 721), 1.0)[mechanism.slider]
    along = np.array(mechanism.output.direction)
    aside = np.array([-along[1], along[0]])
    if aside @ (1.0, LEVEL) > 0.0:
        aside = -aside
    heights = motion.position[:, :2] @ along
    edge = (outline @ along).max() - heights.max()
    beside = (outline @ aside).max() * aside
    return [
        Mark(label, (height + edge) * along + beside, aside, bool(upwards > LEVEL))
        for label, height, upwards in (
            ("TDC", heights.max(), along[1]),
            ("BDC", heights.min(), -along[1]),
        )
    ]


def moved(points: Array, pose: Array) -> Array:
    """Return points (n, 2) of a body at a pose (x, y, angle)."""
    c, s = np.cos(pose[2]), np.sin(pose[2])
    return np.asarray(points @ np.array([[c, s], [-s, c]]) + pose[:2])


def _role(mechanism: Mechanism, body: str) -> str:
    if body == mechanism.crank:
        return "crank"
    if any(guide.body == body for guide in mechanism.guides):
        return "block"
    pin = max(mechanism.crank_pins, key=mechanism.crank_pins.__getitem__)
    on_pin = any(joint.name == pin for joint in mechanism.joints_of(body))
    return "bearing" if on_pin else "link"


def _block(points: Array, margin: float) -> Array:
    (left, low), (right, high) = points.min(axis=0) - margin, points.max(axis=0) + margin
    return np.array([[left, low], [right, low], [right, high], [left, high]])


def _link(points: Array, half_width: float) -> Array:
    """Return an outline around all joints of a body, round at each: a rod where there are two."""
    angle = np.linspace(0.0, 2.0 * np.pi, CORNERS, endpoint=False)
    outwards = np.column_stack([np.cos(angle), np.sin(angle)])
    size = half_width if len(points) > 1 else 2.0 * half_width
    return np.asarray(points[np.argmax(outwards @ points.T, axis=1)] + size * outwards)
