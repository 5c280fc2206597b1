"""Joints of a kind that a user writes."""

import dataclasses
from abc import ABC, abstractmethod
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar, Self

from exu_press.errors import InputError
from exu_press.scene.joint import Joint
from exu_press.schema.checks import key
from exu_press.schema.kinds import refusal
from exu_press.schema.table import demand_keys

if TYPE_CHECKING:
    from exu_press.joints.interface import InterfaceLaw

__all__ = ["CustomJoint", "UnresolvedJoint"]


@dataclass(frozen=True)
class CustomJoint(Joint, ABC):
    """Base of a joint kind of your own; `kind = "my_module:MyClass"` names it in a scene.

    The derived dataclass declares its keys by `exu_press.schema.checks.key`. A key whose default is
    None has to be given.
    """

    clearance: float = key(None, "eccentricity that others are compared with", "m", above=0)

    @abstractmethod
    def interfaces(self) -> Sequence["InterfaceLaw"]:
        """Return the interface laws that act in parallel; the first has the joint's clearance."""

    def demand_keys(self, path: str) -> None:
        """Raise InputError for the first key without default that is missing."""
        keys = [field.name for field in dataclasses.fields(self)]
        demand_keys(path, self, keys, "", f"[{path}]")

    def check_laws(self) -> None:
        """Raise InputError unless it has interface laws."""
        laws = self.interfaces()
        if not isinstance(laws, list | tuple) or not laws:
            raise InputError(
                f"{self.kind}.interfaces() returns {laws!r:.80}: allowed is a list of one "
                "interface law or more"
            )


@dataclass(frozen=True)
class UnresolvedJoint(CustomJoint):
    """A joint of a result whose kind is code that is not loaded: it is shown, and not built.

    Attributes:
        name: of the kind.
        keys: as the result has them.
    """

    resolved: ClassVar[bool] = False
    name: str = ""
    keys: Mapping[str, Any] = dataclasses.field(default_factory=dict, hash=False)

    @classmethod
    def from_keys(cls, name: str, keys: Mapping[str, Any]) -> Self:
        """Return the joint of a kind and its keys."""
        clearance: Any = keys.get("clearance")
        return cls(clearance, name, keys)

    @property
    def kind(self) -> str:
        """Name of the class, as the result has it."""
        return self.name

    def demand_keys(self, path: str) -> None:
        """Demand nothing: the keys are unknown."""

    def to_dict(self, laws: Mapping[str, Mapping[str, Any] | None]) -> dict[str, Any]:
        """Return the keys that the result has."""
        return {"kind": self.name, **self.keys}

    def interfaces(self) -> Sequence["InterfaceLaw"]:
        """Raise InputError: the laws are unknown."""
        raise InputError(refusal(self.name))
