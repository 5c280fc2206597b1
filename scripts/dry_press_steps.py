"""Where the steps of the dry press are, and what its oscillation in lasting contact asks for.

Run with: python scripts/dry_press_steps.py [--quick]

The pin stays on its bearing for tenths of a second, and the linkage oscillates on it. How many
steps a period the method itself needs follows from its amplification matrix on a linear oscillator
(J. Chung, G. M. Hulbert, Journal of Applied Mechanics 60, 1993).
"""

import argparse
import cmath
import itertools
import math
import time

import numpy as np
from scipy.ndimage import uniform_filter1d

from exu_press import Result, Scene, simulate
from exu_press.numerics.arrays import Array
from exu_press.terminal.columns import columns

parser = argparse.ArgumentParser(description=__doc__)
parser.add_argument("--quick", action="store_true", help="a fifth of a revolution, coarse")
QUICK = parser.parse_args().quick
DRY = Scene(joints={"crank_pin": "dry", "balls": "dry"}, revolutions=0.2 if QUICK else 2.0)
SETTINGS = {"step": 1e-4, "tolerance": 1e-2} if QUICK else {"step": 1e-5, "tolerance": 2e-3}
"""Those that deliver the peaks of the whole run within 2 % (scripts/precision.py)."""

LASTING = 5e-3
"""s; a contact that is longer."""

APART = 2e-5
"""s, between the values of a force that is looked at."""

ERROR = 0.02


def contacts(run: Result) -> list[tuple[int, int]]:
    """Return the first and the last step of every lasting contact of the pin."""
    touching = np.concatenate([[False], run.joints["crank_pin"].gap < 0.0, [False]])
    begins, ends = np.flatnonzero(np.diff(touching.astype(int))).reshape(-1, 2).T
    return [
        (int(i), int(j) - 1)
        for i, j in zip(begins, ends, strict=True)
        if run.time[j - 1] - run.time[i] > LASTING
    ]


def oscillations(time: Array, force: Array) -> int:
    """Return how often a force rises through its mean over LASTING."""
    even = np.arange(time[0], time[-1], APART)
    width = round(LASTING / APART)
    values = np.interp(even, time, force)
    about = values - uniform_filter1d(values, width)
    return int(np.count_nonzero((about[:-1] < 0.0) & (about[1:] >= 0.0)))


def amplification(phase: float, radius: float) -> complex:
    """Return what generalized-alpha makes of exp(i phase) in a step.

    Args:
        phase: angular frequency times step, rad.
        radius: spectral radius at infinity.
    """
    m, f = (2.0 * radius - 1.0) / (radius + 1.0), radius / (radius + 1.0)
    gamma = 0.5 - m + f
    beta = 0.25 * (1.0 - m + f) ** 2
    square = phase**2
    # displacement, velocity and acceleration, times 1, h and h^2, at the end and at the beginning
    end = [[1.0, 0.0, -beta], [0.0, 1.0, -gamma], [(1.0 - f) * square, 0.0, 1.0 - m]]
    begin = [[1.0, 1.0, 0.5 - beta], [0.0, 1.0, 1.0 - gamma], [-f * square, 0.0, -m]]
    values = np.linalg.eigvals(np.linalg.solve(end, begin))
    return complex(min(values, key=lambda value: abs(value - np.exp(1j * phase))))


def steps_needed(periods: float, radius: float) -> int:
    """Return how many steps a period leave an oscillation ERROR off after so many periods."""
    for count in itertools.count(10):
        phase = 2.0 * math.pi / count
        if count * periods * abs(cmath.log(amplification(phase, radius)) - 1j * phase) <= ERROR:
            break
    return count


radius = DRY.solver.spectral_radius
rows = [("", "steps", "in lasting contact", "a period there", "processor time, s")]
for setting, value in SETTINGS.items():
    start = time.process_time()
    run = simulate(DRY.replace({f"solver.{setting}": value}))
    seconds, steps = time.process_time() - start, len(run.time) - 1
    force = np.linalg.norm(run.joints["crank_pin"].force, axis=1)
    lasting = contacts(run)
    inside = sum(j - i for i, j in lasting)
    periods = [oscillations(run.time[i:j], force[i:j]) for i, j in lasting]
    lengths = [float(run.time[j] - run.time[i]) for i, j in lasting]
    texts = f"{inside / steps:.0%}", f"{inside / sum(periods):.0f}"
    rows.append((f"{setting} {value:g}", f"{steps}", *texts, f"{seconds:.2f}"))
longest, most = max(lengths), max(periods)
print("\n".join(columns(rows)))
print(f"longest contact: {longest:.3f} s, {most} oscillations of {most / longest:.0f} Hz")
print(f"steps a period that leave an oscillation {ERROR:.0%} off:")
print(f"  after one: {steps_needed(1, radius)}; at the end of that contact: "
      f"{steps_needed(most, radius)}")  # fmt: skip
