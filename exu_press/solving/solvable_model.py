"""Interface of a scene's model to its integration."""

from abc import ABC, abstractmethod
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field

import exudyn as exu

from exu_press.joints.joint import ClearanceJoint, States
from exu_press.mechanism import Mechanism
from exu_press.mechanism.independent_constraints import IndependentConstraints
from exu_press.scene import Scene

__all__ = ["SolvableModel"]


@dataclass(frozen=True)
class SolvableModel(ABC):
    """What integration needs of a scene's model; `exu_press.model.Model` is one.

    Attributes:
        scene: of the model.
        mechanism: bodies, joints and guides.
        constraints: independent ones of ideal joints and guides.
        mbs: Exudyn's main system, assembled.
        nodes: name -> node number.
        clearance_joints: name -> joint.
        guideways: name of a body with clearance in its guide -> the contacts of its two ends, and
            the film where there is one.
        states: of clearance joints and guideways at the steps of the last run.
        sensors: (name, quantity) -> sensor number.
        begin: time of the start, s.
        first_step: s; 0.0 where the integration finds it.
    """

    scene: Scene
    mechanism: Mechanism
    constraints: IndependentConstraints
    mbs: exu.MainSystem
    nodes: dict[str, int]
    clearance_joints: dict[str, ClearanceJoint]
    guideways: Mapping[str, tuple[ClearanceJoint, ...]]
    states: States
    sensors: dict[tuple[str, str], int]
    begin: float = field(default=0.0, kw_only=True)
    first_step: float = field(default=0.0, kw_only=True)

    @abstractmethod
    def next_corner(self, time: float) -> float:
        """Return the next instant at which a load has a corner or a sample lies, s, or infinity."""

    @property
    @abstractmethod
    def event(self) -> Callable[[exu.MainSystem, float], float] | None:
        """A function that changes its sign at the samples of a motor's crank, or None."""

    @abstractmethod
    def watch(self, time: float) -> str:
        """Return why the press goes no further, after a step that ends at a time, s, or nothing."""
