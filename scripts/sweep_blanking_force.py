"""Blanking force: what it changes in the motion of the slider, and what the joints carry.

Run with: python scripts/sweep_blanking_force.py [--quick] [--out DIR]
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
parser.add_argument("--out", metavar="DIR", default="out/sweep_blanking_force", type=Path)
options = parser.parse_args()
quick, out = options.quick, options.out

start, turns = (170.0, 0.04) if quick else (0.0, 2.0)
load = {"blanking": {"kind": "blanking", "force": 0.0}}
scene = Scene(revolutions=turns, start_angle_deg=start, load=load)
forces = [1e4, 4e4] if quick else [0.0, 1e4, 2e4, 3e4, 4e4]
study = Sweep(scene=scene, keys={"load.blanking.force": forces}, errors=True)
quantities = ("bottom_dead_centre", "peak_acceleration.mean_1ms", "joints.crank_pin.peak_force")
report = replace(sweep(study, out, quiet=quick), selected=quantities)
print("\n".join(report.lines()))
if (figure := sweep_picture(report)) is not None:
    print(save_figure(figure, out / "sweep.png"))
