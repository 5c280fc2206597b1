"""What a long run costs: time over the integration's alone, memory, and the size of its file.

    python scripts/benchmark_long_run.py [--revolutions 1000] [--scene press] [--attractor]

The scene's [output] keeps a sample once a revolution and no channels. With --attractor it is
`exu-press attractor` that is measured, against the integration of its revolutions, their neighbours
and their errors. The process does nothing else: memory is its largest resident set. Times are
processor times, which another process beside changes little.
"""

import argparse
import resource
import sys
import tempfile
import time
from pathlib import Path

from exu_press import Scene, simulate
from exu_press.integrate import Outcome
from exu_press.model import Model

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


SOLVE = Model.solve


class Integration:
    """The processor time that models take to be solved, s."""

    spent = 0.0

    @classmethod
    def solve(cls, model: Model, **options: bool) -> Outcome:
        """Solve a model, and add what that takes."""
        begin = time.process_time()
        try:
            return SOLVE(model, **options)
        finally:
            cls.spent += time.process_time() - begin


def main() -> None:
    """Run a scene, and print what that took."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--revolutions", type=int, default=1000)
    parser.add_argument("--scene", choices=SCENES, default="press")
    parser.add_argument("--attractor", action="store_true")
    options = parser.parse_args()
    scene = Scene.from_dict(
        {
            **SCENES[options.scene],
            "revolutions": float(options.revolutions),
            "output": {"channels": [], "samples": [0.0]},
            "solver": {"max_steps": 10**9},
        }
    )
    Model.solve = lambda model, **keys: Integration.solve(model, **keys)  # type: ignore[method-assign]
    if options.attractor:
        _long_run(scene, options.revolutions)
    else:
        _run(scene)


def _long_run(scene: Scene, revolutions: int) -> None:
    """Find period and exponent, with the figures of all revolutions."""
    from exu_press.studies.attractor import attractor  # would count as the other's memory

    begin = time.process_time()
    found = attractor(scene, revolutions=revolutions, skip=10, most=4)
    total = time.process_time() - begin
    print(f"{scene.mechanism}, attractor of {revolutions} revolutions: {found.period}")
    print(f"integration, s               {Integration.spent:.1f}")
    print(f"all over that                {total / Integration.spent:.3f}")
    print(f"memory, MB                   {_memory():.0f}")


def _run(scene: Scene) -> None:
    """Simulate, read all quantities, and save them."""
    loaded, begin = _memory(), time.process_time()
    result = simulate(scene)
    ran, run, integration = time.process_time(), _memory(), Integration.spent
    with tempfile.TemporaryDirectory() as place:
        file = Path(place) / "run.nc"
        result.save(file)  # with its quantities
        saved = time.process_time()
        size = file.stat().st_size
    print(f"{scene.mechanism}, {scene.revolutions:g} revolutions: {result.info['status']}")
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
