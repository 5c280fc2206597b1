"""A joint kind of the user's own: its keys, and the interface laws that act in it."""

import traceback
from abc import ABC, abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass
from importlib import import_module
from typing import TYPE_CHECKING, ClassVar

from exu_press.errors import InputError
from exu_press.schema.checks import Table, key

if TYPE_CHECKING:
    from exu_press.joints.interface import InterfaceLaw

__all__ = ["OwnJoint", "own_kind"]


@dataclass(frozen=True)
class OwnJoint(Table, ABC):
    """Base of a joint kind of your own; `kind = "my_module:MyClass"` names it in a scene.

    The derived dataclass declares its keys by `exu_press.schema.checks.key`. A key whose default is
    None has to be given.
    """

    contact: ClassVar[None] = None
    friction: ClassVar[None] = None
    worn: ClassVar[None] = None
    onset: ClassVar[None] = None
    clearance: float = key(None, "eccentricity that others are compared with", "m", above=0)

    @property
    def kind(self) -> str:
        """Name of the class, as a scene has it."""
        return f"{type(self).__module__}:{type(self).__qualname__}"

    @abstractmethod
    def interfaces(self) -> Sequence["InterfaceLaw"]:
        """Return the interface laws that act in parallel; the first has the joint's clearance."""


def _said(error: Exception) -> str:
    """Return an error of an import in words, with file and line of the user's module."""
    kind = "" if isinstance(error, ImportError | AttributeError) else f"{type(error).__name__}: "
    own = [
        frame
        for frame in traceback.extract_tb(error.__traceback__)
        if frame.filename != __file__ and not frame.filename.startswith("<")
    ]
    at = f"{own[-1].filename}, line {own[-1].lineno}: " if own else ""
    if isinstance(error, SyntaxError):
        at, error = f"{error.filename}, line {error.lineno}: ", SyntaxError(error.msg)
    return f"{at}{kind}{error}"


def own_kind(name: object) -> type[OwnJoint] | None:
    """Return the class that "module:class" names; None for a text that is no such name.

    Raises:
        InputError: there is no such module or class, or it is no joint kind.
    """
    if not isinstance(name, str) or ":" not in name:
        return None
    module, _, inside = name.partition(":")
    try:
        found = getattr(import_module(module), inside)
    except Exception as error:  # a module of the user's own may raise anything
        raise InputError(
            f"kind = {name!r}: {_said(error)}; allowed is a module that Python finds (PYTHONPATH "
            "names further folders) and one of its classes"
        ) from None
    if not (isinstance(found, type) and issubclass(found, OwnJoint)):
        raise InputError(f"kind = {name!r}: allowed is a dataclass derived from OwnJoint")
    if missing := ", ".join(sorted(found.__abstractmethods__)):
        raise InputError(f"kind = {name!r}: the class has no {missing}, which OwnJoint asks for")
    return found
