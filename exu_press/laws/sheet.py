"""A sheet that a punch cuts: shear up to fracture, the crack, and stripping on the way up."""

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Literal

from exu_press.laws.load_curve import LoadCurve, PulseClock, closing

__all__ = ["SHAPE", "Clock", "PunchStroke", "Sheet", "shear_force"]

SHAPE = (0.0, 0.15, 0.5, 1.0), (0.0, 0.8, 1.0, 0.95)
"""Penetration over that at fracture, and force over the largest one, of the usual curve: elastic
and plastic indentation, a flat top where hardening balances the smaller section, a slight fall."""

LONG_AGO = -1e30
"""s."""

Phase = Literal["whole", "cracking", "cut"]


def shear_force(strength: float, length: float, thickness: float) -> float:
    r"""Return the largest force that cuts a sheet.

    .. math::
        F_{max} = k_s \, l \, s

    Parameters
    ----------
    strength : k_s, shear strength of the sheet [Pa], about 0.8 of the tensile strength
    length : l of the line that is cut [m]
    thickness : s [m]

    Returns
    -------
    F_max [N].

    Notes
    -----
    Range: flat punch, edges that are sharp. Blunt ones take up to 1.6 times as much.

    Examples
    --------
    A hole of 20 mm in 2 mm of mild steel:

    >>> round(shear_force(320e6, 3.1416 * 0.02, 0.002))
    40212

    References
    ----------
    .. [1] Schuler GmbH. Metal Forming Handbook. Springer, 1998, section 4.4 (shearing).
    """
    return strength * length * thickness


@dataclass(frozen=True)
class Sheet:
    """A sheet on its die.

    Attributes:
        curve: force up to fracture over the penetration, N over m; its first line is elastic.
        thickness: m.
        crack_time: from fracture to no force, s.
        stripping: force that holds the punch back on its way up, wholly within the sheet, N.
        fade: speed from which stripping acts in full, m/s.
    """

    curve: LoadCurve
    thickness: float
    crack_time: float
    stripping: float
    fade: float

    @property
    def fracture(self) -> float:
        """Penetration at fracture, m."""
        return self.curve.places[-1]

    def stripping_force(self, penetration: float, rate: float) -> float:
        r"""Return the force on a punch that leaves the sheet, N, against its motion.

        .. math::
            F_s = F_{s,0} \, \min(1, x / s) \, p(\dot x)

        It is in proportion to the part x of the thickness s that grips the punch, and fades as the
        punch comes to rest (`closing`).

        Parameters
        ----------
        penetration : x [m]
        rate : its rate [m/s], negative on the way up
        """
        if penetration <= 0.0 or rate >= 0.0:
            return 0.0
        return self.stripping * min(1.0, penetration / self.thickness) * closing(rate, self.fade)


class PunchStroke:
    """The stroke of a punch through a sheet, with the state of the sheet.

    The penetration decides, not the clock. Up to fracture the force follows the curve at the
    largest penetration; a punch that goes back unloads the sheet along the curve's first line. From
    fracture on the force falls to zero within the crack time. A new sheet lies there as soon as the
    punch has left the cut one. A run that starts with the punch in the sheet starts with a cut one.

    >>> sheet = Sheet(LoadCurve([0.0, 1e-3], [0.0, 4e4]), 2e-3, 1e-3, 0.0, 1e-3)
    >>> cut = PunchStroke(sheet)
    >>> cut.accept(-0.01, -1e-3, 0.1)
    >>> cut.force(0.0, 0.5e-3, 0.1)
    20000.0
    >>> cut.accept(0.0, 1.1e-3, 0.1)  # fractured a millisecond ago
    >>> round(cut.force(-0.5e-3, 1.1e-3, 0.1), 3), cut.force(0.0, 1.1e-3, 0.1)
    (20000.0, 0.0)
    """

    def __init__(self, sheet: Sheet) -> None:
        self._sheet = sheet
        self._deepest = 0.0
        self._fractured: float | None = None
        self._started = False

    def phase(self, time: float, penetration: float) -> Phase:
        """Return the sheet's state at an instant, s, and a penetration, m."""
        if self._fractured is None:
            return "whole" if penetration < self._sheet.fracture else "cracking"
        return "cracking" if time < self._fractured + self._sheet.crack_time else "cut"

    def force(self, time: float, penetration: float, rate: float) -> float:
        """Return the force against the punch's way down, N.

        Args:
            time: s.
            penetration: of the punch into the sheet, m; negative above it.
            rate: of the penetration, m/s.
        """
        if not self._started:
            self._start(penetration)
        sheet, phase = self._sheet, self.phase(time, penetration)
        if phase == "cut":
            return 0.0 - sheet.stripping_force(penetration, rate)
        if phase == "cracking":
            remaining = 1.0 - self._since(time, penetration, rate) / sheet.crack_time
            return sheet.curve.forces[-1] * min(1.0, max(0.0, remaining))
        if penetration >= self._deepest or self._deepest <= self._elastic:
            return sheet.curve(penetration)
        unloaded = sheet.curve(self._deepest) - self._stiffness * (self._deepest - penetration)
        return max(0.0, unloaded)

    def next(
        self,
        time: float,
        penetration: float,
        rate: float,
        close: float = 0.0,
        duration: Callable[[float], float] = float,
    ) -> float:
        """Return the next instant at which the force has a corner, s, or infinity.

        Args:
            time: s.
            penetration: m.
            rate: m/s.
            close: corners as near as that are passed, m.
            duration: of a way, s, that takes a time at this rate, s.
        """
        sheet, phase = self._sheet, self.phase(time, penetration)
        if phase == "cracking":
            end = time - self._since(time, penetration, rate) + sheet.crack_time
            return end if end > time + 1e-9 * sheet.crack_time else math.inf
        if rate == 0.0:
            return math.inf
        corners = [0.0, sheet.thickness]
        if phase == "whole":
            loose = self._deepest - sheet.curve(self._deepest) / self._stiffness
            corners = [*(x for x in sheet.curve.places if x > self._deepest), self._deepest, loose]
        ahead = [x - penetration for x in corners if (x - penetration) * rate > close * abs(rate)]
        remaining = sheet.fracture - penetration
        if phase == "whole" and 0.0 <= remaining <= close and rate > 0.0:
            return time + remaining / rate + sheet.crack_time  # as good as fractured
        return time + duration(min((distance / rate for distance in ahead), default=math.inf))

    def accept(self, time: float, penetration: float, rate: float) -> None:
        """Keep the state at the end of a step."""
        if not self._started:
            self._start(penetration)
        if self._fractured is not None:
            if penetration <= 0.0 and self.phase(time, penetration) == "cut":
                self._fractured, self._deepest = None, 0.0
        elif penetration >= self._sheet.fracture:
            self._fractured = time - self._since(time, penetration, rate)
        elif penetration <= 0.0:
            self._deepest = 0.0
        else:
            self._deepest = max(self._deepest, penetration)

    def memory(self) -> tuple[float, float | None]:
        """Return the largest penetration, m, and when the sheet fractured, s."""
        return self._deepest, self._fractured

    def recall(self, memory: tuple[float, float | None]) -> None:
        """Take over another's memory."""
        self._deepest, self._fractured = memory
        self._started = True

    def _start(self, penetration: float) -> None:
        """Start a run: with a punch in the sheet it is cut."""
        self._started = True
        if penetration > 0.0:
            self._fractured = LONG_AGO

    @property
    def _elastic(self) -> float:
        return self._sheet.curve.places[1]

    @property
    def _stiffness(self) -> float:
        return self._sheet.curve.forces[1] / self._elastic

    def _since(self, time: float, penetration: float, rate: float) -> float:
        """Return the time since the fracture, s, in a step that ends behind it too."""
        if self._fractured is not None:
            return time - self._fractured
        return (penetration - self._sheet.fracture) / rate if rate > 0.0 else 0.0


Clock = PulseClock | PunchStroke
"""The memory of a load from step to step."""
