"""Compare bearings with two axial grooves with published tables: a line for each row (5 s).

Someya's stiffness is that of grooves which turn with the eccentricity, Lund's that of grooves which
stay in the bearing, as they do.

Run it with: python scripts/compare_grooved_film.py
"""

import argparse
import csv
import math
from pathlib import Path

import numpy as np
from scipy.optimize import brentq

from exu_press.laws.film.grooves import Groove, GroovedBearing, solve_grooved

TABLES = Path(__file__).parents[1] / "tests" / "laws" / "film" / "someya_lund.csv"
WIDTHS = {"Someya": 10.0, "Lund": 20.0}  # of a groove, deg; neither table says it
LEAST, LARGEST = 0.19, 0.81
STEP = 0.01


def force(bearing, e):
    """Return the steady force on the journal, x along the load, over P omega / 2."""
    eps, angle = math.hypot(*e), math.atan2(e[1], e[0])
    f_r, f_t, _ = solve_grooved(bearing, eps, angle, 0.0, eps)
    return turned(f_r, f_t, angle)


def turned(f_r, f_t, angle):
    """Return a radial and a tangential component in the axes of the load."""
    c, s = math.cos(angle), math.sin(angle)
    return np.array([f_r * c - f_t * s, f_r * s + f_t * c])


def coefficients(width, ratio, eps, grooves_turn):
    """Return S, attitude (deg), K and B of a bearing with grooves at +-90 deg from the load."""
    grooves = tuple(Groove(a, math.radians(width), 1.0) for a in (math.pi / 2, -math.pi / 2))
    bearing = GroovedBearing(ratio, grooves)

    def place(angle):
        return eps * np.array([math.cos(angle), math.sin(angle)])

    attitude = brentq(lambda angle: force(bearing, place(angle))[1], 0.2, 1.6, xtol=1e-6)
    e, normal = place(attitude), place(attitude) / eps
    bears = force(bearing, e)
    load = -bears[0]
    across = np.array([-normal[1], normal[0]])

    def slope(direction):
        step = STEP * direction
        return (force(bearing, e + step) - force(bearing, e - step)) / (2.0 * STEP)

    by_across = slope(across)
    if grooves_turn:  # the force turns with the eccentricity
        by_across = np.array([-bears[1], bears[0]]) / eps
    stiffness = -np.outer(slope(normal), normal) - np.outer(by_across, across)
    damping = np.empty((2, 2))
    for column, v in enumerate(np.eye(2)):
        forces = [
            turned(
                *solve_grooved(
                    bearing, eps, attitude, sign * STEP * v @ normal,
                    eps - 2.0 * sign * STEP * v @ across,
                )[:2],
                attitude,
            )
            for sign in (1.0, -1.0)
        ]  # fmt: skip
        damping[:, column] = -(forces[0] - forces[1]) / (2.0 * STEP)
    return 1.0 / (math.pi * load), math.degrees(attitude), stiffness / load, damping / load


def rows():
    """Yield source, L/D, eps, and theirs and ours: S, attitude (deg), K and B (2, 2) each."""
    with TABLES.open(encoding="utf-8") as file:
        lines = [line for line in file if not line.startswith("#")]
    for row in csv.DictReader(lines):
        source = row.pop("table").partition(" ")[0]
        r = {name: float(value) for name, value in row.items()}
        if not LEAST < r["E"] < LARGEST:
            continue
        ratio = r["length_to_diameter"]
        ours = coefficients(WIDTHS[source], ratio, r["E"], source == "Someya")
        k, b = (np.array([[r[m + i + j] for j in "xy"] for i in "xy"]) for m in "KB")
        yield source, ratio, r["E"], (r["S"], r["Phi"], k, b), ours


def main():
    """Print the table."""
    argparse.ArgumentParser(description=__doc__).parse_args()
    print("table   L/D  eps    S       attitude  K      B")
    for source, ratio, eps, theirs, ours in rows():
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
