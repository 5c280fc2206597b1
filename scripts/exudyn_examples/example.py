"""An example: how it is built, how long it runs, and what its settings need."""

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

import exudyn as exu

__all__ = ["GRAVITY", "Example"]

GRAVITY = 9.81  # m/s^2


@dataclass(frozen=True)
class Example:
    """One system.

    Attributes:
        build: adds its items to an empty mbs.
        end: of the run, s.
        short: end of the quick run, s.
        steps: `numberOfSteps`, which sets the largest step, of the run to `end`.
        change: of the settings, as the user has them.
        positions: whether errors are those of positions: velocities jump in impacts, and a
            millionth of a second makes errors as large as they are.
        finest: tolerance that the system itself can follow.
        most: error over tolerance that is allowed over the whole run.
        twin: name of the example with the same motion whose run is the reference.
        source: the example of Exudyn's repository after which it is written, or what it shows.
    """

    build: Callable[[Any], None]
    end: float
    short: float
    source: str
    steps: int = 100
    positions: bool = False
    finest: float = 1e-6
    most: float = 10.0
    twin: str = ""
    change: Callable[[Any], None] = field(default=lambda settings: None)

    def settings(self, end: float, steps: int | None = None) -> exu.SimulationSettings:
        """Return the user's settings for a run to `end`, s, with steps by tolerance or fixed."""
        settings = exu.SimulationSettings()
        integration = settings.timeIntegration
        integration.endTime = end
        integration.numberOfSteps = steps or max(20, round(self.steps * end / self.end))
        settings.solution.file.write = False
        self.change(settings)
        return settings
