"""Tabulate the film of a ball in its socket: writes ball.npz beside the law (5 minutes).

Run it with one BLAS thread: OMP_NUM_THREADS=1 python scripts/tabulate_ball_film.py
With --check it compares the law with a finer grid at states between the knots (2 minutes).
"""

import argparse
import math
import random
import statistics

import numpy as np

from exu_press.laws.film.ball import TABLE, ball
from exu_press.laws.film.reynolds_sphere import facing_load
from tabulate_finite_film import direction

ANGLES = np.radians([45.0, 63.0, 81.0, 90.0])  # of a cap, from its middle to its edge
DIRECTIONS = np.linspace(-0.5 * math.pi, 0.5 * math.pi, 49)  # opening, rotation, closing
CENTRE = [0.0, 0.02, 0.05, 0.09, 0.14, 0.2, 0.28, 0.36, 0.45, 0.54, 0.62, 0.7, 0.77, 0.83]
WALL = [0.88, 0.92, 0.945, 0.965, 0.978, 0.987, 0.9925, 0.996, 0.998, 0.999, 0.9995]
ECCENTRICITIES = np.array([*CENTRE, *WALL])


def dissipation_and_turn(eps, turn, half_angle):
    """ln E and m of `tabulated` from one solution of Reynolds' equation."""
    s = math.sqrt(1.0 - eps * eps)
    v, u = direction(eps, turn)
    if abs(turn) > 1.5707:
        v, u = math.copysign(1.0, turn), 0.0
    f_r, f_t = facing_load(eps, v, u, half_angle)
    a, b = v, s * u
    size = a * a + b * b
    e = (f_t * u - f_r * v) / size
    return math.log(e), -(f_r * b + f_t / s * a) / (e * size)


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
                wanted = facing_load(eps, v, u, cap, (80, 40))
                found = ball(cap).law(eps, v, 2.0 * u)[:2]
                off.append(math.dist(found, wanted) / math.hypot(*wanted))
            shown = f"{statistics.median(off):.1%}, {max(off):.1%}"
            print(f"{name}, eps {least:g} to {most:g}: {shown}", flush=True)


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
                table[:, i, j, k] = dissipation_and_turn(eps, turn, half_angle)
        print(f"{math.degrees(half_angle):.0f} deg", flush=True)
    table[0, :, 0] = table[0, :, 0].mean(axis=-1, keepdims=True)  # isotropic at eps = 0
    table[1, :, 0] = 0.0
    table[1, :, :, [0, -1]] = 0.0  # pure squeeze pushes straight back
    log_e, m = table.astype(np.float32)
    np.savez_compressed(TABLE, angle=ANGLES, eps=ECCENTRICITIES, turn=DIRECTIONS, log_e=log_e, m=m)


if __name__ == "__main__":
    main()
