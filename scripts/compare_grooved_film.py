"""Compare bearings with two axial grooves with published tables: a line for each row (5 s).

Lund's rows are equilibria and derivatives of a bearing whose grooves stay where they are. Someya's
follow from another procedure, which `someya` repeats.

Run it with: python scripts/compare_grooved_film.py [--equilibrium]
"""

import argparse
import csv
import math
from pathlib import Path

import numpy as np
from scipy.optimize import brentq

from exu_press.laws.film.grooves import Groove, GroovedBearing, GroovedFilmState

TABLES = Path(__file__).parents[1] / "tests" / "laws" / "film" / "someya_lund.csv"
WIDTHS = {"Someya": 10.0, "Lund": 20.0}  # of a groove, deg; neither table says it
LEAST, LARGEST = 0.19, 0.81
STEP = 0.01
"""Of a motion over the clearance, and of a velocity over that and omega, for a derivative."""

SOMEYA_STEP = 0.02
"""Of the velocity whose force, beside that of none, is Someya's damping."""

SOMEYA_TOLERANCE = math.radians(2.0)
"""Change of the attitude angle at which Someya's iteration ends."""


def force(bearing, e, v=(0.0, 0.0)):
    """Return the force on a turning journal at e with a velocity v, x along the bearing's middle.

    Lengths are over the clearance, times over 1 / omega, forces over P omega.
    """
    eps, angle = math.hypot(*e), math.atan2(e[1], e[0])
    c, s = e / eps
    eps_dot, across = v[0] * c + v[1] * s, v[1] * c - v[0] * s
    film = GroovedFilmState(bearing, eps, angle, (144, 10)).solve(eps_dot, 0.5 * eps - across)
    return np.array([film.f_r * c - film.f_t * s, film.f_r * s + film.f_t * c])


def place(eps, angle):
    """Return the eccentricity at an angle."""
    return eps * np.array([math.cos(angle), math.sin(angle)])


def slope(function, step, least):
    """Return the difference of a function of a place between two steps, over their distance."""
    return (function(step) - function(least)) / (step - least)


def lund(bearing, eps):
    """Return eccentricity, force, stiffness and damping in equilibrium."""
    angle = brentq(lambda angle: force(bearing, place(eps, angle))[1], 0.2, 1.6, xtol=1e-6)
    e = place(eps, angle)
    axes = np.eye(2)
    stiffness = [slope(lambda x, n=n: force(bearing, e + x * n), STEP, -STEP) for n in axes]
    damping = [slope(lambda v, n=n: force(bearing, e, v * n), STEP, -STEP) for n in axes]
    return e, force(bearing, e), -np.transpose(stiffness), -np.transpose(damping)


def someya(bearing, eps):
    """Return the same as Someya's tables have it.

    The grooves are put across the direction of the load of the last iteration, the first of which
    has an attitude of 90 deg. The bearing's stiffness is that of a force which turns with the
    eccentricity, and its damping a forward difference.
    """
    angle, change = 0.5 * math.pi, math.inf
    while change > SOMEYA_TOLERANCE:
        e = place(eps, angle)
        bears = force(bearing, e)
        attitude = angle - math.atan2(-bears[1], -bears[0])
        angle, change = attitude, abs(attitude - angle)
    normal = e / eps
    across = np.array([-normal[1], normal[0]])
    by_normal = slope(lambda x: force(bearing, e + x * normal), STEP, -STEP)
    by_across = np.array([-bears[1], bears[0]]) / eps
    stiffness = -np.outer(by_normal, normal) - np.outer(by_across, across)
    damping = [slope(lambda v, n=n: force(bearing, e, v * n), SOMEYA_STEP, 0.0) for n in np.eye(2)]
    return e, bears, stiffness, -np.transpose(damping)


def coefficients(table, ratio, eps, procedure):
    """Return S, attitude (deg), K and B of a bearing with grooves at +-90 deg from the load."""
    grooves = tuple(
        Groove(a, math.radians(WIDTHS[table]), 1.0) for a in (math.pi / 2, -math.pi / 2)
    )
    bearing = GroovedBearing(ratio, grooves)
    e, bears, stiffness, damping = procedure(bearing, eps)
    load = math.hypot(*bears)
    axis = -bears / load
    axes = np.array([axis, [-axis[1], axis[0]]])
    attitude = math.atan2(*(axes @ e)[::-1])
    matrices = (axes @ matrix @ axes.T / load for matrix in (stiffness, damping))
    return 1.0 / (math.pi * load), math.degrees(attitude), *matrices


PROCEDURES = {"Someya": someya, "Lund": lund}


def table_rows():
    """Yield a table's name and its numbers, of each row."""
    with TABLES.open(encoding="utf-8") as file:
        lines = [line for line in file if not line.startswith("#")]
    for row in csv.DictReader(lines):
        name = row.pop("table").partition(" ")[0]
        yield name, {symbol: float(value) for symbol, value in row.items()}


def rows(procedures=PROCEDURES):
    """Yield source, L/D, eps, and theirs and ours: S, attitude (deg), K and B (2, 2) each."""
    for source, r in table_rows():
        if not LEAST < r["E"] < LARGEST:
            continue
        ratio = r["length_to_diameter"]
        ours = coefficients(source, ratio, r["E"], procedures[source])
        k, b = (np.array([[r[m + i + j] for j in "xy"] for i in "xy"]) for m in "KB")
        yield source, ratio, r["E"], (r["S"], r["Phi"], k, b), ours


def main():
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument(
        "--equilibrium", action="store_true", help="compare Someya's rows like Lund's"
    )
    in_equilibrium = parser.parse_args().equilibrium
    procedures = {**PROCEDURES, "Someya": lund} if in_equilibrium else PROCEDURES
    print("table   L/D  eps    S       attitude  K      B")
    for source, ratio, eps, theirs, ours in rows(procedures):
        s, attitude = ours[0] / theirs[0] - 1.0, ours[1] - theirs[1]
        k, b = (
            np.abs(o - t).max() / np.abs(t).max() for o, t in zip(ours[2:], theirs[2:], strict=True)
        )
        print(
            f"{source:6}  {ratio:3.1f}  {eps:5.3f}  {100 * s:+5.2f}%  {attitude:+5.2f} deg "
            f"{100 * k:5.1f}% {100 * b:5.1f}%"
        )


if __name__ == "__main__":
    main()
