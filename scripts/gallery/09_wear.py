"""Wear of a dry crank pin over ten thousand strokes: how its clearance grows."""

from exu_press import Scene
from exu_press.studies.wear import WearStudy, wear

scene = Scene(
    mechanism="slider_crank",
    joints={"crank_pin": {"kind": "dry", "clearance": 5e-5, "radius": 0.03}},
    contact={"length": 0.05},
    wear={"coefficient": 1e-6, "hardness": 2e9, "length": 0.05},
    speed_rpm=60.0,
    revolutions=1.0,
    settle=0.0,
)
study = WearStudy(scene, wear={"strokes": 1e4, "tolerance": 0.2})
report = wear(study, "out/wear", quiet=True)
clearances = report.clearances("crank_pin")
for point, clearance in zip(report.course, clearances, strict=True):
    print(f"after {point.strokes:6.0f} strokes: clearance {1e6 * clearance:.2f} um")
