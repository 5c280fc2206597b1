"""What errors are relative to: given, or found from the motion as it goes."""

import math
from dataclasses import dataclass

__all__ = ["FoundScales", "Scales"]


@dataclass(frozen=True)
class Scales:
    """What errors are relative to; None is found from the motion as it goes.

    Attributes:
        speed: of the bodies, m/s; found: the largest so far.
        force: Newton's method balances forces to a part of it, N; found: what accelerates all
            bodies together, at most so far.
    """

    speed: float | None = None
    force: float | None = None


class FoundScales:
    """The scales of a run so far.

    A system at rest has no speed yet: what its first accelerations make of it within the largest
    step counts instead, or on their way through the widest clearance.

    Attributes:
        speed: m/s.
        force: N.
        length: of the coordinates whose last digits are rounded, m.
        ends: where each node's coordinates end among all.
        inertias: the mass matrix's diagonal, kg and kg m^2.
        masses: of the nodes, kg, infinite for what has no say; where the system gives none, the
            node's largest kinetic energy over half the square of `speed`.
    """

    def __init__(self, given: Scales, length: float) -> None:
        """Take what is given; the rest is found from `begin` on."""
        self.length = length
        self._given = given
        self.ends: list[int] = []
        self.inertias: list[float] = []
        self._own: list[bool] = []
        self._energies: list[float] = []  # twice the largest kinetic energy of each node so far
        self.masses: list[float] = []
        self.speed = given.speed or 0.0
        self.force = given.force or 0.0
        self.fixed = False
        self._longest = 0.0

    def begin(
        self,
        starts: list[int],
        inertias: list[float],
        masses: list[float],
        velocities: list[float],
        accelerations: list[float],
        places: list[float],
        longest: float,
        widest: float,
    ) -> None:
        """Look at the state from which the run starts.

        Args:
            starts: where each node's coordinates begin among all; those of the first one at 0.
            inertias: the mass matrix's diagonal, kg and kg m^2.
            masses: of the nodes, kg; 0.0 where they are to be found.
            velocities: of all coordinates.
            accelerations: of all coordinates.
            places: the coordinates, which angles and Euler parameters are among.
            longest: step, s.
            widest: clearance, m, or 0.0 without clearance joints.
        """
        self.ends = [*starts[1:], len(inertias)] if starts else []
        self.inertias, self.masses = inertias, list(masses)
        self._own = [mass == 0.0 for mass in masses]
        self._energies = [0.0 for _ in masses]
        self._longest = longest
        squares = zip(self._sums(places), masses, strict=True)
        widths = [math.sqrt(s / m) for s, m in squares if m > 0.0]
        self.length = max([self.length, *widths]) or 1.0  # where all is zero
        given = self._given.speed, self._given.force
        self.fixed = True not in self._own and None not in given
        if self.fixed:
            return
        powers = zip(self._sums(accelerations), masses, strict=True)
        largest = math.sqrt(max((p / m for p, m in powers if m > 0.0), default=0.0))
        time = longest
        if widest > 0.0 and largest > 0.0:
            time = min(longest, math.sqrt(4.0 * widest / largest))
        self.update([time * value for value in accelerations], accelerations)
        self.update(velocities, accelerations)

    @property
    def resting(self) -> bool:
        """Whether the system moves by less than a billionth of its length in the longest step."""
        return self.speed * self._longest <= 1e-9 * self.length

    def set_out(self, velocities: list[float], accelerations: list[float]) -> None:
        """Be told of a state that a step was tried to, in which a system may have left its rest."""
        if self.resting:
            self.update([self._longest * value for value in accelerations], accelerations)
            self.update(velocities, accelerations)

    def update(self, velocities: list[float], accelerations: list[float]) -> None:
        """Be told of a state."""
        if self.fixed:
            return
        energies = self._sums(velocities)
        speed_2 = 0.0
        for i, mass in enumerate(self.masses):
            self._energies[i] = max(self._energies[i], energies[i])
            if not self._own[i]:
                speed_2 = max(speed_2, energies[i] / mass)
        if self._given.speed is None:
            self.speed = max(self.speed, math.sqrt(speed_2))
            if self.speed == 0.0 and True in self._own:
                self.speed = 1.0  # nothing is displaced: any speed will do, energies count
        for i, own in enumerate(self._own):
            if own:
                square = self.speed * self.speed
                self.masses[i] = self._energies[i] / square if square > 0.0 else 0.0
        if self._given.force is None:
            forces = sum((m * a) ** 2 for m, a in zip(self.inertias, accelerations, strict=True))
            self.force = max(self.force, math.sqrt(forces))

    def _sums(self, vector: list[float]) -> list[float]:
        """Return the sum of inertia times square over each node's coordinates."""
        found: list[float] = []
        i = 0
        for end in self.ends:
            total = 0.0
            while i < end:
                total += self.inertias[i] * vector[i] * vector[i]
                i += 1
            found.append(total)
        return found

    def squares(self, vector: list[float]) -> list[float]:
        """Return the squares of each body's kinetic norm of a vector over all coordinates."""
        sums = self._sums(vector)
        return [s / m if m > 0.0 else 0.0 for s, m in zip(sums, self.masses, strict=True)]

    def alternating(self, rounding: float, alpha_f: float) -> float:
        """Return what rounded positions make of accelerations, times the step's square, m.

        Args:
            rounding: of positions, over the largest one, in each step.
            alpha_f: generalized-alpha's; its spectral radius is alpha_f / (1 - alpha_f).
        """
        radius = min(alpha_f / (1.0 - alpha_f), 0.95)
        return rounding * self.length / (1.0 - radius) ** 2
