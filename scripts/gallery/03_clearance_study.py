"""How the force in a dry crank pin grows with its clearance."""

from exu_press import Scene
from exu_press.studies.sweep import Sweep, sweep

scene = Scene(mechanism="slider_crank", joints={"crank_pin": "dry"}, revolutions=0.25)
clearances = [2e-5, 5e-5, 1e-4, 2e-4]  # radial, m
study = Sweep(scene, {"joints.crank_pin.clearance": clearances})
table = sweep(study, "out/clearance_study", quiet=True)
forces = list(table["joints.crank_pin.peak_force"])
for clearance, force in zip(clearances, forces, strict=True):
    print(f"clearance {1e6 * clearance:5.0f} um: largest force {force:8.1f} N")
