"""What the press costs with flexible crank shaft and linkage, beside rigid ones, by modes.

Prints processor times, the least of alternating repeats: of a step of fixed size, and of two whole
revolutions at the default tolerance, whose steps follow what vibrates.
Run with: python scripts/benchmark_modes.py [--quick]
"""

import sys
import time

from exu_press import Scene
from exu_press.joints import COMPILED
from exu_press.scene import flexible_press

USUAL = 20  # modes

quick = "--quick" in sys.argv
counts = (0, 4) if quick else (0, 4, 10, USUAL, 40)
short, long = (0.002, 0.01) if quick else (0.02, 2.0)
repeats = 1 if quick else 5


def solved(scene):
    """Return processor time, s, and steps of a run, without what builds it."""
    model = scene.build()
    begun = time.process_time()
    outcome = model.solve()
    used = time.process_time() - begun
    model.SC.Reset()
    return used, outcome.steps


def least(scenes, times):
    """Return name -> least processor time, s, and steps, of so many alternating repeats."""
    runs = [{name: solved(scene) for name, scene in scenes.items()} for _ in range(times)]
    return {name: min(run[name] for run in runs) for name in scenes}


def flexible(scene, modes):
    """Return a scene with so many modes in each of both bodies."""
    return scene.replace(bodies=flexible_press(modes=modes))


def main():
    """Print both tables."""
    print(f"joints {'compiled' if COMPILED else 'in Python'}")
    rigid = Scene(revolutions=short, solver={"step": 1e-5})
    scenes = {"rigid": rigid} | {str(count): flexible(rigid, count) for count in counts}
    print(f"{'modes':>8} {'us/step':>8} {'ratio':>6}")
    costs = {name: 1e6 * used / steps for name, (used, steps) in least(scenes, repeats).items()}
    for name, cost in costs.items():
        print(f"{name:>8} {cost:8.0f} {cost / costs['rigid']:6.1f}")

    rigid = Scene(revolutions=long)
    scenes = {"rigid": rigid, str(USUAL): flexible(rigid, 4 if quick else USUAL)}
    runs = least(scenes, 1 if quick else 2)
    print(f"\n{long:g} revolutions, tolerance {rigid.solver.tolerance:g}")
    print(f"{'modes':>8} {'s':>8} {'ratio':>6} {'steps':>8} {'ratio':>6}")
    first, usual = runs["rigid"]
    for name, (used, steps) in runs.items():
        print(f"{name:>8} {used:8.2f} {used / first:6.1f} {steps:8d} {steps / usual:6.1f}")


if __name__ == "__main__":
    main()
