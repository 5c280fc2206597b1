"""Flexible bodies of a mechanism, and their solids."""

import dataclasses
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, ClassVar

from exu_press.errors import InputError, error_prefix, required_package
from exu_press.mechanism import Mechanism
from exu_press.schema.checks import demand_known, key, refuse_unknown
from exu_press.schema.table import Table, changed_table, given_keys, plain, table_from

__all__ = [
    "DRIVE_FACE",
    "GUIDE_FACE",
    "STEP_FILES",
    "USUAL_MESH_SIZE",
    "Face",
    "Flexible",
    "bodies_of",
    "changed_body",
    "face_dict",
    "faces_given",
    "patch_given",
]

DRIVE_FACE = "drive"
"""Among a crank's faces: the one that the drive turns."""

GUIDE_FACE = "guide"
"""Among the faces of a body in a guide: those that the guide holds."""

STEP_FILES = (".step", ".stp")
DESCRIPTION = ".toml"

USUAL_MESH_SIZE = 0.03
"""m."""

OF_FILES = ("time_limit", "memory_limit_gb")
"""Keys of a body from a STEP file or matrices."""

OF_SOLIDS = ("mesh_size", "youngs_modulus", "poissons_ratio", "density", "sn_stress")
"""Keys of a body that is meshed here, and so has stresses."""

USUAL_MODES = 20


@dataclass(frozen=True)
class Face(Table):
    """The faces of a solid that a joint, a guide or a load holds.

    By name; or, of a joint, cylinders and spheres about its axis; of a guide or a load, all that
    lie wholly within ranges.
    """

    name: str = key("", "as the STEP file or the shipped part has it; empty: by their place")
    radius: float | None = key(
        None, "of a joint's cylinder or sphere, where several have the same axis", "m", above=0
    )
    z: tuple[float, float] | None = key(
        None,
        "[lowest, highest] along the joints' axes; of a joint, where several cylinders have the "
        "same radius",
        "m",
        numbers=2,
    )
    eccentric: bool = key(
        False,
        "whether the joint's axis may lie beside the face's, as that of an eccentric ring on it, "
        "and the face may carry another joint",
    )
    x: tuple[float, float] | None = key(
        None,
        "[lowest, highest] of a guide's or a load's faces, as the STEP file has it",
        "m",
        numbers=2,
    )
    y: tuple[float, float] | None = key(None, "[lowest, highest], likewise", "m", numbers=2)

    def __post_init__(self) -> None:
        super().__post_init__()
        for axis in ("x", "y", "z"):
            ends = getattr(self, axis)
            if ends is not None and not ends[0] < ends[1]:
                raise InputError(f"{axis} = {list(ends)!r}: allowed is [lowest, highest], m")

    @property
    def ranges(self) -> tuple[tuple[float, float] | None, ...]:
        """Within x, y and z."""
        return self.x, self.y, self.z


OF_A_JOINT = ("name", "radius", "z", "eccentric")
OF_A_PATCH = ("name", "x", "y", "z")
OF_ANY = (*OF_A_JOINT, "x", "y")
"""Keys of faces that a joint or a pin holds, of those that a guide or a load does, and of both."""


@dataclass(frozen=True)
class Flexible(Table):
    """A flexible body: a shipped part or STEP file with material and mesh, or matrices; modes."""

    exclusive: ClassVar[tuple[tuple[str, str], ...]] = (
        ("matrices", "flexible"),
        ("modes", "flexibility_error"),
    )
    flexible: str | None = key(None, "a shipped part, or the path of a STEP file")
    matrices: str | None = key(
        None, "instead of flexible: path of the description (.toml) of another code's matrices"
    )
    modes: int | None = key(
        None, "number of modal coordinates, 20 unless given", at_least=0, at_most=500
    )
    flexibility_error: float | None = key(
        None,
        "instead of modes: largest relative error of the static flexibility",
        above=0,
        at_most=0.5,
    )
    method: str = key("craig_bampton", "reduction", choices=("craig_bampton", "free"))
    damping_ratio: float = key(0.02, "damping ratio of every mode", at_least=0, at_most=0.9)
    mesh_size: float | None = key(
        None, "size of the tetrahedra, 0.03 unless given", "m", at_least=0.001, at_most=0.1
    )
    youngs_modulus: float | None = key(
        None, "the shipped part's, or steel's 2.1e11, unless given", "Pa", above=0
    )
    poissons_ratio: float | None = key(
        None, "the shipped part's, or steel's 0.3, unless given", at_least=0, at_most=0.495
    )
    density: float | None = key(
        None, "the shipped part's, or steel's 7850, unless given", "kg/m^3", above=0
    )
    origin: tuple[float, float] | None = key(
        None,
        "place of the solid's origin in the drawing; [0, 0], or fitted if all faces have names",
        "m",
        numbers=2,
    )
    angle_deg: float | None = key(
        None, "direction of the solid's x axis in the drawing; 0, or fitted likewise", "deg"
    )
    time_limit: float | None = key(
        None, "for reading and reducing a STEP file or matrices; 600 unless given", "s", above=0
    )
    memory_limit_gb: float | None = key(
        None, "memory for that, in 1e9 bytes; 8 unless given", at_least=1, at_most=1e6
    )
    sn_stress: float | None = key(
        None,
        "stress amplitude endured for sn_cycles; the summary then has the fatigue life",
        "Pa",
        above=0,
    )
    sn_cycles: float = key(2e6, "cycles at sn_stress", above=0)
    sn_slope: float = key(5.0, "k of cycles ~ amplitude^-k", above=1, at_most=50)
    faces: Mapping[str, tuple[Face, ...]] = dataclasses.field(default_factory=dict, hash=False)

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.flexibility_error is None and self.modes is None:
            object.__setattr__(self, "modes", USUAL_MODES)
        object.__setattr__(self, "faces", faces_given(self.faces))
        if self.flexible is None and self.matrices is None:
            raise InputError(
                "flexible: missing; allowed is a shipped part or the path of a STEP file; or "
                "matrices, the path of a description"
            )
        if not self.from_file:
            self.refuse_unused(OF_FILES, f"{self.flexible!r} is no STEP file")
        if self.matrices is not None:
            self.refuse_unused(OF_SOLIDS, f"{self.matrices!r} has matrices in place of a solid")
        if self.matrices is not None and not self.matrices.lower().endswith(DESCRIPTION):
            raise InputError(
                f"matrices = {self.matrices!r}: allowed is the path of a description, {DESCRIPTION}"
            )

    def to_dict(self) -> dict[str, Any]:
        """Return the keys that it gives as a nested mapping."""
        faces = {name: [face_dict(face) for face in held] for name, held in self.faces.items()}
        keys = {name: value for name, value in plain(self).items() if name != "faces"}
        return {**keys, "faces": faces} if faces else keys

    @property
    def source(self) -> str:
        """Return the shipped part or the file that the body comes from."""
        return self.flexible or self.matrices or ""

    @property
    def from_file(self) -> bool:
        """Return whether the body is that of a STEP file or of matrices."""
        return self.matrices is not None or self.source.lower().endswith(STEP_FILES)

    @property
    def path(self) -> Path:
        """Return the path of the file."""
        return Path(self.source)


def bodies_of(tables: Any, mechanism: Mechanism) -> dict[str, Flexible]:
    """Return the flexible bodies of a scene.

    Args:
        tables: body -> a shipped part's name or a STEP file's path, a mapping of keys or a
            `Flexible`.
        mechanism: that has the bodies.

    Raises:
        InputError: there is no such body or joint, or a key is not allowed.
    """
    if not isinstance(tables, Mapping):
        raise InputError(f"bodies = {tables!r}: allowed is a table for each flexible body")
    names, bodies = [body.name for body in mechanism.bodies], {}
    for name, value in tables.items():
        value_text = repr(value) if isinstance(value, str) else "..."
        problem = f"bodies.{name} = {value_text}: {mechanism.name} has no such body"
        demand_known(problem, name, names)
        if not isinstance(value, (str, Mapping, Flexible)):
            raise InputError(
                f"bodies.{name} = {value!r}: allowed is a shipped part, a STEP file's path, or a "
                "table of keys"
            )
        with error_prefix(f"bodies.{name}."):
            bodies[name] = table_from(Flexible, "", _keys(value))
        _check_faces(name, bodies[name], mechanism)
    return bodies


def _check_faces(name: str, body: Flexible, mechanism: Mechanism) -> None:
    """Raise InputError for faces that nothing holds, and for a guide or slot without them."""
    guides = [guide for guide in mechanism.guides if name in guide.bodies]
    joints = [joint.name for joint in mechanism.joints_of(name)]
    joints += [guide.name for guide in guides if guide.is_slot and guide.body == name]
    joints += [DRIVE_FACE] if name == mechanism.crank else []
    patches = [
        GUIDE_FACE if guide.is_rail else guide.name
        for guide in guides
        if not (guide.is_slot and guide.body == name)
    ]
    for held, faces in body.faces.items():
        where = f"bodies.{name}.faces.{held}"
        demand_known(f"{where}: {name} has no such joint", held, [*joints, *patches])
        is_patch = held in patches
        for keys in (face_dict(face) for face in faces):
            if isinstance(keys, dict):
                refuse_unknown(where, keys, OF_A_PATCH if is_patch else OF_A_JOINT)
        if is_patch:
            patch_given(where, faces)
    for guide in guides:
        if not guide.is_rail and guide.name in patches and guide.name not in body.faces:
            raise InputError(
                f"bodies.{name}.faces.{guide.name}: missing; allowed are the faces with whose mean "
                f"motion {guide.key} moves as a whole. Along a line of the body that deforms "
                "itself contact would run from face to face, and modes of fixed faces do not know "
                "that: allowed there is a rigid body"
            )


def flexible_press(**keys: Any) -> dict[str, dict[str, Any]]:
    """Return the press's two shipped parts, for the `bodies` of a scene.

    >>> flexible_press(modes=10)["crank"]
    {'flexible': 'crank', 'modes': 10}

    Args:
        keys: of both.
    """
    return {name: {"flexible": name, **keys} for name in ("crank", "linkage")}


def changed_body(_: str, body: Any, changes: Mapping[str, Any]) -> dict[str, Any]:
    """Return the keys of a flexible body with others."""
    unused = OF_SOLIDS if changes.get("matrices") is not None else ()
    keys = {k: value for k, value in given_keys(_keys(body)).items() if k not in unused}
    return changed_table(Flexible, keys, changes)


def require_rainflow() -> Any:
    """Return the package that counts cycles; raise InputError if it is not installed."""
    return required_package("rainflow", "sn_stress", "'exu-press[fatigue]'")


def _keys(body: Any) -> Any:
    return {"flexible": body} if isinstance(body, str) else body


def faces_given(table: Any) -> dict[str, tuple[Face, ...]]:
    """Return joint -> faces of a scene file or a shipped part.

    Raises:
        InputError: a face is none.
    """
    if not isinstance(table, Mapping):
        raise InputError(f"faces = {table!r}: allowed is a table of joints' names")
    faces = {name: _faces(f"faces.{name}", value, OF_ANY) for name, value in table.items()}
    driven = faces.get(DRIVE_FACE)
    if driven is not None and (len(driven) != 1 or not driven[0].name):
        raise InputError(f"faces.{DRIVE_FACE} = {table[DRIVE_FACE]!r}: allowed is a face's name")
    return faces


def patch_given(where: str, value: Any) -> tuple[Face, ...]:
    """Return the faces that a guide or a load holds together.

    Args:
        where: beginning of messages.
        value: one or a list of them, each a name or a table of name or ranges.

    Raises:
        InputError: a face is none, or has neither a name nor a range.
    """
    faces = _faces(where, value, OF_A_PATCH)
    for face in faces:
        if bool(face.name) == any(face.ranges):
            raise InputError(
                f"{where} = {face_dict(face)!r}: allowed is a face's name, or ranges of x, y and z "
                "within which faces lie wholly, m"
            )
    return faces


def _faces(where: str, value: Any, known: tuple[str, ...]) -> tuple[Face, ...]:
    """Return faces: one or a list of them, each a name or a table."""
    values = value if isinstance(value, (list, tuple)) else [value]
    if not values:
        raise InputError(f"{where} = []: allowed is at least one face")
    return tuple(_face(where, face, known) for face in values)


def _face(where: str, value: Any, known: tuple[str, ...]) -> Face:
    if isinstance(value, Face):
        return value
    if isinstance(value, str):
        value = {"name": value}
    if not isinstance(value, Mapping):
        raise InputError(
            f"{where} = {value!r}: allowed is a face's name, or a table of {', '.join(known)}"
        )
    refuse_unknown(where, value, known)
    with error_prefix(f"{where}."):
        return Face(**value)


def face_dict(face: Face) -> Any:
    """Return a face as a scene file has it."""
    keys = {k: v for k, v in dataclasses.asdict(face).items() if v != Face.__dict__.get(k)}
    if list(keys) == ["name"]:
        return face.name
    return {k: list(v) if isinstance(v, tuple) else v for k, v in keys.items()}
