"""Solids of parts: dimensions of a crank shaft or linkage, a STEP file, an OCC shape.

Each geometry has `key()`, everything that determines the solid as plain data (for the cache, no
NGSolve needed), and `build()`, which returns a fresh netgen.occ shape with named faces. A fresh
one, because meshing one shape object twice gives two different meshes.
"""

import hashlib
from collections.abc import Callable, Mapping
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any, Protocol

from fe_models.dimensions import Axis, Box, CrankDimensions, LinkageDimensions, Patch, Sides
from fe_models.errors import InputError

__all__ = [
    "Axis",
    "Box",
    "CrankShape",
    "Geometry",
    "LinkageShape",
    "OpenedStepFile",
    "OwnShape",
    "Patch",
    "Sides",
    "StepFile",
]


class Geometry(Protocol):
    """Anything that can be meshed."""

    def key(self) -> dict[str, Any]:
        """Return the data that determine the solid, for JSON."""

    def build(self) -> Any:
        """Return a fresh netgen.occ shape whose interface faces carry names."""


class CrankShape(CrankDimensions):
    """A crank shaft of coaxial cylinders along z; its axis is x = y = 0, the pin's centre z = 0.

    From -z to +z: seat a, journal A, web, pin, web, journal B, seat b, flange. Lengths in m. The
    webs are discs centred `web_offset` towards the pin (+y), which is `eccentricity` off the axis.
    """

    def build(self) -> Any:
        """Return the solid: faces "journal A", "pin", "journal B", "flange" and the bare rest."""
        from fe_models.shapes import crank_shaft

        return crank_shaft(self)


class LinkageShape(LinkageDimensions):
    """A linkage along x: two bosses with bores `length` apart, a shank between; symmetric in y, z.

    Big bore (the bearing of the crank pin) at x = -length/2, small bore at +length/2, bore axes
    along z. The shank runs from boss centre to boss centre, its half height (y) linear between big
    end, middle and small end. Pockets from both faces, `pocket_depth` deep and leaving `rim` above
    and below, make it an I-section between the bosses. Lengths in m.
    """

    def build(self) -> Any:
        """Return the solid: faces "big bore", "small bore" and the bare rest."""
        from fe_models.shapes import linkage

        return linkage(self)


@dataclass(frozen=True)
class StepFile:
    """A solid from a STEP file, in m after `scale` (0.001 for a file in mm).

    Netgen reads face names that the file carries. `faces` names others: every face that lies wholly
    inside a box ((x, y, z) lowest, (x, y, z) highest; in m) takes its name. `axes` names cylinders
    along z and spheres by where their axis is. `patches` gives one name to faces that are held
    together, by their own names, by boxes, or as the two sides of the solid.

    A child process reads it; with `reduced_part` it meshes and reduces it, too. `time_limit` (s)
    and `memory_limit` (bytes) are those of the child.
    """

    path: Path
    scale: float = 1.0
    faces: Mapping[str, Box] = field(default_factory=dict)
    axes: Mapping[str, Axis] = field(default_factory=dict)
    patches: Mapping[str, tuple[Patch, ...] | Sides] = field(default_factory=dict)
    time_limit: float = 600.0
    memory_limit: float = 8e9

    def key(self) -> dict[str, Any]:
        """Return a digest of the file, the boxes, the axes and the patches."""
        return {
            "shape": "step",
            "digest": hashlib.sha256(self.content()).hexdigest(),
            "scale": self.scale,
            "faces": {name: [list(corner) for corner in box] for name, box in self.faces.items()},
            "axes": {name: asdict(axis) for name, axis in self.axes.items()},
            "patches": {
                name: asdict(patch) if isinstance(patch, Sides) else [asdict(box) for box in patch]
                for name, patch in self.patches.items()
            },
        }

    def build(self) -> Any:
        """Return the solid, its faces named by the file, boxes, axes and patches."""
        self.content()
        from fe_models.shapes import thaw

        return thaw(*self.in_child(f"{__name__}:read_here", self))

    def in_child(
        self, function: str, *arguments: Any, report: Callable[..., None] | None = None
    ) -> Any:
        """Return what a function that opens this file returns; arguments as of `read_in_child`."""
        from fe_models.file_reader import read_in_child
        from fe_models.step_text import faulty_entity

        return read_in_child(
            function,
            *arguments,
            file=f"STEP file {self.path}",
            smaller="a larger mesh_size, or another file",
            damage=lambda: faulty_entity(Path(self.path)),
            time_limit=self.time_limit,
            memory_limit=self.memory_limit,
            report=report,
        )

    def content(self) -> bytes:
        """Return the bytes of the file.

        Raises:
            InputError: it cannot be read, or is no STEP file.
        """
        path = Path(self.path)
        try:
            if path.exists() and not path.is_file():
                raise InputError(f"STEP file {path}: is no regular file")
            content = path.read_bytes()
        except OSError as error:
            raise InputError(f"STEP file {path}: cannot be read ({error.strerror})") from error
        except ValueError as error:
            raise InputError(f"STEP file {path}: cannot be read ({error})") from error
        if not content.lstrip().startswith(b"ISO-10303-21"):
            raise InputError(
                f"STEP file {self.path}: is not one (a STEP file begins with ISO-10303-21)"
            )
        return content


@dataclass(frozen=True)
class OpenedStepFile:
    """A STEP file that this process reads itself: a child, which may crash."""

    step: StepFile

    def key(self) -> dict[str, Any]:
        """Return the file's."""
        return self.step.key()

    def build(self) -> Any:
        """Return the solid, its faces named by the file, boxes, axes and patches."""
        self.step.content()
        from fe_models.patches import name_patches
        from fe_models.round_faces import name_round_faces
        from fe_models.shapes import from_step

        step, where = self.step, f"STEP file {self.step.path}"
        shape = from_step(step.path, step.scale, step.faces)
        name_round_faces(shape, step.axes, where)
        name_patches(shape, step.patches, step.axes, where)
        return shape


def read_here(step: StepFile) -> tuple[str, tuple[str | None, ...]]:
    """Read a STEP file in this process, a child; return the solid as `freeze` does."""
    from fe_models.shapes import freeze

    return freeze(OpenedStepFile(step).build())


class OwnShape:
    """A solid that a user made with netgen.occ, its interface faces named (face.name = ...)."""

    def __init__(self, shape: Any) -> None:
        """Keep the shape as text, so that every mesh starts from a fresh copy of it."""
        from fe_models.shapes import freeze

        self._frozen: tuple[str, tuple[str | None, ...]] = freeze(shape)

    def key(self) -> dict[str, Any]:
        """Return a digest of the boundary representation, and the faces' names in its order."""
        text, names = self._frozen
        return {
            "shape": "occ",
            "digest": hashlib.sha256(text.encode()).hexdigest(),
            "names": list(names),
        }

    def build(self) -> Any:
        """Return a fresh copy."""
        from fe_models.shapes import thaw

        return thaw(*self._frozen)
