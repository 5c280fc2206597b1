"""Joints of a kind that a user writes."""

import dataclasses
from abc import ABC, abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from exu_press.errors import InputError, Need
from exu_press.scene.joint import Joint
from exu_press.schema.checks import key
from exu_press.schema.table import missing_keys

if TYPE_CHECKING:
    from exu_press.joints.interface import InterfaceLaw

__all__ = ["CustomJoint"]


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

    def missing_keys(self, path: str) -> list[Need]:
        """Return which of its keys without default are missing."""
        keys = [field.name for field in dataclasses.fields(self) if self.resolved]
        return missing_keys(path, self, keys, "", "[{path}]")

    def check_laws(self) -> None:
        """Raise InputError unless it has interface laws."""
        laws = self.interfaces()
        if not isinstance(laws, list | tuple) or not laws:
            raise InputError(
                f"{self.kind}.interfaces() returns {laws!r:.80}: allowed is a list of one "
                "interface law or more"
            )
