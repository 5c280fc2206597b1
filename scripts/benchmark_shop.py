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

SHOP = Scene.load(Path(exu_press.__file__).parent / "scenes" / "drag_link_shop.toml")
SHORT = {"revolutions": 0.1, "settle": 0.0} if QUICK else {}
CHANGES = {
    "no wear": {"wear": None},
    "oil of one viscosity": {"film.oil": None, "film.viscosity": 0.0375},
    "no motor": {"drive": None},
    "no sheet": {"load": {}},
    "ideal guide": {"guide": None},
}
TABLE = {"kind": "table", "height": [0.0, 2.2e-3, 2.9e-3, 3e-3], "force": [0.0, 3.2e5, 2.6e5, 0.0]}
USUAL = {
    **CHANGES["no wear"],
    **CHANGES["oil of one viscosity"],
    "load": {"sheet": TABLE},
    "guide.viscosity": None,
    "guide.face_width": None,
    "guide.contact_gap": None,
}
"""A table of forces for the sheet, and a guide whose clearance is dry."""
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
print(f"{'':38}{'steps':>8}{'time over that of all':>24}")
print(f"{'everything':38}{steps:8}{1.0:24.2f}")
for part in CHANGES:
    steps, time_taken = cost(without(part))
    print(f"{part:38}{steps:8}{time_taken / everything:24.2f}")
for label, scene in (
    ("none of them", without(*CHANGES)),
    ("force table, dry guide, one viscosity", without().replace(USUAL)),
):
    steps, time_taken = cost(scene)
    print(f"{label:38}{steps:8}{time_taken / everything:24.2f}")
