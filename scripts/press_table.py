#!/usr/bin/env python3
"""Steps and figures of press scenes, each run once: guards a change that must not change them.

    press_table.py OUT.json                     write the table of the installed exu_press
    press_table.py OUT.json --against OLD.json  and say what differs from an older one
    press_table.py OUT.json --only NAME ...     some scenes only

Compare two tables of one machine: digits past the tenth depend on the processor.
"""

import argparse
import json
import time
import warnings
from collections.abc import Callable, Sequence
from pathlib import Path

import numpy as np

import exu_press
from exu_press import Scene
from exu_press.result.run import run_once
from exu_press.scene import flexible_press

SHIPPED = Path(exu_press.__file__).parent / "scenes"
DRY = {"crank_pin": "dry", "balls": "dry"}

CONTINUED = "press dry, continued"
"""Scene that goes on from the end of an earlier run of itself, as `exu-press run --from` does."""

SINGLE_STROKE = {
    "rated_torque": 400.0,
    "inertia": 300.0,
    "begins": "standing",
    "driven_inertia": 2.0,
    "clutch_torque": 3000.0,
    "brake_torque": 1500.0,
    "start_time": [0.0],
    "brake_off": [0.0, 0.02],
    "clutch_on": [0.03, 0.06],
    "stop_angle_deg": 20.0,
    "clutch_off": [0.0, 0.02],
    "brake_on": [0.02, 0.05],
    "ends_after": 0.05,
}
"""Start and stop of `docs/howto/start_stop.md`, within a part of a revolution."""

GAS_SPRING = {
    "kind": "spring",
    "height": 0.02,
    "travel": [0.0, 2e-4, 0.021],
    "force": [0.0, 2e3, 3e3],
    "damping": 0.2,
}
FORMING = {"kind": "table", "height": [0.0, 0.02], "force": [5e3, 0.0]}
WORN = {"kind": "dry", "worn": {"bearing_depth": [0.0, 0.0, 4e-6, 8e-6, 4e-6, 0.0]}}


def shipped_scene(name: str, revolutions: float) -> Scene:
    """Return a shipped scene, shortened, with the start included unless a schedule needs it."""
    scene = Scene.load(SHIPPED / f"{name}.toml")
    scheduled = scene.drive is not None and scene.drive.has_schedule
    return scene.replace({"revolutions": revolutions} | ({} if scheduled else {"settle": 0.0}))


SCENES: dict[str, Callable[[], Scene]] = {
    "press ideal": lambda: Scene(joints={}, revolutions=0.3),
    "press dry": lambda: Scene(joints=DRY, revolutions=0.1),
    "press lubricated": lambda: Scene(revolutions=0.1),
    "press mixed": lambda: Scene(revolutions=0.05, film={"at_contact": "mixed", "law": "finite"}),
    "press fixed step": lambda: Scene(revolutions=0.05, solver={"step": 1e-4}),
    "press flexible": lambda: Scene(bodies=flexible_press(modes=8), revolutions=0.03),
    "press flexible ideal": lambda: Scene(
        joints={}, bodies=flexible_press(modes=8), revolutions=0.05
    ),
    "press blanking and guide friction": lambda: Scene(
        joints={},
        load={"b": {"kind": "blanking", "force": 1e4}},
        guide={"friction": "coulomb"},
        revolutions=0.6,
    ),
    "press guide with clearance": lambda: Scene(
        joints={}, guide={"clearance": 2e-5}, contact={"damping": "hu_guo"}, revolutions=0.05
    ),
    "press elastic guide": lambda: Scene(
        joints={}, guide={"lateral_stiffness": 1e9}, revolutions=0.05
    ),
    "press motor": lambda: Scene(
        joints={}, drive={"rated_torque": 400.0, "inertia": 50.0}, revolutions=0.3
    ),
    "press lugre": lambda: Scene(joints=DRY, friction={"law": "lugre"}, revolutions=0.03),
    "press samples": lambda: Scene(joints={}, output={"samples": [0.0, 180.0]}, revolutions=1.1),
    "slider_crank": lambda: shipped_scene("slider_crank", 0.12),
    "drag_link": lambda: shipped_scene("drag_link", 0.12),
    "drag_link_shop": lambda: shipped_scene("drag_link_shop", 0.05),
    "six_bar_rod": lambda: shipped_scene("six_bar_rod", 0.03),
    "press file": lambda: shipped_scene("press", 0.1),
    "press dry, half a revolution": lambda: Scene(joints=DRY, revolutions=0.5),
    "press lubricated, half a revolution": lambda: Scene(revolutions=0.5),
    "press ideal, one revolution": lambda: Scene(joints={}, revolutions=1.0),
    "press motor samples": lambda: Scene(
        joints={},
        drive={"rated_torque": 400.0, "inertia": 50.0},
        output={"samples": [0.0, 90.0, 180.0, 270.0]},
        revolutions=1.1,
    ),
    "press clutch and brake": lambda: Scene(
        mechanism="eccentric_press",
        joints={},
        speed_rpm=60.0,
        drive=SINGLE_STROKE,
        revolutions=0.5,
    ),
    "press lubricated ball": lambda: Scene(
        joints={"crank_pin": "ideal", "balls": "lubricated"}, revolutions=0.05
    ),
    "slider_crank worn joint": lambda: Scene(
        mechanism="slider_crank", joints={"crank_pin": WORN}, revolutions=0.1
    ),
    "press gas spring": lambda: Scene(joints={}, load={"cushion": GAS_SPRING}, revolutions=0.6),
    "press load over height": lambda: Scene(joints={}, load={"form": FORMING}, revolutions=0.6),
    CONTINUED: lambda: Scene(joints=DRY, revolutions=0.03),
}


def figures(name: str) -> dict[str, object]:
    """Run a scene once; return its counts and what tells a change of its motion and forces."""
    scene = SCENES[name]()
    began = time.process_time()
    result = run_once(scene)
    if name == CONTINUED:
        result = run_once(scene, start=result.info["state"])
    largest = [float(np.linalg.norm(joint.force, axis=1).max()) for joint in result.joints.values()]
    counts = {
        key: result.info[key] for key in ("status", "steps", "rejected_steps", "newton_iterations")
    }
    return counts | {
        "peak_acceleration": float(np.abs(result["slider_acceleration"]).max()),
        "lowest": float(result["slider_position"].min()),
        "last": float(result["slider_position"][-1]),
        "torque": float(np.abs(result["drive_torque"]).max()),
        "force": max(largest),
        "processor_time": round(time.process_time() - began, 2),
    }


def report_changes(table: dict[str, dict[str, object]], path: Path) -> int:
    """Print which figures differ from those of an older table; return how many."""
    old = json.loads(path.read_text(encoding="utf-8"))
    changed = 0
    for name, figures_now in table.items():
        if name not in old:
            print(f"NEW      {name}: not in {path.name}")
            continue
        for key, value in figures_now.items():
            if key != "processor_time" and value != old[name][key]:
                changed += 1
                print(f"CHANGED  {name}: {key} {old[name][key]} -> {value}")
    print(f"{changed} figures of {len(table)} scenes differ from {path.name}")
    return changed


def main(arguments: Sequence[str] | None = None) -> int:
    """Write the table; print what differs from an older one; return 1 if anything does."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("out", type=Path)
    parser.add_argument("--against", type=Path)
    parser.add_argument("--only", nargs="*", default=list(SCENES))
    options = parser.parse_args(arguments)
    warnings.simplefilter("ignore")
    table: dict[str, dict[str, object]] = {}
    for name in options.only:
        table[name] = figures(name)
        print(f"{name:36}", *table[name].values(), flush=True)
    options.out.write_text(json.dumps(table, indent=1) + "\n", encoding="utf-8")
    return 1 if options.against is not None and report_changes(table, options.against) else 0


if __name__ == "__main__":
    raise SystemExit(main())
