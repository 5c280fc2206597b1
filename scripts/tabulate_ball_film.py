"""Tabulate the film of a ball in its socket: writes ball.npz beside the law (5 minutes).

Run it with one BLAS thread: OMP_NUM_THREADS=1 python scripts/tabulate_ball_film.py
With --check it compares the law with a finer grid at states between the knots (2 minutes).
"""

import argparse
import math
import random
import statistics
from functools import partial

import numpy as np

from exu_press.laws.film.ball import TABLE, ball
from tabulate_finite_film import dissipation_and_turn, save
from tabulation.reynolds_sphere import facing_load

ANGLES = np.radians([45.0, 63.0, 81.0, 90.0])  # of a cap, from its middle to its edge
DIRECTIONS = np.linspace(-0.5 * math.pi, 0.5 * math.pi, 49)  # opening, rotation, closing
CENTRE = [0.0, 0.02, 0.05, 0.09, 0.14, 0.2, 0.28, 0.36, 0.45, 0.54, 0.62, 0.7, 0.77, 0.83]
WALL = [0.88, 0.92, 0.945, 0.965, 0.978, 0.987, 0.9925, 0.996, 0.998, 0.999, 0.9995]
ECCENTRICITIES = np.array([*CENTRE, *WALL])


def check(states=20):
    """Print by how much the law differs from solutions on a grid twice as fine, by direction."""
    rng = random.Random(1)
    print("part of the force by which the law is off: median, largest")
    for name, low, high in (("closing", 0, 75), ("sliding", 75, 105), ("opening", 105, 180)):
        for least, most in ((0.03, 0.9), (0.9, 0.999)):
            off = []
            for _ in range(states):
                cap = rng.uniform(ANGLES[0], ANGLES[-1])
                eps = 1.0 - math.exp(rng.uniform(math.log(1.0 - most), math.log(1.0 - least)))
                angle = math.radians(rng.uniform(low, high))
                v, u = math.cos(angle), math.sin(angle)
                expected = facing_load(eps, v, u, cap, (80, 40))
                computed = ball(cap).law(eps, v, 2.0 * u)[:2]
                off.append(math.dist(computed, expected) / math.hypot(*expected))
            deviation = f"{statistics.median(off):.1%}, {max(off):.1%}"
            print(f"{name}, eps {least:g} to {most:g}: {deviation}", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--check", action="store_true", help="compare the law with a finer grid")
    if parser.parse_args().check:
        check()
    else:
        tabulate()


def tabulate():
    """Write the table."""
    table = np.zeros((2, len(ANGLES), len(ECCENTRICITIES), len(DIRECTIONS)))
    for i, half_angle in enumerate(ANGLES):
        for j, eps in enumerate(ECCENTRICITIES):
            for k, turn in enumerate(DIRECTIONS):
                forces = partial(facing_load, eps, half_angle=half_angle)
                table[:, i, j, k] = dissipation_and_turn(eps, turn, forces)
        print(f"{math.degrees(half_angle):.0f} deg", flush=True)
    save(TABLE, table, angle=ANGLES, eps=ECCENTRICITIES, turn=DIRECTIONS)


if __name__ == "__main__":
    main()
