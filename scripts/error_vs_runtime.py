"""Error against run time of a scene of your own: fixed steps, tolerances, other solvers if any.

Run with: python scripts/error_vs_runtime.py [--quick]
"""

import sys

from exu_press import Scene
from exu_press.output import output_directory
from exu_press.plots.precision import save_precision
from exu_press.studies.precision import case_of, precision

scene = Scene(mechanism="slider_crank", joints={"crank_pin": "lubricated"}, revolutions=1.0)
report = precision((case_of("my_slider_crank", scene),), quick="--quick" in sys.argv)
save_precision(report, output_directory("out/error_vs_runtime"))
print("\n".join(report.lines()))
