"""Error against run time of a scene of your own: fixed steps, tolerances, other solvers if any.

Run with: python scripts/error_vs_runtime.py [--quick]
"""

import argparse

from exu_press import Scene
from exu_press.files.output_directory import output_directory
from exu_press.plots.file import save_figure
from exu_press.studies.precision import case_of, precision
from exu_press.studies.precision.figure import precision_figure

parser = argparse.ArgumentParser(description=__doc__)
parser.add_argument("--quick", action="store_true", help="a reduced form; times mean nothing")
quick = parser.parse_args().quick

scene = Scene(mechanism="slider_crank", joints={"crank_pin": "lubricated"}, revolutions=1.0)
report = precision((case_of("my_slider_crank", scene),), quick=quick)
directory = output_directory("out/error_vs_runtime")
save_figure(precision_figure(report, "my_slider_crank"), directory / "my_slider_crank.png")
print("\n".join(report.lines()))
