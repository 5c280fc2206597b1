"""Clearance of the crank pin: what a dry and a lubricated pin make of it, at one speed.

Run with: python scripts/sweep_clearance.py [--quick] [--out DIR]
"""

import argparse
from dataclasses import replace
from pathlib import Path

from exu_press import Scene
from exu_press.plots.file import save_figure
from exu_press.studies.sweep import Sweep, sweep
from exu_press.studies.sweep.figure import sweep_picture

parser = argparse.ArgumentParser(description=__doc__)
parser.add_argument("--quick", action="store_true", help="four short runs")
parser.add_argument("--out", metavar="DIR", default="out/sweep_clearance", type=Path)
options = parser.parse_args()
quick, out = options.quick, options.out

scene = Scene(
    joints={"crank_pin": "lubricated"},
    revolutions=0.02 if quick else 2.0,
    load={"blanking": {"kind": "blanking", "force": 1e4}},
)
clearances = [5e-5, 2e-4] if quick else [5e-5, 7.5e-5, 1e-4, 1.25e-4, 1.5e-4, 1.75e-4, 2e-4]
study = Sweep(
    scene=scene,
    keys={"joints.crank_pin": ["dry", "lubricated"], "joints.crank_pin.clearance": clearances},
    errors=True,
)
quantities = (
    "peak_acceleration.resolved",
    "peak_acceleration.mean_1ms",
    "joints.crank_pin.peak_force",
)
report = replace(sweep(study, out, quiet=quick), selected=quantities)
print("\n".join(report.lines()))
if (figure := sweep_picture(report)) is not None:
    print(save_figure(figure, out / "sweep.png"))
