"""The clearance of a pin from readings of an instrument: those of a run, so that it is known."""

from exu_press import Scene, simulate
from exu_press.studies.fit import Fit, fit

TRUE = 8e-5  # m
scene = Scene(
    mechanism="slider_crank",
    joints={"crank_pin": {"kind": "lubricated", "clearance": 1e-4}},
    film={"law": "short", "viscosity": 0.1, "length": 0.05},
    revolutions=0.5,
)
run = simulate(scene.replace({"joints.crank_pin.clearance": TRUE}))
names = ("bottom_dead_centre", "joints.crank_pin.max_eccentricity_ratio")
uncertainties = (1e-6, 1e-3)
measured = [
    {"quantity": name, "value": run.quantity(name).value, "uncertainty": uncertainty}
    for name, uncertainty in zip(names, uncertainties, strict=True)
]
keys = {"joints.crank_pin.clearance": {"low": 5e-5, "high": 2e-4, "log": True}}
report = fit(Fit(scene, keys, measured=measured), "out/fit_clearance", quiet=True)
(key,) = keys
clearance, low, high = report.values[key], report.low[key], report.high[key]
print(f"clearance {1e6 * clearance:.2f} um, 95 % in {1e6 * low:.2f} to {1e6 * high:.2f} um")
