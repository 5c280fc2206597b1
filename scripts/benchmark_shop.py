"""What each part of the shop's scene costs: processor time without it, over that of all.

Run with: python scripts/benchmark_shop.py [--quick]
"""

import argparse
import time
from pathlib import Path

import exu_press
from exu_press import Scene, simulate

parser = argparse.ArgumentParser(description=__doc__)
parser.add_argument("--quick", action="store_true", help="a tenth of a revolution, once")
QUICK = parser.parse_args().quick

SHOP = Scene.load(Path(exu_press.__file__).parent / "scenes" / "shop.toml")
SHORT = {"revolutions": 0.1, "settle": 0.0} if QUICK else {}
CHANGES = {
    "no wear": {"wear": None},
    "oil of one viscosity": {"film.oil": None, "film.viscosity": 0.0375},
    "no motor": {"drive": None},
    "no sheet": {"load": {}},
    "ideal guide": {"guide": None},
}
REPEATS = 1 if QUICK else 3


def without(*parts):
    scene = SHOP.replace(SHORT) if SHORT else SHOP
    changes = {key: value for part in parts for key, value in CHANGES[part].items()}
    return scene.replace(changes) if changes else scene


def cost(scene):
    """Return steps and the least processor time of some runs, s."""
    times = []
    for _ in range(REPEATS):
        begin = time.process_time()
        result = simulate(scene)
        times.append(time.process_time() - begin)
    return result.info["steps"], min(times)


simulate(SHOP.replace({"revolutions": 0.01, "settle": 0.0}))  # imports, before the clock runs
steps, everything = cost(without())
print(f"{'':34}{'steps':>8}{'time over that of all':>24}")
print(f"{'everything':34}{steps:8}{1.0:24.2f}")
for part in CHANGES:
    steps, time_taken = cost(without(part))
    print(f"{part:34}{steps:8}{time_taken / everything:24.2f}")
steps, plain = cost(without(*CHANGES))
print(f"{'none of them':34}{steps:8}{plain / everything:24.2f}")
