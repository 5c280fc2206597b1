"""A wear study: its keys and their check."""

import dataclasses
from collections.abc import Mapping
from types import MappingProxyType
from typing import Any, cast

from exu_press.errors import InputError
from exu_press.quantities import quantity_of
from exu_press.quantities.catalogue import DEAD_CENTRE, JOINT_FORCE
from exu_press.schema.checks import key
from exu_press.schema.table import Table
from exu_press.studies.base import Study
from exu_press.studies.base.keys import Key
from exu_press.studies.base.study import names_in
from exu_press.studies.wear.shape import Depths, worn_scene

__all__ = ["Strokes", "WearStudy"]


@dataclasses.dataclass(frozen=True)
class Strokes(Table):
    """The table [wear] of a study file.

    Attributes:
        quantities: full names; by default dead centre and joint forces.
    """

    table = "wear"

    required = ("strokes",)

    strokes: float = key(None, "revolutions of the crank", above=0)
    tolerance: float = key(
        0.01,
        "depths of a jump and of its two halves may differ by that, over the clearance",
        above=0,
        at_most=0.5,
    )
    most_jumps: int = key(100, "the study ends after so many", at_least=1, at_most=100000)
    quantities: tuple[str, ...] | None = None

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.quantities is not None:
            names = names_in("wear.quantities", self.quantities)
            object.__setattr__(self, "quantities", names)


@dataclasses.dataclass(frozen=True)
class WearStudy(Study):
    """A wear study's file, complete: a scene with [wear], and how many strokes.

    Raises:
        InputError: nothing in the scene wears, its runs are shorter than a revolution, or keys are
            given that it does not use.
    """

    with_keys = plain_runs = False
    tables = MappingProxyType({"wear": Strokes})

    keys: Mapping[str, Key] = dataclasses.field(default_factory=dict)
    wear: Strokes = dataclasses.field(default=cast(Any, None))

    def __post_init__(self) -> None:
        if self.keys:
            raise InputError("[keys]: not used by exu-press wear; remove them")
        super().__post_init__()
        scene = self.scene
        if scene.wear is None:
            raise InputError("scene: has no [wear]; allowed is a scene with Archard's coefficient")
        if not self.joints:
            raise InputError(
                "scene: no joint wears; allowed is a revolute joint that is dry or has a mixed film"
            )
        if scene.revolutions - scene.settle_revolutions < 1.0:
            raise InputError(
                f"revolutions = {scene.revolutions:g}, of which {scene.settle_revolutions:g} "
                "settle: allowed is one revolution more at least, of which wear is read"
            )
        for name in self.names:
            quantity_of(scene, name)
        worn_scene(scene, {name: Depths.even(1e-9) for name in self.joints})

    @property
    def joints(self) -> tuple[str, ...]:
        """The joints that wear."""
        return tuple(self.scene.wearing["joints"])

    @property
    def names(self) -> tuple[str, ...]:
        """Full names of the quantities that are followed."""
        if self.wear.quantities is not None:
            return self.wear.quantities
        return DEAD_CENTRE.name, *(JOINT_FORCE.full_name(name) for name in self.joints)
