"""A journal in its bearing at rest, by the interface laws of a scene: force, equilibrium, loss."""

import math
from itertools import product

import numpy as np

from exu_press.errors import InputError
from exu_press.joints.interface import FilmInterface, InterfaceJoint, Load
from exu_press.joints.oriented import GroovedInterface, TiltedInterface
from exu_press.laws.film.contract import film_scale
from exu_press.model.clearance_joints import interfaces_of
from exu_press.numerics.arrays import Array
from exu_press.scene import LubricatedJoint, Scene
from exu_press.scene.film import JournalFilm
from exu_press.scene.joint import unworn

__all__ = ["Journal"]

DIRECTIONS, LEVELS = 48, 40
"""Directions and eccentricities among which an equilibrium is looked for at first."""

FEW_DIRECTIONS, FEW_LEVELS = 12, 12
"""The same of a film that solves Reynolds' equation in each state."""

LEVEL_RANGE = 1e-4, 16.0
"""Of -ln(1 - e / largest)."""

ITERATIONS, HALVINGS = 200, 40
"""Of Newton's method, and of a change that does not bring the force nearer to the load."""

EXACT = 1e-10
"""Relative, of an equilibrium's force."""

SMALL = 1e-6
"""Changes by which the force is differentiated for Newton's method, of a logarithm and in rad."""

LARGEST_CHANGE = 0.3
"""Of a logarithm, and in rad, in one iteration."""

Vector = tuple[float, float]


class Journal:
    """A journal that turns in a bearing at rest.

    Attributes:
        clearance: radial, m.
        oil: that warms, or None.
        viscosity: of the oil in the film, Pa s.
    """

    def __init__(self, scene: Scene, name: str, turning: float) -> None:
        """Take the interface laws of a joint; `turning` is the journal's angular velocity, rad/s.

        It is a lubricated journal.
        """
        kind = unworn(scene.joints[name])
        assert isinstance(kind, LubricatedJoint) and isinstance(kind.film, JournalFilm)
        self._film, self._radius, self.clearance = kind.film, kind.radius, kind.clearance
        self.oil = kind.film.oil
        self.viscosity = kind.film.cold_viscosity
        self._turning = turning
        self._interfaces = interfaces_of(kind, scene)
        joint = InterfaceJoint([], self._interfaces)
        touching = math.isfinite(joint.contact_onset)
        self._beyond_film = joint.largest_eccentricity if touching else None
        tilted = any(isinstance(interface, TiltedInterface) for interface in self._interfaces)
        self._grid = (FEW_DIRECTIONS, FEW_LEVELS) if tilted else (DIRECTIONS, LEVELS)
        self._flow = kind.film.side_flow(kind.radius) if kind.film.law.flows_out else None

    def set_temperature(self, temperature: float, load: float) -> None:
        """Let the oil have a temperature, deg C, under a load, N."""
        assert self.oil is not None
        size = self._film.length, self._radius, self.clearance
        self.viscosity = self.oil.viscosity(temperature, load / (2.0 * size[1] * size[0]))
        for interface in self._interfaces:
            if isinstance(interface, FilmInterface):
                interface.scale = film_scale(self.viscosity, *size)

    def force(self, e: Vector) -> Vector:
        """Return the force on the journal, N, at rest at an eccentricity, m."""
        n_x, n_y = _unit(e)
        loads = [load for load in self._loads(e) if load is not None]
        f_n, f_t = sum(load[0] for load in loads), sum(load[1] for load in loads)
        return f_n * n_x - f_t * n_y, f_n * n_y + f_t * n_x

    def power(self, e: Vector) -> float:
        """Return what the drive of the journal loses in the joint, W."""
        moment = sum(load[2] for load in self._loads(e) if load is not None)
        return -moment * self._turning

    def least_gap(self, e: Vector) -> float:
        """Return the least gap at an eccentricity, m."""
        self._interfaces[0].orient(math.atan2(e[1], e[0]))
        return self._interfaces[0].gap(math.hypot(*e))

    def pump_power(self, e: Vector) -> float | None:
        """Return what the pump of the grooves puts in, W; None without oil under pressure."""
        if not any(interface.bears_at_rest for interface in self._interfaces):
            return None
        self._loads(e)
        return sum(interface.pump_power for interface in self._interfaces)

    def side_flow(self, e: Vector) -> float | None:
        """Return the oil that leaves the bearing's ends, m^3/s; None where it has none."""
        eps = np.array([math.hypot(*e) / self.clearance])
        motion = eps, np.zeros(1), eps * self._turning
        size = self._film.length * self._radius * self.clearance
        for interface in self._interfaces:
            if isinstance(interface, GroovedInterface):
                angle = np.array([math.atan2(e[1], e[0])])
                spin = np.array([self._turning])
                return size * float(interface.side_flow(*motion, angle, spin)[0])
        return None if self._flow is None else size * float(self._flow(*motion)[0])

    def matrices(self, e: Vector) -> tuple[Array, Array]:
        """Return stiffness -dF/dx, N/m, and damping -dF/dv, N s/m, (2, 2), in the drawing's axes.

        They are the interface laws' own derivatives, and those of a force that turns with e.
        """
        length = math.hypot(*e)
        n_x, n_y = _unit(e)
        motion = length, 0.0, 0.0, self._turning, 0.0
        turned = np.array([[n_x, -n_y], [n_y, n_x]])
        by_place, by_rate = np.zeros((2, 2)), np.zeros((2, 2))
        for interface, load in zip(self._interfaces, self._loads(e), strict=True):
            if load is not None:
                f_n, f_t, _, _, response = load
                partials = np.array(interface.partials(response, length, self._turning, 0.0))
                across = np.array([-f_t, f_n]) / length
                if isinstance(interface, GroovedInterface):
                    across += np.array(interface.turn_partials(load, motion)[:2]) / length
                by_place += np.column_stack([partials[:, 0], across])
                by_rate += partials[:, 1:3]
        return turned @ -by_place @ turned.T, turned @ -by_rate @ turned.T

    def equilibrium(self, load: Vector) -> Vector:
        """Return the eccentricity, m, at which the joint bears a load on the journal, N.

        Where the film does not, surfaces that may touch are pressed into each other.

        Raises:
            InputError: there is none.
        """
        try:
            return self._equilibrium(load, None)
        except InputError:
            if self._beyond_film is None:
                raise
            return self._equilibrium(load, self._beyond_film)

    def _equilibrium(self, load: Vector, reach: float | None) -> Vector:
        """Return the equilibrium below an eccentricity, m; None: where the surfaces touch.

        Newton's method on the logarithm of the force and on its direction, as a film's force grows
        without bound towards the wall, over the logarithm of x, to which it is proportional at
        the centre; from the best of a grid.
        """

        def missing(x: float, angle: float) -> Array:
            f_x, f_y = self.force(self._eccentricity_at(x, angle, reach))
            size = math.hypot(f_x, f_y)
            if not 0.0 < size < math.inf:
                return np.array([math.inf, math.inf])
            turn = math.atan2(-f_y, -f_x) - math.atan2(load[1], load[0])
            return np.array([math.log(size / math.hypot(*load)), math.remainder(turn, math.tau)])

        directions, levels = self._grid
        turns = np.arange(directions) * (math.tau / directions)
        grid = product(np.geomspace(*LEVEL_RANGE, levels), turns)
        x, angle = min(grid, key=lambda at: float(np.abs(missing(*at)).sum()))
        y = math.log(x)
        for _ in range(ITERATIONS):
            now = missing(math.exp(y), angle)
            if not np.abs(now).max() > EXACT:
                return self._eccentricity_at(math.exp(y), angle, reach)
            by_y = (missing(math.exp(y + SMALL), angle) - now) / SMALL
            by_angle = (missing(math.exp(y), angle + SMALL) - now) / SMALL
            try:
                change = np.linalg.solve(np.column_stack([by_y, by_angle]), -now)
            except np.linalg.LinAlgError:
                break
            change *= min(1.0, LARGEST_CHANGE / float(np.abs(change).max()))
            for _ in range(HALVINGS):
                moved = missing(math.exp(y + change[0]), angle + change[1])
                if np.abs(moved).sum() < np.abs(now).sum():
                    break
                change *= 0.5
            else:
                break
            y, angle = y + float(change[0]), angle + float(change[1])
        above_load = missing(LEVEL_RANGE[0], angle)[0] > 0.0
        more, less = ("more", "less") if above_load else ("less", "more")
        raise InputError(
            f"load = {tuple(load)!r}: the joint has no equilibrium; allowed is {more} load, or "
            f"{less} speed or viscosity"
        )

    def _loads(self, e: Vector) -> list[Load | None]:
        length = math.hypot(*e)
        for interface in self._interfaces:
            interface.orient(math.atan2(e[1], e[0]))
        return [i.load(length, 0.0, 0.0, self._turning, 0.0) for i in self._interfaces]

    def _eccentricity_at(self, x: float, angle: float, reach: float | None) -> Vector:
        """Return the eccentricity, m, at x = -ln(1 - e / reach) and an angle, rad."""
        if reach is None:
            self._interfaces[0].orient(angle)
            reach = self._interfaces[0].reach
        e = -reach * math.expm1(-x)
        return e * math.cos(angle), e * math.sin(angle)


def _unit(e: Vector) -> Vector:
    length = math.hypot(*e)
    return e[0] / length, e[1] / length
