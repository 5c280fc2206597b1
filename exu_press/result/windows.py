"""Parts of a run's record."""

import numpy as np

from exu_press.result.result import Result

__all__ = ["revolutions_of", "until", "window"]


def window(run: Result, begin: float, end: float) -> Result:
    """Return a run's record between two instants, s, both of them included."""
    first = int(np.searchsorted(run.time, begin * (1.0 - 1e-12)))
    last = int(np.searchsorted(run.time, end * (1.0 + 1e-12), side="right"))
    return run.with_values({name: run[name][first:last] for name in run})


def until(run: Result, end: float) -> Result:
    """Return a run's record up to an instant, s."""
    return window(run, float(run.time[0]), end)


def revolutions_of(run: Result) -> list[Result]:
    """Return the records of a run's whole revolutions."""
    period = 60.0 / run.scene.speed_rpm
    count = int((run.time[-1] - run.time[0]) / period * (1.0 + 1e-9))
    return [window(run, k * period, (k + 1) * period) for k in range(count)]
