"""[friction]: the law of joints whose surfaces may touch, Eqs. 27-33."""

from abc import ABC, abstractmethod
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, ClassVar

from exu_press.errors import InputError
from exu_press.laws.friction import Friction as LawOfFriction
from exu_press.laws.friction import LuGre as Bristle
from exu_press.laws.friction import coulomb, lugre_steady, no_friction, stribeck
from exu_press.schema.checks import key
from exu_press.schema.kinds import CustomKind
from exu_press.schema.registry import Registry, choice
from exu_press.schema.table import Table, plain

__all__ = ["FRICTION", "OF_GUIDES", "Friction", "FrictionLaw"]

FRICTION = Registry(
    {
        "none": "scene.friction:NoFriction",
        "coulomb": "scene.friction:Coulomb",
        "stribeck": "scene.friction:Stribeck",
        "lugre_steady": "scene.friction:SteadyLuGre",
        "lugre": "scene.friction:LuGre",
    },
    base="scene.friction:FrictionLaw",
)

OILED = "hard steel on hard steel with turbine oil: 0.108, Marks' Handbook, Table 3.2.1"

OF_GUIDES = ("mu_static", "mu_kinetic", "stribeck_velocity", "regularisation_velocity")
"""Keys of friction that guides have of their own; other keys of their law are in [friction]."""


@dataclass(frozen=True)
class FrictionLaw(CustomKind, Table, ABC):
    """Base of the laws of friction, also of your own.

    The derived dataclass declares its keys, which stand in [friction], by
    `exu_press.schema.checks.key`.
    """

    table: ClassVar[str] = "friction"
    largest_coefficient: ClassVar[str] = ""
    """Key of the largest coefficient of friction."""

    @abstractmethod
    def friction(self) -> LawOfFriction | Bristle:
        """Return the law of one joint; a bristle belongs to that joint alone."""


class _LibraryLaw(FrictionLaw):
    """A law of `exu_press.laws.friction`, whose arguments are named as its keys."""

    law: ClassVar[Callable[..., LawOfFriction | Bristle]]

    def friction(self) -> LawOfFriction | Bristle:
        """Return the law of one joint."""
        return type(self).law(**plain(self))


@dataclass(frozen=True)
class NoFriction(_LibraryLaw):
    """No friction."""

    registered_name: ClassVar[str] = "none"
    law = no_friction


def _mu_kinetic() -> Any:
    return key(0.1, "kinetic coefficient; law = 'none' for zero", above=0, source=OILED)


def _sigma_2() -> Any:
    return key(0.0, "viscous coefficient per normal force", "s/m", at_least=0)


def _regularisation() -> Any:
    return key(1e-4, "sgn(v) of laws without bristle is tanh(v / this)", "m/s", above=0)


@dataclass(frozen=True)
class Coulomb(_LibraryLaw):
    """One coefficient."""

    registered_name: ClassVar[str] = "coulomb"
    law = coulomb
    largest_coefficient: ClassVar[str] = "mu_kinetic"
    mu_kinetic: float = _mu_kinetic()
    regularisation_velocity: float = _regularisation()


@dataclass(frozen=True)
class _StribeckCurve(_LibraryLaw):
    """A coefficient that falls from the static to the kinetic one."""

    largest_coefficient: ClassVar[str] = "mu_static"
    mu_static: float = key(
        0.1, "static coefficient; law = 'none' for zero", above=0, source="taken as the kinetic one"
    )
    mu_kinetic: float = _mu_kinetic()
    stribeck_velocity: float = key(0.01, "v_s", "m/s", above=0)
    stribeck_exponent: float = key(2.0, "gamma", above=0)

    def __post_init__(self) -> None:
        super().__post_init__()
        demand_static_friction(self.table, self.mu_static, self.mu_kinetic)


@dataclass(frozen=True)
class Stribeck(_StribeckCurve):
    """Stribeck's curve."""

    registered_name: ClassVar[str] = "stribeck"
    law = stribeck
    sigma_2: float = _sigma_2()
    regularisation_velocity: float = _regularisation()


@dataclass(frozen=True)
class SteadyLuGre(_StribeckCurve):
    """The LuGre law of steady sliding."""

    registered_name: ClassVar[str] = "lugre_steady"
    law = lugre_steady
    sigma_2: float = _sigma_2()
    regularisation_velocity: float = _regularisation()


@dataclass(frozen=True)
class LuGre(_StribeckCurve):
    """The LuGre law with its bristle."""

    registered_name: ClassVar[str] = "lugre"
    law = Bristle
    sigma_0: float = key(1e5, "bristle stiffness per normal force", "1/m", above=0)
    sigma_1: float = key(316.0, "bristle damping per normal force", "s/m", at_least=0)
    sigma_2: float = _sigma_2()


@dataclass(frozen=True)
class Friction(Table):
    """Friction of every joint whose surfaces may touch."""

    table: ClassVar[str] = "friction"
    law: FrictionLaw = choice("coulomb", "friction law", FRICTION)

    def friction(self) -> LawOfFriction | Bristle:
        """Return the law of one joint."""
        return self.law.friction()


def demand_static_friction(table: str, mu_static: float, mu_kinetic: float) -> None:
    """Raise InputError for a static coefficient below the kinetic one."""
    if mu_static < mu_kinetic:
        raise InputError(
            f"{table}.mu_static = {mu_static!r}: allowed is a number >= "
            f"{table}.mu_kinetic = {mu_kinetic!r}"
        )
