"""Crank speed: forces grow with its square, accelerations with less; the film gets thinner.

Run with: python scripts/sweep_speed.py [--quick] [--out DIR]
"""

import argparse
from dataclasses import replace
from pathlib import Path

from exu_press import Scene
from exu_press.plots.file import save_figure
from exu_press.studies.sweep import Sweep, sweep
from exu_press.studies.sweep.figure import sweep_picture

parser = argparse.ArgumentParser(description=__doc__)
parser.add_argument("--quick", action="store_true", help="two short runs")
parser.add_argument("--out", metavar="DIR", default="out/sweep_speed", type=Path)
options = parser.parse_args()
quick, out = options.quick, options.out

scene = Scene(
    revolutions=0.02 if quick else 2.0, load={"blanking": {"kind": "blanking", "force": 1e4}}
)
speeds = [200.0, 500.0] if quick else [200.0, 250.0, 300.0, 350.0, 400.0, 450.0, 500.0]
study = Sweep(scene=scene, keys={"speed_rpm": speeds}, errors=True)
quantities = (
    "peak_acceleration.mean_1ms",
    "joints.crank_pin.peak_force",
    "joints.crank_pin.min_film",
)
report = replace(sweep(study, out, quiet=quick), selected=quantities)
print("\n".join(report.lines()))
if (figure := sweep_picture(report)) is not None:
    print(save_figure(figure, out / "sweep.png"))
