"""The dry press's peak acceleration in its first two revolutions, over the tolerance.

Run with: python scripts/dry_press_peaks.py [--quick]

The independent model is that of tests/independent/symmetric_press.py, which shares no code with the
package: three coordinates, SciPy's LSODA.
"""

import argparse
import sys
from pathlib import Path

import numpy as np

from exu_press import Result, Scene, simulate
from exu_press.quantities.uncertain import uncertain
from exu_press.result.windows import revolutions_of
from exu_press.terminal.columns import columns

sys.path.append(str(Path(__file__).parents[1] / "tests"))
from independent.reduced_slider_crank import Numbers
from independent.symmetric_press import SymmetricPress

DRY = Scene(joints={"crank_pin": "dry", "balls": "dry"})
NAME = "peak_acceleration.resolved"
parser = argparse.ArgumentParser(description=__doc__)
parser.add_argument("--quick", action="store_true", help="a tenth of a revolution, one tolerance")
QUICK = parser.parse_args().quick
TOLERANCES = (1e-2,) if QUICK else (1e-2, 1e-3, 1e-4, 1e-5)
REVOLUTIONS = 0.1 if QUICK else 2.0


def peaks(run: Result) -> list[float]:
    """Return a run's peak in every revolution, m/s^2."""
    parts = revolutions_of(run) or [run]
    return [float(np.abs(channels["slider_acceleration"]).max()) for channels in parts]


model = SymmetricPress("lugre_steady", Numbers(clearance=1e-4, speed=DRY.angular_speed))
solution = model.solved(REVOLUTIONS * 60.0 / DRY.speed_rpm, 1e-11)
true = model.peaks(solution.t, solution.y)
rows = [("tolerance", "by revolution, m/s^2", "off", "whole run, as stated")]
for tolerance in TOLERANCES:
    change = {"solver.tolerance": tolerance, "revolutions": REVOLUTIONS}
    run = simulate(DRY.replace(change), errors=True)
    computed = peaks(run)
    rows.append(
        (
            f"{tolerance:g}",
            " ".join(f"{peak:.1f}" for peak in computed),
            " ".join(
                f"{peak / reference - 1.0:+.2%}"
                for peak, reference in zip(computed, true, strict=True)
            ),
            uncertain(max(computed), run.info["errors"][NAME]),
        )
    )
rows.append(("independent model", " ".join(f"{peak:.1f}" for peak in true), "", ""))
print("\n".join(columns(rows)))
