"""A part of your own, from a STEP file to a flexible body in an Exudyn model: a lever under a load.

Prints mass, frequencies and the tip's deflection beside a beam's; draws modes in out/my_own_part.

Run with: python scripts/my_own_part.py [--quick]
"""

import argparse

import exudyn as exu
import numpy as np
from exudyn.itemInterface import LoadForceVector, MarkerBodyRigid, ObjectGround, ObjectJointGeneric
from netgen.occ import Box, Pnt

from exu_press.files.output_directory import output_directory
from fe_models import (
    Interface,
    Material,
    Part,
    Reduction,
    StepFile,
    add_flexible_body,
    draw_mode_shapes,
    reduced_part,
)

parser = argparse.ArgumentParser(description=__doc__)
parser.add_argument("--quick", action="store_true", help="a coarse mesh")
quick = parser.parse_args().quick

out = output_directory("out/my_own_part")
file = out / "lever.step"  # yours comes from a CAD program, in mm
Box(Pnt(0, -15, -10), Pnt(400, 15, 10)).WriteStep(str(file))

faces = {
    "root": ((0, -0.02, -0.02), (0, 0.02, 0.02)),
    "tip": ((0.4, -0.02, -0.02), (0.4, 0.02, 0.02)),
}
shape = StepFile(file, scale=1e-3, faces=faces)  # from mm to m; a box around each face to be held
steel = Material(youngs_modulus=2.1e11, poissons_ratio=0.3, density=7850.0)
size = 0.03 if quick else 0.01  # m, of the tetrahedra
solid = Part("lever", shape, steel, (Interface("root"), Interface("tip")), mesh_size=size)
lever = reduced_part(solid, Reduction(modes=10), folder=out)
draw_mode_shapes(solid, out / "modes.png", modes=(1, 2, 3, 4, 5))

mbs = exu.SystemContainer().AddSystem()
ground = mbs.AddObject(ObjectGround())
body = add_flexible_body(mbs, lever)
wall = mbs.AddMarker(MarkerBodyRigid(bodyNumber=ground))
root, tip = body.add_marker(mbs, "root"), body.add_marker(mbs, "tip")
mbs.AddObject(ObjectJointGeneric(markerNumbers=[wall, root]))
mbs.AddLoad(LoadForceVector(markerNumber=tip, loadVector=[0.0, 100.0, 0.0]))  # N
mbs.Assemble()
start = np.array(mbs.GetMarkerOutput(tip, exu.OutputVariableType.Position))
settings = exu.SimulationSettings()
settings.solution.file.write, settings.staticSolver.verboseMode = False, 0
settings.linearSolver.solverType = exu.LinearSolverType.EigenSparse
mbs.SolveStatic(settings)
moved = np.array(mbs.GetMarkerOutput(tip, exu.OutputVariableType.Position)) - start

bending = 0.4**3 / (3.0 * 2.1e11 * 0.02 * 0.03**3 / 12.0)
shear = 0.4 / (5.0 / 6.0 * 2.1e11 / 2.6 * 0.02 * 0.03)
beam = 100.0 * (bending + shear)  # Timoshenko's
print(f"mass {lever.mass:.4f} kg; free frequencies {np.round(lever.frequencies[:4], 1)} Hz")
print(f"tip moves {moved[1] * 1e6:.1f} um under 100 N; a beam's {beam * 1e6:.1f} um")
