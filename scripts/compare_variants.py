"""Ideal, dry and lubricated joints side by side: a table, and their curves in one picture.

Run with: python scripts/compare_variants.py [--quick]
"""

import argparse

from exu_press import Scene, simulate
from exu_press.files.output_directory import output_directory
from exu_press.plots import save_comparison
from exu_press.quantities.table import comparison_lines
from exu_press.studies.compare import variants

parser = argparse.ArgumentParser(description=__doc__)
parser.add_argument("--quick", action="store_true", help="a tenth of a revolution")
scene = Scene(revolutions=0.1 if parser.parse_args().quick else 2.0)
results = {label: simulate(variant) for label, variant in variants(scene).items()}
save_comparison(results, output_directory("out/compare_variants"))
print("\n".join(comparison_lines(results)))
