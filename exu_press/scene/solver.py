"""[solver]: the time integration."""

import math
from dataclasses import dataclass
from typing import ClassVar

from exu_press.schema.checks import key
from exu_press.schema.registry import alternatives
from exu_press.schema.table import Table

__all__ = ["DEFAULT_TOLERANCE", "RPM", "Solver"]

DEFAULT_TOLERANCE = 1e-3
RPM = math.pi / 30.0  # rad/s

LEAST_STEP = 1e-8
"""s; fixed steps begin a film with ten times as much, at least."""


@dataclass(frozen=True)
class FixedSteps(Table):
    """Steps of one size."""

    table: ClassVar[str] = "solver"
    step: float = key(None, "fixed step size, instead of a tolerance", "s", above=0)


@dataclass(frozen=True)
class ControlledSteps(Table):
    """Steps that follow a tolerance."""

    table: ClassVar[str] = "solver"
    tolerance: float = key(
        DEFAULT_TOLERANCE,
        "local error, relative to the mechanism's scales",
        at_least=1e-8,
        at_most=0.1,
    )
    max_step_deg: float = key(
        1.5, "tolerance: largest step, in degrees of the crank", "deg", above=0, at_most=15
    )
    min_step: float = key(
        LEAST_STEP, "tolerance: a run that would need a smaller step stops", "s", above=0
    )


@dataclass(frozen=True)
class Solver(Table):
    """Exudyn's generalized-alpha, with steps that follow a tolerance or with fixed ones."""

    table: ClassVar[str] = "solver"
    exclusive: ClassVar[tuple[tuple[str, str], ...]] = (("tolerance", "step"),)
    steps: FixedSteps | ControlledSteps = alternatives(
        {"step": "scene.solver:FixedSteps", "": "scene.solver:ControlledSteps"}
    )
    spectral_radius: float = key(
        0.8, "spectral radius at infinity of generalized-alpha", at_least=0.5, at_most=0.95
    )
    max_steps: int = key(  # a million of the press: two to four minutes
        1_000_000, "a run that would need more steps, repeated ones too, stops", at_least=1
    )

    @property
    def tolerance(self) -> float | None:
        """Local error, relative to the mechanism's scales; None with fixed steps."""
        return self.steps.tolerance if isinstance(self.steps, ControlledSteps) else None

    @property
    def max_step_deg(self) -> float:
        """Largest step of those that follow a tolerance, degrees of the crank."""
        assert isinstance(self.steps, ControlledSteps)
        return self.steps.max_step_deg

    @property
    def min_step(self) -> float:
        """Smallest step of those that follow a tolerance, s."""
        return self.steps.min_step if isinstance(self.steps, ControlledSteps) else LEAST_STEP

    @property
    def accuracy(self) -> tuple[str, float]:
        """The key that decides how exact steps are, and its value: a tolerance or a step."""
        if isinstance(self.steps, FixedSteps):
            return "step", self.steps.step
        return "tolerance", self.steps.tolerance

    @property
    def step(self) -> float | None:
        """Size of fixed steps, s, or None."""
        return self.steps.step if isinstance(self.steps, FixedSteps) else None
