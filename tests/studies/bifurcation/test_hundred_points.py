"""A diagram of a hundred points: killed and resumed without loss, with both workers busy."""

import math
import os
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest
from slider_cranks import FILM

from exu_press.studies.bifurcation import Bifurcation, bifurcation
from exu_press.studies.bifurcation import run as module

CHILD = """
import sys; sys.path[:] = {path!r}
import test_hundred_points as points
points.diagram({directory!r}, {skip})
"""


def map_point(arguments):
    """A point of a bifurcation diagram, of the logistic map, in place of a press."""
    begun = time.monotonic()
    speed, start = arguments["scene"]["speed_rpm"], arguments["start"]
    rate = 2.8 + 1.2 * (speed - 100.0) / 100.0
    x, points = 0.3 if start is None else start["x"], []
    for _ in range(arguments["revolutions"]):
        x = rate * x * (1.0 - x)
        points.append([x, 0.0])
    time.sleep(arguments["skip"] * (0.01 + 0.01 * abs(math.sin(speed))))
    if log := os.environ.get("LOG_OF_POINTS"):
        with Path(log).open("a") as file:
            file.write(f"{os.getpid()} {begun} {time.monotonic()}\n")
    return {
        "status": "completed",
        "reason": "",
        "points": points,
        "period": 1,
        "decided": True,
        "in_words": "1 revolution",
        "finer": 1.0,
        "error": 1e-9,
        "exponent": [-1.0, None, -0.5],
        "motion": "regular",
        "state": {"x": x},
    }


def diagram(directory, skip):
    """Up and down over fifty speeds, with the points of a map in place of a press's."""
    module.run_point = map_point
    study = Bifurcation(
        scene=FILM,
        keys={"speed_rpm": [float(x) for x in np.linspace(100.0, 200.0, 50)]},
        bifurcation={"skip": skip, "revolutions": 24, "longest": 8},
    )
    return bifurcation(study, directory, workers=2).to_dict()


@pytest.fixture(autouse=True)
def _same_function_afterwards(monkeypatch):
    monkeypatch.setattr(module, "run_point", module.run_point)
    monkeypatch.syspath_prepend(str(Path(__file__).parent))


def lines(directory):
    path = directory / "runs.jsonl"
    return path.read_bytes().count(b"\n") if path.exists() else 0


@pytest.mark.long
def test_killed_twice_it_goes_on_without_loss(tmp_path, monkeypatch):
    monkeypatch.setenv("LOG_OF_POINTS", str(tmp_path / "log"))
    directory = tmp_path / "killed"
    for enough in (20, 60):
        code = CHILD.format(path=sys.path, directory=str(directory), skip=1)
        child = subprocess.Popen([sys.executable, "-c", code])
        end = time.monotonic() + 60.0
        while lines(directory) < enough:
            assert time.monotonic() < end and child.poll() is None
            time.sleep(0.01)
        child.kill()
        child.wait()
    killed = diagram(directory, 1)
    calls = len((tmp_path / "log").read_text().splitlines())
    assert 100 <= calls <= 104, "two runs under way at each of two kills"
    assert killed == diagram(tmp_path / "undisturbed", 1)
    assert [len(branch) for branch in killed["branches"].values()] == [50, 50]


@pytest.mark.long
def test_both_workers_are_busy(tmp_path, monkeypatch, processes):
    """Of the time between a worker's first run and its last, nine tenths are in runs."""
    monkeypatch.setenv("LOG_OF_POINTS", str(tmp_path / "log"))
    diagram(tmp_path / "out", 10)
    runs = np.loadtxt(tmp_path / "log")
    workers = [runs[runs[:, 0] == number] for number in np.unique(runs[:, 0])]
    assert len(workers) == 2
    for worker in workers:
        busy = (worker[:, 2] - worker[:, 1]).sum() / (worker[:, 2].max() - worker[:, 1].min())
        assert busy > 0.9
    ends = [worker[:, 2].max() for worker in workers]
    assert abs(ends[0] - ends[1]) < 0.1 * (max(ends) - runs[:, 1].min())
