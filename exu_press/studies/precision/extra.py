"""What a campaign adds to a case of its own: a reference, other solvers, another system."""

from collections.abc import Sequence
from typing import Protocol

from exu_press.scene import Scene
from exu_press.studies.precision.amount import Amount
from exu_press.studies.precision.errors import Errors
from exu_press.studies.precision.measured import Attempt
from exu_press.studies.precision.trajectory import Trajectory
from exu_press.studies.precision.truth import Reference

__all__ = ["Extra"]


class Extra(Protocol):
    """The campaign's part of a case."""

    @property
    def duration(self) -> float | None:
        """Return how long its system is simulated, s; None where it is a scene."""
        ...

    def reference(self, scene: Scene | None, amount: Amount) -> Reference:
        """Return the truth of the case."""
        ...

    def attempts(
        self,
        scene: Scene | None,
        amount: Amount,
        steps: Sequence[float],
        tolerances: Sequence[float],
    ) -> list[Attempt]:
        """Return the runs beside the package's own ones on the scene."""
        ...

    def errors(self, run: Trajectory) -> Errors | None:
        """Return the errors of a run of its system; None where it is compared as any scene."""
        ...
