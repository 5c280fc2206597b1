"""What the press costs with flexible crank shaft and linkage, beside rigid ones, by modes.

Prints processor times, the least of alternating repeats: of a step of fixed size, and of two whole
revolutions at the default tolerance, whose steps follow what vibrates. In the rows named "error"
modes are chosen by a flexibility error.
Run with: python scripts/benchmark_modes.py [--quick]
"""

import argparse
import time

from exu_press import Scene
from exu_press.joints import COMPILED
from exu_press.scene import flexible_press

USUAL = 20  # modes
ERROR = 0.01  # of the flexibility

parser = argparse.ArgumentParser(description=__doc__)
parser.add_argument("--quick", action="store_true", help="few modes, short runs")
quick = parser.parse_args().quick
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


def flexible(scene, counts):
    """Return name -> scene: rigid, with so many modes in each of both bodies, and by error."""
    chosen = {str(count): {"modes": count} for count in counts}
    chosen[f"error {ERROR:g}"] = {"flexibility_error": ERROR}
    bodies = {name: flexible_press(**keys) for name, keys in chosen.items()}
    return {"rigid": scene} | {
        name: scene.replace({"bodies": each}) for name, each in bodies.items()
    }


def main():
    """Print both tables."""
    print(f"joints {'compiled' if COMPILED else 'in Python'}")
    scene = Scene(revolutions=short, solver={"step": 1e-5})
    print(f"{'modes':>10} {'us/step':>8} {'ratio':>6}")
    runs = least(flexible(scene, counts), repeats)
    costs = {name: 1e6 * used / steps for name, (used, steps) in runs.items()}
    for name, cost in costs.items():
        print(f"{name:>10} {cost:8.0f} {cost / costs['rigid']:6.1f}")

    scene = Scene(revolutions=long)
    runs = least(flexible(scene, (4 if quick else USUAL,)), 1 if quick else 2)
    print(f"\n{long:g} revolutions, tolerance {scene.solver.tolerance:g}")
    print(f"{'modes':>10} {'s':>8} {'ratio':>6} {'steps':>8} {'ratio':>6}")
    first, usual = runs["rigid"]
    for name, (used, steps) in runs.items():
        print(f"{name:>10} {used:8.2f} {used / first:6.1f} {steps:8d} {steps / usual:6.1f}")


if __name__ == "__main__":
    main()
