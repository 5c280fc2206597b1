"""What a step of the press costs with flexible crank shaft and linkage, by number of modes.

Prints the least of alternating repeats.
Run with: python scripts/benchmark_modes.py [--quick]
"""

import sys

from exu_press import Scene, simulate
from exu_press.joints import COMPILED
from exu_press.scene import flexible_press

quick = "--quick" in sys.argv
revolutions = 0.002 if quick else 0.02
counts = (0, 4) if quick else (0, 4, 10, 20, 40)
repeats = 1 if quick else 5

rigid = Scene(revolutions=revolutions, solver={"step": 1e-5})
scenes = {"rigid": rigid}
scenes |= {str(n): rigid.replace(bodies=flexible_press(modes=n)) for n in counts}
costs: dict[str, list[float]] = {name: [] for name in scenes}
for _ in range(repeats):
    for name, scene in scenes.items():
        run = simulate(scene)
        costs[name].append(run.info["wall_time"] / run.info["steps"] * 1e6)

print(f"joints {'compiled' if COMPILED else 'in Python'}")
print(f"{'modes':>8} {'us/step':>8} {'ratio':>6}")
for name, runs in costs.items():
    print(f"{name:>8} {min(runs):8.0f} {min(runs) / min(costs['rigid']):6.1f}")
