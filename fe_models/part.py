"""A part to be reduced: geometry, material, interfaces, mesh size; and the shipped crank, linkage.

parts.toml holds the shipped dimensions, fitted by scripts/fit_flexible_parts.py.
"""

import tomllib
from collections.abc import Mapping
from dataclasses import asdict, dataclass, replace
from pathlib import Path
from typing import Any

from fe_models.errors import InputError
from fe_models.geometry import CrankShape, Geometry, LinkageShape, OpenedStepFile, StepFile
from fe_models.material import CRANK_STEEL, LINKAGE_IRON, Material

__all__ = ["MOTIONS", "Interface", "Part", "shipped_faces", "shipped_names", "shipped_part"]

MOTIONS = ("x", "y", "z", "rx", "ry", "rz")  # an interface's mean translation and rotation
PARTS_FILE = Path(__file__).with_name("parts.toml")


@dataclass(frozen=True)
class Interface:
    """A named face that loads or joints act on.

    Attributes:
        face: name of one or several faces of the shape, taken together.
        motions: those of "x", "y", "z", "rx", "ry", "rz" in which it is loaded; each gets a static
            mode, so that the reduced part is exact under such a load.

    Raises:
        InputError: a motion is unknown or named twice.
    """

    face: str
    motions: tuple[str, ...] = MOTIONS

    def __post_init__(self) -> None:
        wrong = [motion for motion in self.motions if motion not in MOTIONS]
        if wrong or len(set(self.motions)) != len(self.motions):
            raise InputError(
                f"interface {self.face!r}: motions = {self.motions!r}: each at most once, of "
                + ", ".join(MOTIONS)
            )


@dataclass(frozen=True)
class Part:
    """Data that a reduced flexible body is made from.

    Attributes:
        name: in messages, and part of the cache's file name.
        geometry: of the solid.
        material: linear elastic.
        interfaces: the faces that joints and loads hold on to.
        mesh_size: largest edge of a tetrahedron, m.

    Raises:
        InputError: the mesh size is not positive, or a face is named twice.
    """

    name: str
    geometry: Geometry
    material: Material
    interfaces: tuple[Interface, ...]
    mesh_size: float

    def __post_init__(self) -> None:
        if not 0.0 < self.mesh_size < float("inf"):
            raise InputError(f"{self.name}: mesh_size = {self.mesh_size!r}: must be positive, in m")
        faces = [interface.face for interface in self.interfaces]
        if len(set(faces)) != len(faces):
            raise InputError(f"{self.name}: interfaces {faces}: each face at most once")

    @property
    def bearings(self) -> tuple[str, ...]:
        """Return the faces held in all six motions: what the published modes are clamped at."""
        return tuple(i.face for i in self.interfaces if len(i.motions) == len(MOTIONS))

    @property
    def reader(self) -> StepFile | None:
        """Return what opens a file of the solid in a child, or None."""
        return self.geometry if isinstance(self.geometry, StepFile) else None

    def open_here(self) -> "Part":
        """Return the solid whose STEP file this process, a child, reads itself."""
        assert isinstance(self.geometry, StepFile)
        return self.replace(geometry=OpenedStepFile(self.geometry))

    def key(self) -> dict[str, Any]:
        """Return everything that determines the finite-element model, as plain data."""
        return {
            "geometry": self.geometry.key(),
            "material": asdict(self.material),
            "interfaces": [[i.face, list(i.motions)] for i in self.interfaces],
            "mesh_size": self.mesh_size,
        }

    def replace(self, **changes: Any) -> "Part":
        """Return a copy with some fields changed."""
        return replace(self, **changes)


CRANK_INTERFACES = (
    Interface("journal A"),
    Interface("pin"),
    Interface("journal B"),
    Interface("flange", ("rz",)),  # driven there: a torque about the shaft's axis, nothing else
)
LINKAGE_INTERFACES = (Interface("big bore"), Interface("small bore"))


def shipped_part(name: str, mesh_size: float | None = None) -> Part:
    """Return "crank" or "linkage", or one of their second shapes ("crank_2", "linkage_2").

    Args:
        name: of the part.
        mesh_size: m; by default that in parts.toml.

    Raises:
        InputError: there is no such part.
    """
    tables = _tables()
    if name not in tables:
        raise InputError(
            f"{name!r}: there is no such flexible part; shipped are {', '.join(sorted(tables))}"
        )
    table = tables[name]
    size = table["mesh_size"] if mesh_size is None else mesh_size
    if name.startswith("crank"):
        crank = CrankShape(**table["dimensions"])
        return Part(name, crank, CRANK_STEEL, CRANK_INTERFACES, size)
    rod = LinkageShape(**table["dimensions"])
    return Part(name, rod, LINKAGE_IRON, LINKAGE_INTERFACES, size)


def shipped_faces(name: str) -> Mapping[str, Any]:
    """Return joint -> the faces of a shipped part that joints of this name hold."""
    faces: Mapping[str, Any] = _tables()[name]["faces"]
    return faces


def shipped_names() -> tuple[str, ...]:
    """Return the names that `shipped_part` knows."""
    return tuple(_tables())


def _tables() -> Mapping[str, Any]:
    with PARTS_FILE.open("rb") as file:
        return tomllib.load(file)
