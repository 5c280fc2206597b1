"""The instants of an animation: equally spaced, and the steps between them."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from exu_press.errors import InputError
from exu_press.numerics.arrays import Array
from exu_press.result import Result
from exu_press.result.windows import interval

__all__ = ["SECONDS_PER_REVOLUTION", "Instants", "instants", "moment"]

SECONDS_PER_REVOLUTION = 5.0
"""Length of the animation, unless told otherwise, s."""

MOST_FRAMES = 20_000


@dataclass(frozen=True)
class Instants:
    """The frames of an animation.

    Attributes:
        time: (m,) of every frame, s.
        step: (m,) the last step of the integrator that is not later.
        slow: seconds of the animation for a second of the machine.
        fps: frames a second.
        still: only one of the frames is shown: it holds the instant, not the time before.
    """

    time: Array
    step: NDArray[np.intp]
    slow: float
    fps: float
    still: bool = False

    def __len__(self) -> int:
        return len(self.time)

    def steps_since_last(self, frame: int) -> slice:
        """Return the steps since the previous frame, at least one."""
        last = int(self.step[frame])
        first = last if self.still or not frame else int(self.step[frame - 1]) + 1
        return slice(min(first, last), last + 1)


def instants(
    result: Result,
    start: float | None = None,
    stop: float | None = None,
    *,
    fps: float = 25.0,
    slow: float | None = None,
    frames: int | None = None,
) -> Instants:
    """Return the frames of an animation of a run, from start to stop (s; default: all of it).

    Args:
        result: of the run.
        start: s.
        stop: s.
        fps: frames a second.
        slow: seconds of animation for a second of the machine; default: a revolution takes 5 s.
        frames: their number, instead of `slow`.

    Raises:
        InputError: a number is outside its range, or lies outside the record.
    """
    begin, end = interval(result, start, stop)
    if not 1.0 <= fps <= 120.0:
        raise InputError(f"--fps {fps:g}: allowed is 1 to 120 frames a second")
    if frames is not None:
        if slow is not None:
            raise InputError(f"--frames {frames} --slow {slow:g}: allowed is one of the two")
        count = frames
    else:
        if slow is None:
            slow = SECONDS_PER_REVOLUTION * result.scene.speed_rpm / 60.0
        if not slow > 0.0:
            raise InputError(f"--slow {slow:g}: allowed is a number > 0")
        count = max(2, 1 + round(min((end - begin) * slow * fps, 1e9)))
    if not 2 <= count <= MOST_FRAMES:
        raise InputError(f"{count} frames: allowed is 2 to {MOST_FRAMES}; see --frames and --slow")
    times = np.linspace(begin, end, count)
    seconds = (count - 1) / fps
    slow_motion = seconds / (end - begin) if end > begin else 1.0
    return Instants(times, _steps(result.time, times), slow_motion, fps)


def moment(
    result: Result, at: float | None = None, start: float | None = None, stop: float | None = None
) -> Instants:
    """Return three frames, of which the middle one is the instant (s; default: the last one).

    Raises:
        InputError: a time lies outside the record, or the instant outside the interval.
    """
    begin, end = interval(result, start, stop)
    now = end if at is None else at
    if not begin <= now <= end:
        raise InputError(f"--at {now:g}: allowed is {begin:g} to {end:g} s")
    times = np.array([begin, now, end])
    return Instants(times, _steps(result.time, times), 1.0, 1.0, still=True)


def _steps(time: Array, times: Array) -> NDArray[np.intp]:
    """Return the last of the integrator's steps not later than each instant."""
    last_step = np.searchsorted(time, times * (1.0 + 1e-12), side="right") - 1
    return np.clip(last_step, 0, len(time) - 1)
