"""The four-bar with clearance in its knuckle, reduced to the angles of coupler and rocker.

The crank turns at constant speed about the origin and carries the coupler in an ideal joint; the
rocker turns about an ideal pivot. Links are uniform rods.
"""

from cmath import exp, phase
from dataclasses import dataclass
from math import pi

from independent.clearance import Clearance, Reduced, moment
from independent.reduced_slider_crank import Numbers


@dataclass(frozen=True)
class ReducedFourBar(Reduced):
    """Coordinates: directions of the coupler (crank pin to knuckle) and rocker (pivot to it)."""

    kind: str
    numbers: Numbers
    pin: complex = 0.1j
    knuckle: complex = 0.36 + 0.3j
    pivot: complex = 0.35 + 0j
    coupler_mass: float = 2.587
    rocker_mass: float = 1.885
    gravity: float = 9.81
    speed: float = 240 * pi / 30

    def start(self):
        """Return the drawing, moving as the ideal mechanism does: the loop's velocities."""
        a = self.knuckle - self.pin
        b = self.knuckle - self.pivot
        moved = 1j * self.speed * self.pin
        # moved + i phi_t a = i psi_t b; take what is along b, then what is along a
        phi_t = -(moved * b.conjugate()).real / (1j * a * b.conjugate()).real
        psi_t = (moved * a.conjugate()).real / (1j * b * a.conjugate()).real
        return (phase(a), phase(b)), (phi_t, psi_t)

    def eccentricity(self, t, q, q_t):
        """Journal (rocker) minus bearing (coupler), and its rate."""
        a = abs(self.knuckle - self.pin) * exp(1j * q[0])
        b = abs(self.knuckle - self.pivot) * exp(1j * q[1])
        at = self.pin * exp(1j * self.speed * t)
        rate = 1j * (q_t[1] * b - self.speed * at - q_t[0] * a)
        return self.pivot + b - at - a, rate, a, b

    def accelerations(self, t, q, q_t):
        """Euler's equations of the rocker about its pivot, of the coupler about the moving pin."""
        e, e_t, a, b = self.eccentricity(t, q, q_t)
        force, on_journal, on_bearing = Clearance(self.kind, self.numbers).loads(
            e, e_t, q_t[1], q_t[0]
        )
        pin_tt = -(self.speed**2) * self.pin * exp(1j * self.speed * t)
        falling = -1j * self.gravity
        coupler = self.coupler_mass * moment(a / 2, falling - pin_tt) + moment(a, -force)
        rocker = self.rocker_mass * moment(b / 2, falling) + moment(b, force)
        return (
            (coupler + on_bearing) / (self.coupler_mass * abs(a) ** 2 / 3),
            (rocker + on_journal) / (self.rocker_mass * abs(b) ** 2 / 3),
        )
