"""Do the stated errors cover the true ones? Random scenes, each against a much finer run.

    python scripts/calibrate_errors.py [--scenes 60] [--seed 1] [--reference 1e-7]

Presses and slider-cranks, dry, lubricated and mixed, 0.2 to 3 revolutions, clearances of 20 to
200 um, 60 to 400 rpm, tolerances of 3e-4 to 3e-3. Each scene's figures are held against those of
the same scene at the reference tolerance. Beyond the horizon no tolerance gives a true value: there
the reference is one further run that has nothing in common with the first. Prints the share of
figures whose stated error covers the true one, and how many times as large it is in the median.
"""

import argparse
import sys
import time
from collections.abc import Iterator

import numpy as np

from exu_press import Scene, simulate
from exu_press.confidence import simulate_with_errors
from exu_press.confidence.figures import figures
from exu_press.scene import flexible_press

NOTHING = 1e-6
"""Over a figure: smaller errors are no matter of tolerances."""


def random_scene(random: np.random.Generator, longest: float, flexible: float) -> Scene:
    """Return a random scene of at most `longest` revolutions; some presses are flexible."""
    press = random.random() < 0.5
    pin = random.choice(["dry", "lubricated", "mixed"])
    pin_joint = {
        "kind": "dry" if pin == "dry" else "lubricated",
        "clearance": float(10.0 ** random.uniform(-4.7, -3.7)),
    }
    given = {
        "mechanism": "press" if press else "slider_crank",
        "speed_rpm": float(random.uniform(60.0, 400.0)),
        "revolutions": float(0.2 * (longest / 0.2) ** random.random()),
        "start_angle_deg": float(random.uniform(0.0, 360.0)),
        "joints": {"crank_pin": pin_joint},
        "solver": {"tolerance": float(10.0 ** random.uniform(-3.5, -2.5))},
    }
    if pin == "mixed":
        given["film"] = {"at_contact": "mixed", "viscosity": float(10.0 ** random.uniform(-3, -1))}
    if press:
        balls = {"kind": "dry", "clearance": float(10.0 ** random.uniform(-4.7, -3.7))}
        given["joints"]["balls"] = balls
        if random.random() < flexible:
            given["bodies"] = flexible_press()
    return Scene.from_dict(given)


def judged(scene: Scene, reference: float) -> Iterator[tuple[str, float, float, bool]]:
    """Yield name, true and stated error over the figure, and whether it is covered."""
    result = simulate_with_errors(scene)
    found = figures(result.summary())
    true = figures(simulate(scene.replace("solver.tolerance", reference)).summary())
    for name, told in result.info["errors"].items():
        value = found[name]
        if name in true and value != 0.0:
            off = abs(value - true[name])
            covered = told["low"] <= true[name] <= told["high"] or off <= NOTHING * abs(value)
            yield name, off / abs(value), told["error"] / abs(value), covered


def main(arguments: list[str]) -> None:
    """Judge random scenes and print what came out."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--scenes", type=int, default=60)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--reference", type=float, default=1e-7, help="tolerance")
    parser.add_argument("--longest", type=float, default=3.0, help="revolutions")
    parser.add_argument("--flexible", type=float, default=0.1, help="share of the presses")
    options = parser.parse_args(arguments)
    random = np.random.default_rng(options.seed)
    every = []
    for number in range(options.scenes):
        scene = random_scene(random, options.longest, options.flexible)
        begun = time.perf_counter()
        found = list(judged(scene, options.reference))
        every += found
        share = np.mean([covered for *_, covered in found])
        missed = sorted((n for n, _, _, covered in found if not covered))
        pin = scene.joints["crank_pin"].kind
        film = "mixed" if scene.film and scene.film.at_contact == "mixed" else pin
        print(
            f"{number + 1:3d} {scene.mechanism} {scene.bodies} {film}, {scene.revolutions:.2f} "
            f"revolutions: {share:.1%} of {len(found)} covered, "
            f"{time.perf_counter() - begun:.0f} s {', '.join(missed[:6])}",
            flush=True,
        )
        ratios = [told / off for _, off, told, _ in every if off > NOTHING]
        print(
            f"    so far {np.mean([covered for *_, covered in every]):.1%} of {len(every)} figures "
            f"covered, stated over true error in the median {np.median(ratios or [0.0]):.1f}",
            flush=True,
        )


if __name__ == "__main__":
    main(sys.argv[1:])
