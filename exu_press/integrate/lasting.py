"""Newton's matrix of an earlier step, where it may serve for further ones."""

from exu_press.integrate.settings import SAME

__all__ = ["Lasting"]

LONGEST_PAUSE = 64
"""Steps without another try."""


class Lasting:
    """What is costly to make, and serves for steps of one size.

    Where it does not, the motion changes it too fast, and fresh ones are made for as many steps as
    have been tried in vain before, doubled.
    """

    def __init__(self) -> None:
        """Know nothing yet."""
        self._step = 0.0  # that it was made for, s
        self._pause, self._wait = 1, 0  # steps with fresh ones: after the next failure, and now

    def serves(self, step: float) -> bool:
        """Return whether it may serve for a step (s); else one is to be made."""
        kept = self._wait == 0 and abs(step - self._step) <= SAME * step
        if not kept:
            self._step = step
        if self._wait:
            self._wait -= 1
        return kept

    def drop(self) -> None:
        """Be told that it is gone: the next step needs another one."""
        self._step = 0.0

    def failed(self) -> None:
        """Be told that it has not served."""
        self._wait = self._pause
        self._pause = min(2 * self._pause, LONGEST_PAUSE)

    def served(self) -> None:
        """Be told that it has: after the next failure one step goes by without another try."""
        self._pause = 1
