"""Tabulate the film of a finite bearing: writes finite_bearing.npz beside the law (3 minutes).

Run it with one BLAS thread: OMP_NUM_THREADS=1 python scripts/tabulate_finite_film.py
"""

import argparse
import math
from functools import partial
from pathlib import Path

import numpy as np

from exu_press.laws.film import finite_bearing
from exu_press.laws.film.reynolds import solve_reynolds, supply_line

RATIOS = 0.1 * 40.0 ** np.linspace(0.0, 1.0, 14)  # L/D from 0.1 to 4
DIRECTIONS = np.linspace(-0.5 * math.pi, 0.5 * math.pi, 25)  # opening, rotation, closing
CENTRE = [0.0, 0.01, 0.02, 0.03, 0.04, 0.055, 0.07, 0.09, 0.12, 0.16, 0.22]
MIDDLE = [0.3, 0.4, 0.5, 0.6, 0.7, 0.78, 0.84, 0.89, 0.925, 0.95]
WALL = [0.968, 0.98, 0.9875, 0.9925, 0.9955, 0.9975, 0.9987, 0.9993, 0.9997]
ECCENTRICITIES = np.array([*CENTRE, *MIDDLE, *WALL])
SUPPLY_FADES = 0.03  # eps below which "the widest gap" loses its meaning, and with it the supply


def direction(eps, turn):
    """eps_dot and eps_w / 2 of length one whose mean angle, plain and scaled, is turn."""
    if abs(turn) > 1.5707:
        return math.copysign(1.0, turn), 0.0
    s = math.sqrt(1.0 - eps * eps)
    low, high = -0.5 * math.pi, 0.5 * math.pi
    for _ in range(60):
        phi = 0.5 * (low + high)
        if phi + math.atan2(math.sin(phi), s * math.cos(phi)) < 2.0 * turn:
            low = phi
        else:
            high = phi
    return math.sin(phi), max(math.cos(phi), 0.0)


def dissipation_and_turn(eps, turn, forces):
    """ln E and m of `tabulated` from one solution of Reynolds' equation, forces(v, u)."""
    s = math.sqrt(1.0 - eps * eps)
    v, u = direction(eps, turn)
    f_r, f_t = forces(v, u)
    a, b = v, s * u
    size = a * a + b * b
    e = (f_t * u - f_r * v) / size
    return math.log(e), -(f_r * b + f_t / s * a) / (e * size)


def loads(eps, ratio, supplied, v, u):
    """Forces of a bearing, supplied where its gap is widest or not at all."""
    supply = supply_line(v, 2.0 * u) if supplied else None
    return solve_reynolds(eps, v, 2.0 * u, ratio, supply)[:2]


def save(file, table, **axes):
    """Write ln E and m over size, eccentricity and direction."""
    table[0, :, 0] = table[0, :, 0].mean(axis=-1, keepdims=True)  # isotropic at eps = 0
    table[1, :, 0] = 0.0
    table[1, :, :, [0, -1]] = 0.0  # pure squeeze pushes straight back
    log_e, m = table.astype(np.float32)
    np.savez_compressed(file, **axes, log_e=log_e, m=m)


def main():
    argparse.ArgumentParser(description=__doc__).parse_args()
    shape = (len(RATIOS), len(ECCENTRICITIES), len(DIRECTIONS))
    table = np.zeros((2, *shape))
    for i, ratio in enumerate(RATIOS):
        for j, eps in enumerate(ECCENTRICITIES):
            fade = math.exp(-((eps / SUPPLY_FADES) ** 2))
            for k, turn in enumerate(DIRECTIONS):
                for weight, supplied in ((1.0 - fade, True), (fade, False)):
                    if weight > 1e-6:
                        forces = partial(loads, eps, ratio, supplied)
                        found = dissipation_and_turn(eps, turn, forces)
                        table[:, i, j, k] += weight * np.array(found)
        print(f"L/D = {ratio:.3f}", flush=True)
    save(
        Path(finite_bearing.__file__).with_suffix(".npz"),
        table,
        ratio=RATIOS,
        eps=ECCENTRICITIES,
        turn=DIRECTIONS,
    )


if __name__ == "__main__":
    main()
