"""Graphics of a model for Exudyn's viewer: solids of the rigid bodies, guides and pivots.

They are made for a user's model, not for a run. Flexible bodies have their surfaces already.
"""

from typing import Any

import numpy as np
from exudyn import graphics

from exu_press.mechanism import GROUND, Guide, Joint, Mechanism, Point
from exu_press.mechanism.parts import DRIVE
from exu_press.mechanism.shapes import FrontView, rail_corners, swept_points
from exu_press.model import Model, build
from exu_press.scene import Scene

__all__ = ["add_graphics", "build_with_graphics"]

THICKNESS = 0.03
"""Thickness of a body along z, relative to the mechanism's height; neighbours lie side by side."""

FRAME, DISC = "#8C8C8C", "#E6B840"


def build_with_graphics(scene: Scene) -> Model:
    """Return the model of a scene with graphics, for `scene.build()`."""
    model = build(scene)
    add_graphics(model)
    return model


def add_graphics(model: Model) -> None:
    """Add graphics to every rigid body and the ground, and set up the viewer."""
    mechanism = model.mechanism
    height = float(np.ptp(swept_points(mechanism)[:, 1]))
    thickness = THICKNESS * height
    view, layers = FrontView(mechanism), _layers(mechanism)
    for name, shape in view.shapes.items():
        if name not in model.parts:
            outline = [model.rigid[name].graphics_point((x, y)) for x, y in shape.outline.tolist()]
            _show(model, name, [_solid(outline, shape.colour, layers[name] * thickness, thickness)])
    if DRIVE in model.bodies:
        crank = model.parts[mechanism.crank]
        height_there = float(crank.reduced.interface(crank.drive).centre[2])
        disc = graphics.Cylinder(
            [0.0, 0.0, height_there], [0.0, 0.0, thickness], 0.05 * height, _rgba(DISC)
        )
        _show(model, DRIVE, [disc])
    _show(model, GROUND, _frame(mechanism, view, layers, thickness))
    settings = model.SC.visualizationSettings
    hidden = (settings.nodes, settings.markers, settings.sensors, settings.loads)
    for items in (*hidden, settings.connectors):  # their symbols are larger than the bodies
        items.show = False
    settings.view0.scene.showMeshEdges = False
    settings.openGL.multiSampling = 4
    for light in (settings.openGL.light0, settings.openGL.light1):
        light.specular = 0.0  # plates would shine as a whole, nearly white


def _show(model: Model, body: str, solids: list[Any]) -> None:
    model.mbs.SetObjectParameter(model.bodies[body], "VgraphicsData", solids)


def _solid(outline: list[Point], colour: str, z: float, thickness: float) -> Any:
    """Return an outline as a plate about the height z, m."""
    count = len(outline)
    return graphics.SolidExtrusion(
        vertices=outline,
        segments=[[i, (i + 1) % count] for i in range(count)],
        height=0.9 * thickness,
        pOff=[0.0, 0.0, z - 0.45 * thickness],
        color=_rgba(colour),
        addEdges=True,
    )


def _layers(mechanism: Mechanism) -> dict[str, int]:
    """Return a layer for every body, such that bodies with a common joint never share one."""
    layers: dict[str, int] = {}
    for body in mechanism.bodies:
        elements: tuple[Joint | Guide, ...] = (*mechanism.joints, *mechanism.guides)
        used = {layers.get(end) for e in elements if body.name in e.bodies for end in e.bodies}
        layers[body.name] = next(n for n in range(len(mechanism.bodies)) if n not in used)
    return layers


def _frame(
    mechanism: Mechanism, view: FrontView, layers: dict[str, int], thickness: float
) -> list[Any]:
    """Return the guides' rails beside their bodies, and the pivots' pins."""
    solids = []
    for guide in mechanism.guides:
        if not guide.is_rail:
            continue
        for rail in rail_corners(guide, view.swept[guide.body], view.unit):
            outline = [(x, y) for x, y in rail.tolist()]
            solids.append(_solid(outline, FRAME, layers[guide.body] * thickness, thickness))
    for joint in mechanism.joints:
        if joint.on_frame:
            start, along = [*joint.at, -thickness], [0.0, 0.0, 3.0 * thickness]
            solids.append(graphics.Cylinder(start, along, 0.2 * thickness, _rgba(FRAME)))
    return solids


def _rgba(colour: str) -> list[float]:
    return [int(colour[i : i + 2], 16) / 255.0 for i in (1, 3, 5)] + [1.0]
