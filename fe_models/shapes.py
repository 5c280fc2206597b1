"""Solids by netgen's OCC kernel, with named interface faces. The only module that builds shapes."""

import math
import shutil
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from netgen.occ import Cylinder, MoveTo, Pnt, Vec, Z  # type: ignore[import-untyped]
from netgen.occ import OCCGeometry as OccGeometry

from fe_models.dimensions import Box, CrankDimensions, LinkageDimensions
from fe_models.errors import InputError
from fe_models.patches import lies_within
from fe_models.temporary import TemporaryFolder

__all__ = ["crank_shaft", "freeze", "from_step", "linkage", "thaw"]

REST = "surface"  # the name of every face that is not an interface


def crank_shaft(d: CrankDimensions) -> Any:
    """Return the crank shaft: coaxial cylinders along z, web and pin discs off the axis in +y."""
    half_pin, web = 0.5 * d.pin_length, d.web_thickness
    a = half_pin + web + d.journal_length  # where the seats begin, from the pin's centre
    b = a + d.seat_b_length
    solid = (
        _disc(-a - d.seat_a_length, d.seat_a_length, d.seat_a_radius)
        + _disc(-a, d.journal_length, d.journal_radius, name="journal A")
        + _disc(-half_pin - web, web, d.web_radius, d.web_offset)
        + _disc(-half_pin, d.pin_length, d.pin_radius, d.eccentricity, name="pin")
        + _disc(half_pin, web, d.web_radius, d.web_offset)
        + _disc(half_pin + web, d.journal_length, d.journal_radius, name="journal B")
        + _disc(a, d.seat_b_length, d.seat_b_radius)
        + _disc(b, d.flange_length, d.flange_radius)
    )
    solid.faces.Max(Z).name = "flange"
    return solid


def linkage(d: LinkageDimensions) -> Any:
    """Return the linkage: shank and bosses fused, then both bores drilled through."""
    half = 0.5 * d.length
    solid = _shank(d, inset=0.0, width=d.shank_width, middle=0.0)
    if d.pocket_depth > 0.0:
        for side in (-1.0, 1.0):
            middle = 0.5 * side * (d.shank_width - d.pocket_depth)
            solid -= _shank(d, inset=d.rim, width=d.pocket_depth, middle=middle)
    bores = (
        (-half, d.big_outer_radius, d.big_width, d.big_bore_radius, "big bore"),
        (half, d.small_outer_radius, d.small_width, d.small_bore_radius, "small bore"),
    )
    for x, outer, width, _, _ in bores:
        solid += Cylinder(Pnt(x, 0, -0.5 * width), Z, r=outer, h=width)
    solid.faces.name = REST
    depth = max(d.big_width, d.small_width, d.shank_width)
    for x, _, _, bore, name in bores:
        drill = Cylinder(Pnt(x, 0, -depth), Z, r=bore, h=2.0 * depth)
        drill.faces.name = name
        solid -= drill
    return solid


def from_step(path: Path, scale: float, faces: Mapping[str, Box]) -> Any:
    """Return the solid of a STEP file, scaled to m; faces wholly inside a box take its name."""
    try:
        shape = _read_step(path)
        solids = len(shape.solids)
        corners = [getattr(end, axis) for end in shape.bounding_box for axis in "xyz"]
    except Exception as error:
        raise InputError(f"STEP file {path}: netgen cannot read it ({error})") from error
    if not all(map(math.isfinite, corners)):
        raise InputError(f"STEP file {path}: a coordinate is no number")
    if solids != 1:
        raise InputError(f"STEP file {path}: holds {solids} solids; a part is one solid")
    if scale != 1.0:
        shape = shape.Scale(Pnt(0, 0, 0), scale)
    for name, box in faces.items():
        named_faces = [face for face in shape.faces if lies_within(face.bounding_box, box, 1e-6)]
        for face in named_faces:
            face.name = name
        if not named_faces:
            lowest, highest = box
            raise InputError(
                f"STEP file {path}: no face lies wholly inside the box of {name!r}, "
                f"{tuple(lowest)} ... {tuple(highest)} in m after scale = {scale:g}"
            )
    return shape


def _read_step(path: Path) -> Any:
    """Return the shape of a STEP file; netgen takes only names that end in small letters."""
    with TemporaryFolder() as folder:
        if path.suffix != path.suffix.lower():
            path = Path(shutil.copy(path, folder / f"shape{path.suffix.lower()}"))
        return OccGeometry(str(path)).shape


def freeze(shape: Any) -> tuple[str, tuple[str | None, ...]]:
    """Return a shape's boundary representation as text, and its faces' names in order."""
    with TemporaryFolder() as folder:
        path = folder / "shape.brep"
        shape.WriteBrep(str(path))
        return path.read_text(), tuple(face.name for face in shape.faces)


def thaw(text: str, names: tuple[str | None, ...]) -> Any:
    """Return a fresh shape from the data of `freeze`."""
    with TemporaryFolder() as folder:
        path = folder / "shape.brep"
        path.write_text(text)
        shape = OccGeometry(str(path)).shape
    for face, name in zip(shape.faces, names, strict=True):
        if name is not None:
            face.name = name
    return shape


def _shank(d: LinkageDimensions, inset: float, width: float, middle: float) -> Any:
    """Return the shank's outline, `inset` in height, as a prism about z = middle."""
    half = 0.5 * d.length
    a, b, c = (
        height - inset
        for height in (
            d.shank_half_height_big,
            d.shank_half_height_middle,
            d.shank_half_height_small,
        )
    )
    outline = MoveTo(-half, -a).LineTo(0, -b).LineTo(half, -c).LineTo(half, c).LineTo(0, b)
    prism = outline.LineTo(-half, a).Close().Face().Extrude(width * Z)
    return prism.Move(Vec(0, 0, middle - 0.5 * width))


def _disc(start: float, length: float, radius: float, offset: float = 0.0, name: str = REST) -> Any:
    """Return a cylinder along z from `start`, its axis `offset` in +y, its mantle named."""
    disc = Cylinder(Pnt(0, offset, start), Z, r=radius, h=length)
    disc.faces.name = name
    for end in (disc.faces.Max(Z), disc.faces.Min(Z)):
        end.name = REST
    return disc
