"""Pressure of a journal bearing under a steady load against COMSOL's, with a rigid shell.

Barus' viscosity, eta exp(alpha p), turns Reynolds' equation for p into that of a constant viscosity
for q = (1 - exp(-alpha p)) / alpha, so that the package's solution serves with and without it.
"""

import math

import numpy as np
import pytest
from data import columns_of
from scipy.optimize import root

from exu_press.laws.film.reynolds import solve_reynolds

TABLE = columns_of("comsol_journal_bearing.csv")
RADIUS, CLEARANCE, LENGTH, VISCOSITY, LOAD = 0.1, 2e-4, 0.067, 75e-3, 40e3
BARUS = 25e-9  # 1/Pa
GROOVE_END = math.pi + 5e-3 / RADIUS  # from which on the loaded film builds up
STARTS = (0.3, 0.8, 0.95)
SHIFT = 5.0  # deg: the curves are steep, and were read from a picture


def film(eccentricity_ratio, direction, speed, alpha):
    """Return angle (rad), pressure in the middle (Pa) and force on the journal (N).

    Args:
        eccentricity_ratio: of the journal.
        direction: of its narrowest gap, rad.
        speed: rad/s.
        alpha: of Barus, 1/Pa; 0 for a constant viscosity.
    """
    supply = (GROOVE_END - direction + math.pi) % (2.0 * math.pi) - math.pi
    ratio = LENGTH / (2.0 * RADIUS)
    solved = solve_reynolds(eccentricity_ratio, 0.0, eccentricity_ratio * speed, ratio, supply)
    pressure = 12.0 * VISCOSITY * (RADIUS / CLEARANCE) ** 2 * solved.p
    if alpha:
        if pressure.max() * alpha >= 1.0:
            return solved.theta, pressure, np.full(2, np.inf)
        pressure = -np.log1p(-alpha * pressure) / alpha
    edge = np.zeros((len(pressure), 1))  # p = 0 at the end
    mean = np.trapezoid(np.hstack([pressure, edge]), np.append(solved.zeta, 1.0), axis=1)
    angle = solved.theta + direction
    along = np.trapezoid(mean * np.exp(1j * angle), angle)
    return angle, pressure[:, 0], -RADIUS * LENGTH * np.array([along.real, along.imag])


def equilibrium(speed, alpha):
    """Return angle (deg, rising) and pressure (bar) of the film that bears the load."""

    def excess(state):
        ratio = min(1.0 / (1.0 + math.exp(-state[0])), 0.999)
        force = film(ratio, state[1], speed, alpha)[2]
        return np.nan_to_num((force - [0.0, LOAD]) / LOAD, posinf=9.0)

    for start in STARTS:
        solved = root(excess, [math.log(start / (1.0 - start)), math.radians(290.0)])
        if np.abs(excess(solved.x)).max() < 1e-6:
            break
    else:
        raise AssertionError(f"no equilibrium at {speed} rad/s")
    angle, pressure, _ = film(1.0 / (1.0 + math.exp(-solved.x[0])), solved.x[1], speed, alpha)
    degrees = np.degrees(angle) % 360.0
    order = np.argsort(degrees)
    return degrees[order], pressure[order] / 1e5


@pytest.mark.validation(
    "code",
    "mid-plane pressure of a journal bearing, 40 kN, two grooves",
    "COMSOL 6.4, application library, as digitised in octave-user/mboct-mbdyn-pkg",
    "numbers as there, GPL-3",
    "Each point is compared with the nearest of ours within 5 degrees, over the largest pressure. "
    "MBDyn's test does so too, and allows 7 %. No law of the package has a viscosity that rises "
    "with pressure; the rows of Barus are the same solution with his. At 316 and 100 rpm, above an "
    "eccentricity ratio of 0.9, their pressure is higher and ends up to 8 degrees before ours, at "
    "our narrowest gap. The reason is not known. Their shell is elastic, and the end of their film "
    "is not stated.",
)
@pytest.mark.long
@pytest.mark.parametrize(
    ("rpm", "constant", "barus"), [(10000.0, 0.02, 0.01), (316.23, 0.2, 0.14), (100.0, 0.17, 0.16)]
)
def test_pressure(rpm, constant, barus, compare):
    rows = TABLE["speed_rpm"] == rpm
    angle, theirs = TABLE["angle_deg"][rows], TABLE["pressure_bar"][rows]
    shifts = np.linspace(-SHIFT, SHIFT, 21)
    for name, alpha, rel in (("constant viscosity", 0.0, constant), ("Barus", BARUS, barus)):
        curve = equilibrium(rpm * math.pi / 30.0, alpha)
        near = np.interp(angle + shifts[:, None], *curve)
        best = np.abs(near - theirs).argmin(axis=0)
        ours = np.take_along_axis(near, best[None], axis=0)[0]
        quantity = f"pressure, {rpm:g} rpm, {name}"
        error = 3e-3 * theirs.max()  # of the grid
        compare(quantity, theirs, ours, error=error, rel=rel, scale=theirs.max(), unit="bar")
