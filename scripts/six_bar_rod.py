"""Make the STEP file of the scene six_bar_rod: the six-bar press's connecting rod as a solid.

A steel bar of 80 mm x 40 mm with an eye at each end, in the coordinates of the mechanism's drawing,
as a CAD program exports a part out of its assembly.
Run with: python scripts/six_bar_rod.py [FILE.step]
"""

import argparse
import math
from pathlib import Path

from netgen.occ import Axis, Box, Cylinder, Pnt, Vec, Z

parser = argparse.ArgumentParser(description=__doc__)
parser.add_argument("file", nargs="?", default="exu_press/scenes/six_bar_rod.step")
FILE = parser.parse_args().file
ENDS = (15.0, 232.0), (43.0, -595.0)  # rod pin and wrist pin, mm
WIDTH, THICKNESS = 80.0, 40.0
EYE, BORE, EYE_THICKNESS = 65.0, 35.0, 60.0  # outer radius, radius, along the pin

length = math.dist(*ENDS)
rod = Box(Pnt(0, -WIDTH / 2, -THICKNESS / 2), Pnt(length, WIDTH / 2, THICKNESS / 2))
for x in (0.0, length):
    rod += Cylinder(Pnt(x, 0, -EYE_THICKNESS / 2), Z, r=EYE, h=EYE_THICKNESS)
for x in (0.0, length):
    rod -= Cylinder(Pnt(x, 0, -EYE_THICKNESS), Z, r=BORE, h=2 * EYE_THICKNESS)
(x, y), (end_x, end_y) = ENDS
angle = math.degrees(math.atan2(end_y - y, end_x - x))
rod = rod.Rotate(Axis(Pnt(0, 0, 0), Z), angle).Move(Vec(x, y, 0))
rod.WriteStep(FILE)
size = Path(FILE).stat().st_size / 1024
print(f"{FILE}: {rod.mass * 1e-9 * 7850:.2f} kg of steel, {size:.0f} kB")
