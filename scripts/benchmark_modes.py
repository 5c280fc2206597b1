"""What a step of the press costs with flexible crank shaft and linkage, by number of modes.

Run with: python scripts/benchmark_modes.py [--quick]
"""

import sys

from exu_press import Scene, simulate

quick = "--quick" in sys.argv
revolutions = 0.002 if quick else 0.02
counts = (0, 4) if quick else (0, 4, 10, 20, 40)

scene = Scene(revolutions=revolutions, solver={"step": 1e-5})


def microseconds_per_step(scene: Scene) -> float:
    runs = [simulate(scene) for _ in range(1 if quick else 3)]
    return min(run.info["wall_time"] / run.info["steps"] for run in runs) * 1e6


rigid = microseconds_per_step(scene)
print(f"{'modes':>8} {'us/step':>8} {'ratio':>6}")
print(f"{'rigid':>8} {rigid:8.0f} {1.0:6.1f}")
for modes in counts:
    flexible = scene.replace(bodies="flexible").replace("flexible.modes", modes)
    cost = microseconds_per_step(flexible)
    print(f"{modes:>8} {cost:8.0f} {cost / rigid:6.1f}")
