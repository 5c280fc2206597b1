"""Tabulate the side flow of a finite bearing: writes side_flow.npz beside the law (4 minutes).

Run it with one BLAS thread: OMP_NUM_THREADS=1 python scripts/tabulate_side_flow.py
"""

import argparse
import math
from pathlib import Path

import numpy as np

import exu_press.laws.film as film
from exu_press.laws.film.reynolds import solve_reynolds, supply_line
from tabulate_finite_film import SUPPLY_FADES, direction

TABLE = Path(film.__file__).with_name("side_flow.npz")

RATIOS = 0.1 * 40.0 ** np.linspace(0.0, 1.0, 8)  # L/D from 0.1 to 4
DIRECTIONS = np.linspace(-0.5 * math.pi, 0.5 * math.pi, 17)  # opening, rotation, closing
CENTRE = [0.01, 0.03, 0.06, 0.12, 0.25, 0.4, 0.55, 0.7]
WALL = [0.82, 0.9, 0.95, 0.98, 0.993, 0.9985, 0.9997]
ECCENTRICITIES = np.array([*CENTRE, *WALL])


def share(eps, turn, ratio, supplied):
    """Side flow over that of a bearing without flow around it."""
    v, u = direction(eps, turn)
    supply = supply_line(v, 2.0 * u) if supplied else None
    return solve_reynolds(eps, v, 2.0 * u, ratio, supply).side_flow / (2.0 * math.hypot(v, u))


def main():
    argparse.ArgumentParser(description=__doc__).parse_args()
    table = np.zeros((len(RATIOS), len(ECCENTRICITIES), len(DIRECTIONS)))
    for i, ratio in enumerate(RATIOS):
        for j, eps in enumerate(ECCENTRICITIES):
            fade = math.exp(-((eps / SUPPLY_FADES) ** 2))
            for k, turn in enumerate(DIRECTIONS):
                table[i, j, k] = (1.0 - fade) * share(eps, turn, ratio, True)
                if fade > 1e-6:
                    table[i, j, k] += fade * share(eps, turn, ratio, False)
        print(f"L/D = {ratio:.3f}", flush=True)
    np.savez_compressed(
        TABLE, ratio=RATIOS, eps=ECCENTRICITIES, turn=DIRECTIONS, share=table.astype(np.float32)
    )


if __name__ == "__main__":
    main()
