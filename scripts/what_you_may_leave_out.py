"""What each choice of a scene costs, and what leaving it out changes: one table.

Run with: python scripts/what_you_may_leave_out.py [--quick]
"""

import argparse
import sys
import time

from exu_press import Scene, simulate
from exu_press.scene import flexible_press

parser = argparse.ArgumentParser(description=__doc__)
parser.add_argument("--quick", action="store_true", help="a fiftieth of a revolution")
QUICK = parser.parse_args().quick

FULL = {
    "bodies": flexible_press(),
    "joints": {"crank_pin": "lubricated", "balls": "dry"},
    "revolutions": 0.02 if QUICK else 1.0,
    "film": {"law": "finite"},
    "friction": {"law": "lugre"},
    "guide": {"lateral_stiffness": 1e9},
}
RIGID = {"bodies": {}}
CHOICES = {
    "everything": {},
    "10 modes instead of 20": {"bodies": flexible_press(modes=10)},
    "4 modes": {"bodies": flexible_press(modes=4)},
    "rigid crank and linkage": RIGID,
    "ideal guides": {"guide": None},
    "short-bearing film": {"film": {"law": "short"}},
    "long-bearing film (the paper's)": {"film": {"law": "pinkus"}},
    "ideal pin instead of a film": {"joints": {"balls": "dry"}, "film": None},
    "friction without bristles": {"friction": {"law": "lugre_steady"}},
    "no friction": {"friction": {"law": "none"}},
    "ideal balls": {"joints": {"crank_pin": "lubricated"}, "friction": None},
    "tolerance 1e-2 instead of 1e-3": {"solver": {"tolerance": 1e-2}},
    "tolerance 1e-4": {"solver": {"tolerance": 1e-4}},
    "rigid, ideal guides": {**RIGID, "guide": None},
    "only the mechanism": {**RIGID, **dict.fromkeys(["guide", "film", "friction"]), "joints": {}},
}
FIGURES = {
    "peak a, m/s^2": ("peak_acceleration.resolved", 1.0),
    "over 1 ms": ("peak_acceleration.mean_1ms", 1.0),
    "at 1 kHz": ("peak_acceleration.differentiated_1khz", 1.0),
    "bottom, mm": ("bottom_dead_centre", 1e3),
    "torque over 1 ms, N m": ("drive.peak_torque_mean_1ms", 1.0),
}


def scene_of(changes):
    return Scene(**{key: table for key, table in (FULL | changes).items() if table is not None})


def row(label, changes):
    scene = scene_of(changes)
    start = time.process_time()
    result = simulate(scene)
    cost = time.process_time() - start
    if result.info["status"] not in ("completed", "under-resolved"):
        sys.exit(f"{label}: {result.info['reason']}")
    return cost, [scale * result.quantity(name).value for name, scale in FIGURES.values()]


simulate(scene_of({"revolutions": 1e-3}))  # reduce the parts and import before the clock runs
print(f"{'':34}{'cost':>7}" + "".join(f"{name:>23}" for name in FIGURES))
reference = None
for label, changes in CHOICES.items():
    cost, figures = row(label, changes)
    reference = reference or (cost, figures)
    print(f"{label:34}{cost / reference[0]:7.2f}" + "".join(f"{x:23.5g}" for x in figures))
