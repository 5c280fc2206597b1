"""How long it takes to begin, as processor times and as ratios to importing Exudyn.

Each is the least of several: commands of fresh processes, pictures of drawing them all again.
"""

import argparse
import resource
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from matplotlib.figure import Figure

from exu_press import Scene, simulate
from exu_press.plots import save_pictures
from exu_press.view import Animation, instants, save_animation
from exu_press.view.animation import SIZE

REPEATS = 5
MAIN = "from exu_press.cli import main\ntry: main([{}])\nexcept SystemExit: pass"
FIRST_STEP = """
from exu_press import Scene, simulate
simulate(Scene(revolutions=1e-6))
"""
COMMANDS = {
    "import exudyn": "import exudyn",
    "exu-press --help": MAIN.format("'--help'"),
    "exu-press --version": MAIN.format("'--version'"),
    "first step of a rigid run": FIRST_STEP,
}


def processor_time(code: str) -> float:
    """Return the least processor time of fresh processes, s."""
    times = []
    for _ in range(REPEATS):
        start = resource.getrusage(resource.RUSAGE_CHILDREN)
        subprocess.run([sys.executable, "-c", code], stdout=subprocess.DEVNULL, check=True)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        times.append(after.ru_utime + after.ru_stime - start.ru_utime - start.ru_stime)
    return min(times)


def drawing_times() -> dict[str, float]:
    """Return the processor times of all pictures of a run and of a frame of its animation, s."""
    result = simulate(Scene(revolutions=1.0))
    pictures, frames = [], []
    with tempfile.TemporaryDirectory() as folder:
        for _ in range(REPEATS):
            start = time.process_time()
            save_pictures(result, folder)
            pictures.append(time.process_time() - start)
        for _ in range(2):
            start = time.process_time()
            animation = Animation(result, instants(result), Figure(figsize=SIZE))
            save_animation(animation, Path(folder) / "run.gif")
            frames.append((time.process_time() - start) / len(animation.instants))
    return {"all pictures of a run": min(pictures), "a frame of a .gif": min(frames)}


def main() -> None:
    argparse.ArgumentParser(description=__doc__).parse_args()
    times = {name: processor_time(code) for name, code in COMMANDS.items()} | drawing_times()
    exudyn = times["import exudyn"]
    for name, seconds in times.items():
        print(f"{name:28} {seconds:7.3f} s  {seconds / exudyn:6.2f} x import exudyn")


if __name__ == "__main__":
    main()
