"""Crank shaft and linkage: their frequencies beside the paper's, mode shapes, and what they change.

The fit is not unique: crank_2 and linkage_2 meet the published frequencies as well. The last table
shows the press with one pair of shapes and with the other.

Run with: python scripts/flexible_parts.py [--quick] [--out DIR]
"""

import argparse
from pathlib import Path

from exu_press import Scene, simulate
from exu_press.quantities import Quantity, QuantityAt
from exu_press.quantities.kind import LOAD, MOTION
from exu_press.quantities.reading import Reading
from exu_press.quantities.uncertain import uncertain
from exu_press.scene import flexible_press
from exu_press.terminal.columns import columns
from exu_press.verification.refinement import plan
from exu_press.verification.run import errors_of
from fe_models import clamped_frequencies, draw_mode_shapes, shipped_part
from fe_models.clamped import MODE_NUMBERS, PUBLISHED_HZ, relative_errors

parser = argparse.ArgumentParser(description=__doc__)
parser.add_argument("--quick", action="store_true", help="coarse meshes, a short run")
parser.add_argument("--out", metavar="DIR", default="out/parts", type=Path)
options = parser.parse_args()
quick, out = options.quick, options.out
out.mkdir(parents=True, exist_ok=True)
mesh_size = 0.06 if quick else 0.02

numbers = "".join(f"{number:>9}" for number in MODE_NUMBERS)
print(f"Hz, bearing surfaces clamped, mode {numbers}      rms")
for name, published in PUBLISHED_HZ.items():
    print(f"{name + ', paper':34} " + "".join(f"{hz:9.1f}" for hz in published))
    for shape in (name, f"{name}_2"):
        hz = clamped_frequencies(shipped_part(shape, mesh_size), max(MODE_NUMBERS))
        errors = relative_errors(hz, published)
        rms = (errors**2).mean() ** 0.5
        print(f"{shape:34} " + "".join(f"{hz[n - 1]:9.1f}" for n in MODE_NUMBERS))
        print(f"{'':34} " + "".join(f"{e:+9.1%}" for e in errors) + f"  {rms:7.1%}")
for name in PUBLISHED_HZ:
    draw_mode_shapes(shipped_part(name, mesh_size), out / f"modes_{name}.png")


def figures(reading: Reading) -> dict[str, float]:
    """Return the columns of the last table that a run has, in their units."""
    run = reading.result
    found = {
        "acceleration": run.quantity("peak_acceleration.resolved").value,
        "mean_1ms": run.quantity("peak_acceleration.mean_1ms").value,
    }
    if "crank_pin_deflection" in run:
        found["deflection"] = 1e6 * abs(run["crank_pin_deflection"]).max()
        stress = [part["von_mises"] for part in run.info["stress"].values()]
        found["stress"] = 1e-6 * max(stress)
    return found


KINDS = {"acceleration": LOAD, "mean_1ms": LOAD, "deflection": MOTION, "stress": MOTION}
COLUMNS = {
    name: QuantityAt(
        Quantity(name, "", name, kind, lambda run, _, name=name: run.once(figures).get(name))
    )
    for name, kind in KINDS.items()
}
rows = [("lubricated press, 240 rpm", "m/s^2", "over 1 ms", "um", "MPa")]
scene = Scene(revolutions=0.01 if quick else 0.2)
flexible = scene.replace({"bodies": flexible_press()})
second = scene.replace({"bodies": {"crank": "crank_2", "linkage": "linkage_2"}})
for label, case in (("rigid", scene), ("flexible", flexible), ("flexible, second shapes", second)):
    result, beside = simulate(case), plan(case).items()
    told = errors_of(result, ((r, simulate(one)) for r, one in beside), COLUMNS)["errors"]
    texts = [uncertain(value, told[name]) for name, value in figures(Reading(result)).items()]
    rows.append((label, *texts, *[""] * (4 - len(texts))))
print("", *columns(rows), sep="\n")
