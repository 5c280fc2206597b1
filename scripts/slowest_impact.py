"""How much contact.slowest_impact decides: peaks of three scenes over speeds about its default.

Run with: python scripts/slowest_impact.py
"""

import argparse

from exu_press import Scene, simulate

FACTORS = (0.01, 0.1, 1.0, 10.0, 100.0)
PIN = {"wrist_pin": {"kind": "dry", "clearance": 5e-5, "radius": 0.03}}
KNUCKLE = {"knuckle": {"kind": "dry", "clearance": 3e-5, "radius": 0.01}}
LENGTH = {"length": 0.03}
SCENES = {
    "slider_crank, wrist pin, 60 rpm": Scene(
        mechanism="slider_crank", speed_rpm=60.0, revolutions=1.0, joints=PIN, contact=LENGTH
    ),
    "slider_crank, wrist pin, 240 rpm": Scene(
        mechanism="slider_crank", revolutions=1.0, joints=PIN, contact=LENGTH
    ),
    "four_bar, knuckle, 60 rpm": Scene(
        mechanism="four_bar", speed_rpm=60.0, revolutions=1.0, joints=KNUCKLE, contact=LENGTH
    ),
}  # fmt: skip


def main() -> None:
    """Print peak acceleration and peak joint force over the slowest impact."""
    argparse.ArgumentParser(description=__doc__).parse_args()
    print(f"{'slowest_impact over its default':34}" + "".join(f"{f:>9g}" for f in FACTORS))
    for name, scene in SCENES.items():
        (joint,) = scene.joints.with_clearance
        default = scene.angular_speed * scene.joints[joint].clearance
        runs = [simulate(scene.replace({"contact.slowest_impact": f * default})) for f in FACTORS]
        print(name)
        for quantity, per_unit, unit in (
            ("peak_acceleration.resolved", 1.0, "m/s^2"),
            (f"joints.{joint}.peak_force", 1e-3, "kN"),
        ):
            values = [per_unit * run.quantity(quantity).value for run in runs]
            print(f"{unit:>34}" + "".join(f"{value:9.3g}" for value in values))


if __name__ == "__main__":
    main()
