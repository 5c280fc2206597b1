"""A load of a scene: where it acts, and its force over time, crank angle or height."""

import dataclasses
import math
from abc import ABC, abstractmethod
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, ClassVar

from exu_press.errors import InputError, MissingKeysError, error_prefix
from exu_press.laws.load_curve import LoadCurve
from exu_press.mechanism import Mechanism
from exu_press.scene.applied_load import AppliedLoad, fastest_output
from exu_press.scene.bodies import Face, face_dict, patch_given
from exu_press.schema.checks import key
from exu_press.schema.kinds import CustomKind
from exu_press.schema.registry import Registry
from exu_press.schema.table import Table, missing_keys, plain

__all__ = [
    "ATTACHMENT",
    "COLUMNS",
    "LOAD_KINDS",
    "CustomLoad",
    "Load",
    "check_height",
]

LOAD_KINDS = Registry(
    {
        "blanking": "scene.blanking_load:BlankingLoad",
        "table": "scene.table_load:TableLoad",
        "sheet": "scene.sheet_load:SheetLoad",
        "spring": "scene.spring_load:SpringLoad",
    },
    base="scene.load:CustomLoad",
)

COLUMNS = ("time", "crank_angle_deg", "height")
"""Variables that a table's forces may be given over."""

ATTACHMENT = ("body", "offset", "joint", "face", "direction")
"""Keys of every load."""

FADE = 1e-3
"""Speed over the ideal output's largest one: below it, a forming force fades. A crank at constant
speed passes through it within 0.06 degrees of dead centre, where the output moves by 3e-7 of its
stroke. A press that stalls creeps at no more than that."""


@dataclass(frozen=True)
class Load(CustomKind, Table, ABC):
    """A load and its place; its direction stays in the frame however the body turns.

    `over` is the variable of its curve; `closing` says whether it depends on the way that the
    output goes.

    A flexible body needs to know which of its faces carry the load: those of a joint, or others. A
    point beside the middle of these moves with their mean motion.
    """

    exclusive: ClassVar[tuple[tuple[str, str], ...]] = (("joint", "offset"), ("joint", "face"))
    over: ClassVar[Any] = ""
    closing: ClassVar[Any] = False
    body: str | None = key(None, "body that it acts on; the mechanism's output unless given")
    offset: tuple[float, float] | None = key(
        None,
        "place of the force, from the body's centre of mass, as drawn; 0 unless given",
        "m",
        numbers=2,
    )
    joint: str | None = key(None, "joint of the body, whose centre it acts at; instead of offset")
    face: tuple[Face, ...] | None = key(
        None, "face of a flexible body, in whose middle it acts: its name, or {x, y, z}", also=tuple
    )
    direction: tuple[float, float] | None = key(
        None, "direction of a positive force; the output's unless given", numbers=2
    )

    def __post_init__(self) -> None:
        face: Any = self.face
        if face is not None:
            object.__setattr__(self, "face", patch_given("face", face))
        super().__post_init__()
        if self.direction is not None and math.hypot(*self.direction) == 0.0:
            raise InputError("direction = [0, 0]: allowed is a direction, such as [0, 1]")

    def to_dict(self) -> dict[str, Any]:
        """Return its keys as a mapping; a table with its numbers, not its file."""
        keys = {"kind": self.kind, **plain(self)}
        if self.face is not None:
            faces = [face_dict(face) for face in self.face]
            keys["face"] = faces[0] if len(faces) == 1 else faces
        return keys

    @classmethod
    def read_file(cls, path: Path) -> dict[str, Any]:
        """Return the keys that a file has; InputError where this kind of load reads none."""
        raise InputError(f"{path}: allowed with kind = 'table', whose forces it has")

    def check(self, mechanism: Mechanism, revolution: float) -> None:
        """Raise InputError where it does not suit a mechanism and the time of a revolution, s."""

    def applied_load(
        self, mechanism: Mechanism, angular_speed: float, *, motor: bool
    ) -> AppliedLoad:
        """Return the load on its mechanism; arguments as those of `law`."""
        body = mechanism.body(self.body or mechanism.slider)
        x, y = self.direction or mechanism.output.direction
        length = math.hypot(x, y)
        (u, v), (dx, dy) = body.centre_of_mass, self.offset or (0.0, 0.0)
        position = (u + dx, v + dy)
        if self.joint is not None:
            position = next(joint.at for joint in mechanism.joints if joint.name == self.joint)
        fade = FADE * fastest_output(mechanism, angular_speed) if self.closing else None
        return AppliedLoad(
            kind=self.kind,
            body=body.name,
            point=body.local(position),
            direction=(x / length, y / length),
            fade=fade,
            **self.law(angular_speed, fade, motor=motor),
        )

    def law(self, angular_speed: float, fade: float | None, *, motor: bool) -> dict[str, Any]:
        """Return what an `AppliedLoad` has by its kind.

        Args:
            angular_speed: of the crank, rad/s.
            fade: speed of the output from which a forming force acts in full, m/s, or None.
            motor: whether the crank's speed varies.
        """
        return {"over": self.over, "curve": self.curve(angular_speed)}

    def check_code(self, where: str, angular_speed: float) -> None:
        """Try the code of a kind of the user's own, for messages that begin with `where`."""

    @abstractmethod
    def curve(self, angular_speed: float) -> LoadCurve:
        """Return the force over its variable at a speed of the crank, rad/s."""


def _unknown_curve(load: Load, angular_speed: float) -> LoadCurve:
    """Return forces that are no numbers, of a load whose code is not loaded."""
    return LoadCurve([0.0, 1.0], [math.nan, math.nan])


@dataclass(frozen=True)
class CustomLoad(Load, ABC):
    """Base of a load kind of your own; `kind = "my_module:MyClass"` names it in a scene.

    The derived dataclass declares its keys by `exu_press.schema.checks.key`, and `over`, one of
    "time" (s), "crank_angle_deg" (its curve is over rad) and "height" (m), as class variables.
    """

    over: ClassVar[str] = "height"
    closing: ClassVar[bool] = False
    when_unresolved: ClassVar[Mapping[str, Any]] = {"over": "time", "curve": _unknown_curve}

    def check_code(self, where: str, angular_speed: float) -> None:
        """Make its curve once, so that it is refused before anything is run."""
        own = [field.name for field in dataclasses.fields(self) if field.default is None]
        own = [name for name in own if name not in ATTACHMENT]
        if needs := missing_keys(where, self, own, "", "[{path}]"):
            raise MissingKeysError(needs)
        if self.over not in COLUMNS:
            raise InputError(
                f"{where}: {self.kind}.over = {self.over!r}: allowed is one of {COLUMNS}"
            )
        with error_prefix(f"{where}: "):
            curve = self.curve(angular_speed)
        if not isinstance(curve, LoadCurve):
            raise InputError(
                f"{where}: {self.kind}.curve() returns {curve!r:.80}: allowed is a LoadCurve"
            )

    @abstractmethod
    def curve(self, angular_speed: float) -> LoadCurve:
        """Return the force, N, at a speed of the crank, rad/s."""


def check_height(height: float, mechanism: Mechanism) -> None:
    """Raise InputError unless the output leaves a sheet or spring at a height, m."""
    if height >= mechanism.stroke:
        raise InputError(
            f"height = {height!r}: the output rises {mechanism.stroke:.4g} m above bottom dead "
            "centre and never leaves it; allowed is less than that"
        )
