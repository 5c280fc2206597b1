"""The press once: its summary in the terminal, its result file and pictures in out/run_press.

Run with: python scripts/run_press.py [--quick]
"""

import argparse
import sys

from exu_press import Scene, simulate
from exu_press.files.output_directory import output_directory
from exu_press.plots import save_pictures
from exu_press.quantities.table import run_lines

parser = argparse.ArgumentParser(description=__doc__)
parser.add_argument("--quick", action="store_true", help="a tenth of a revolution")
quick = parser.parse_args().quick

scene = Scene(
    joints={
        "crank_pin": {"kind": "lubricated", "clearance": 1e-4},  # radial, m
        "balls": {"kind": "dry", "clearance": 1e-4},
    },
    speed_rpm=240.0,
    revolutions=0.1 if quick else 2.0,
    film={"law": "finite", "viscosity": 0.1},  # Pa s
)
result = simulate(scene)
out = output_directory("out/run_press")
result.save(out / "run.nc")
save_pictures(result, out)
print("\n".join(run_lines(result)))
if not result.completed:
    sys.exit(result.info["reason"])
