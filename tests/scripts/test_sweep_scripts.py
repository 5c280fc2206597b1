"""The scripts of sweeps run, reduced, and end in numbers and a picture; times are not tested."""

import pytest
from running import run


@pytest.mark.parametrize(
    ("name", "runs"),
    [
        pytest.param("sweep_clearance", 4, marks=pytest.mark.long),
        pytest.param("sweep_speed", 2, marks=pytest.mark.long),
        pytest.param("sweep_blanking_force", 2, marks=pytest.mark.long),
    ],
)
def test_sweep(name, runs, tmp_path):
    lines = run(f"{name}.py", tmp_path).splitlines()
    assert f"{runs} runs: {runs} completed" in lines
    assert lines[-1] == f"out/{name}/sweep.png"
    assert (tmp_path / lines[-1]).stat().st_size > 10_000


@pytest.mark.long
def test_benchmark(tmp_path):
    lines = run("benchmark_sweep.py", tmp_path).splitlines()
    assert [line[:18].strip() for line in lines[2:]] == [
        "one process",
        "sweep, 1 worker",
        "sweep, 2 workers",
    ]
    assert all(float(word) > 0.0 for line in lines[2:] for word in line[18:].split())
