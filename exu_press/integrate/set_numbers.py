"""Numbers that a pre-step function sets in Exudyn's items, interpolated between its calls."""

import math
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from typing import Any

import exudyn as exu
import numpy as np

__all__ = ["SetNumbers"]

KINDS = "Object", "Load", "Node", "Marker"

Key = tuple[str, int, str]
"""Kind and number of an item, and the name of its parameter."""


class SetNumbers:
    r"""Lets numbers go over from what they are to what a pre-step function sets.

    Fixed steps know a force, an offset or a stiffness at their ends only, for which such a function
    is called. Between them the motion is that of numbers that go over. If shorter steps held what
    is set, they would follow a staircase. So a number is, at a part $\theta$ of the interval,

    $$ u = u_k + \theta (u_{k+1} - u_k) - \tfrac12 \theta (1 - \theta) d_k, $$

    with, of the second differences $u_{k+1} - 2 u_k + u_{k-1}$ and $u_k - 2 u_{k-1} + u_{k-2}$, the
    lesser as $d_k$, or zero where their signs differ: essentially non-oscillatory interpolation
    (Harten, Engquist, Osher, Chakravarthy, J. Comput. Phys. 71, 1987). A trajectory is followed to
    the third order, and a switch goes over in a straight line.

    What is no float is set at once, as flags and indices; numbers of the same item too, if a call
    changes such. So is what reaches forces in another way than by Exudyn's `Set...Parameter`. What
    other functions set stays as they set it.

    Attributes:
        fresh: whether a number changes for the first time in the interval.
        others: how often other functions have changed a number.
    """

    def __init__(self, mbs: exu.MainSystem) -> None:
        """Take the system whose items are set."""
        self._mbs = mbs
        self._known: dict[Key, _Number] = {}
        self._changed: set[tuple[str, int]] = set()  # items of which a call sets something else
        self._changes: set[Key] = set()  # what has changed so far
        self._calling = self._unseen = self.fresh = False
        self._begin = self._end = 0.0  # of the interval, s
        self._now = math.nan  # the time for which they are set
        self.others = 0

    @contextmanager
    def watched(self) -> Iterator[None]:
        """See what functions set meanwhile."""
        names = [f"Set{kind}Parameter" for kind in KINDS]
        before = [getattr(exu.MainSystem, name) for name in names]
        for kind, name, setter in zip(KINDS, names, before, strict=True):
            setattr(exu.MainSystem, name, self._seeing(kind, setter))
        try:
            yield
        finally:
            for name, setter in zip(names, before, strict=True):
                setattr(exu.MainSystem, name, setter)

    def _seeing(self, kind: str, setter: Any) -> Any:
        """Return a function that does what one of Exudyn's does, and sees it."""
        getter = getattr(exu.MainSystem, f"Get{kind}Parameter")
        names = f"{kind.lower()}Number", "parameterName", "value"

        def see(system: Any, *args: Any, **keys: Any) -> None:
            if self._unseen or system is not self._mbs:
                setter(system, *args, **keys)
                return
            given: list[Any] = [*args, *[keys.get(each) for each in names[len(args) :]]]
            number, name, value = given
            before: Any = None
            with suppress(exu.ExudynError, TypeError):  # the setter says it, or cannot be asked
                before = getter(system, number, name)
            setter(system, *args, **keys)
            key = kind, int(number), name
            old, new = _flat(before, "f"), _flat(value, "fiu")
            a_number = old is not None and new is not None and len(old) == len(new)
            if not self._calling:
                self._known.pop(key, None)
                self.others += a_number and old != new
            elif old is None or new is None or not a_number:
                self._known.pop(key, None)
                if not np.array_equal(before, value):
                    self._changed.add(key[:2])
            elif key in self._known:
                self._known[key].new = new
            elif old != new:
                self._known[key] = _Number(setter, key, value, old, new)

        return see

    def call(self, function: Callable[[], bool], begin: float, end: float) -> bool:
        """Call a function that sets what is to be at the end of an interval; return its word."""
        self.at(self._end)
        self._changed.clear()
        self._calling = True
        go_on = function()
        self._calling = False
        self._begin = begin
        self._end = self._now = end
        for key, number in list(self._known.items()):
            number.renew()
            if number.still or key[:2] in self._changed:
                del self._known[key]
        self.fresh = not self._known.keys() <= self._changes
        self._changes.update(self._known)
        return go_on

    def unseen(self, function: Callable[[], object]) -> None:
        """Call a function whose numbers are not kept."""
        self._unseen = True
        function()
        self._unseen = False
        self._now = math.nan

    def at(self, time: float) -> None:
        """Set what numbers are at a time within the interval, s."""
        if time == self._now:
            return
        self._now = time
        part = 1.0 if time >= self._end else (time - self._begin) / (self._end - self._begin)
        for number in self._known.values():
            number.put(self._mbs, part)


class _Number:
    """A parameter that is a number, or an array of them.

    Attributes:
        new: what it is at the interval's end.
        still: whether it has been the same for as long as is known.
    """

    def __init__(
        self, setter: Any, key: Key, value: Any, old: list[float], new: list[float]
    ) -> None:
        """Take how it is set, and what it was and is to be; a value has its shape and type."""
        self._set, (_, self._item, self._name) = setter, key
        self._shape = np.shape(value)
        self._array = isinstance(value, np.ndarray)
        self._first = self._second = self._third = old
        self._old, self.new, self._bend, self.still = old, new, old, False

    def renew(self) -> None:
        """Begin with an interval at whose end it is `new`."""
        u0, u1, u2, u3 = self._first, self._second, self._third, self.new
        self._first, self._second, self._third = u1, u2, u3
        self._old, self.still = u2, u0 == u1 == u2 == u3
        self._bend = [
            _lesser(u3[i] - 2.0 * u2[i] + u1[i], u2[i] - 2.0 * u1[i] + u0[i])
            for i in range(len(u3))
        ]

    def put(self, mbs: exu.MainSystem, part: float) -> None:
        """Set it to what it is at a part of the interval."""
        values = self.new
        if part < 1.0:
            old, new, bend, by = self._old, self.new, self._bend, 0.5 * part * (1.0 - part)
            values = [old[i] + part * (new[i] - old[i]) - by * bend[i] for i in range(len(new))]
        given: Any = values if self._shape else values[0]
        if self._array:
            given = np.array(given)
        if len(self._shape) > 1:
            given = np.reshape(given, self._shape)
        self._set(mbs, self._item, self._name, given)


def _flat(value: Any, kinds: str) -> list[float] | None:
    """Return the finite numbers, of these kinds of NumPy's, in a number or array; else nothing."""
    if type(value) is bool:
        return None
    try:
        found = np.asarray(value)
    except ValueError:  # rows of differing length
        return None
    if found.dtype.kind not in kinds:
        return None
    flat: list[float] = [float(each) for each in found.ravel().tolist()]
    return flat if all(math.isfinite(each) for each in flat) else None


def _lesser(one: float, other: float) -> float:
    """Return the lesser of two numbers, or zero where their signs differ."""
    if one * other <= 0.0:
        return 0.0
    return one if abs(one) < abs(other) else other
