"""What a long run costs: time over the integration's alone, memory, and the size of its file.

    python scripts/benchmark_long_run.py [--revolutions 1000] [--scene press]

The scene's [output] keeps a sample once a revolution and no channels. The process that is measured
does nothing else: memory is its largest resident set.
"""

import argparse
import resource
import sys
import tempfile
import time
from pathlib import Path

from exu_press import Scene, simulate

SCENES = {
    "press": {
        "mechanism": "press",
        "joints": {"crank_pin": "lubricated"},
        "film": {"law": "finite"},
    },
    "slider_crank": {
        "mechanism": "slider_crank",
        "joints": {"crank_pin": {"kind": "dry", "clearance": 1e-4, "radius": 0.07}},
        "contact": {"length": 0.1},
    },
}
"""The lubricated press, and a dry slider-crank."""


def main() -> None:
    """Run a scene, read all of its quantities, save it, and print what that took."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--revolutions", type=float, default=1000.0)
    parser.add_argument("--scene", choices=SCENES, default="press")
    options = parser.parse_args()
    scene = Scene.from_dict(
        {
            **SCENES[options.scene],
            "revolutions": options.revolutions,
            "output": {"channels": [], "samples": [0.0]},
            "solver": {"max_steps": 10**9},
        }
    )
    loaded = _memory()
    begin = time.perf_counter()
    result = simulate(scene)
    ran = time.perf_counter()
    run = _memory()
    with tempfile.TemporaryDirectory() as place:
        file = Path(place) / "run.nc"
        result.save(file)  # with its quantities
        saved = time.perf_counter()
        size = file.stat().st_size
    integration = result.info["wall_time"]
    print(f"{options.scene}, {options.revolutions:g} revolutions: {result.info['status']}")
    print(f"steps                        {result.info['steps']:,}")
    print(f"integration, s               {integration:.1f}")
    print(f"whole run over that          {(ran - begin) / integration:.3f}")
    print(f"with quantities and file     {(saved - begin) / integration:.3f}")
    print(f"memory: package, run, file   {loaded:.0f}, {run:.0f}, {_memory():.0f} MB")
    print(f"file                         {size / 1e6:.2f} MB")


def _memory() -> float:
    """Return the largest resident set of this process so far, MB."""
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / (
        1e6 if sys.platform == "darwin" else 1e3
    )


if __name__ == "__main__":
    main()
