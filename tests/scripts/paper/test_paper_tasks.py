"""What a worker returns: readings with their errors."""

import pytest

from exu_press import Scene, simulate
from paper.readings import readings
from paper.tasks import observe
from paper.value import Value


@pytest.mark.long
def test_errors_of_readings_hold_those_of_a_finer_run():
    scene = Scene(joints={"crank_pin": "dry"}, revolutions=0.05)
    row = observe({"scene": scene.to_dict()})
    assert row["status"] == "completed" and abs(row["residual"]) < 1e-2
    finer = readings(simulate(scene.replace({"solver.tolerance": 1e-6})))
    found = {name: Value(**value) for name, value in row["values"].items()}
    assert found.keys() == finer.keys()
    held = [value.low <= finer[name] <= value.high for name, value in found.items()]
    assert sum(held) >= len(held) - 1
    peak = found["peak_acceleration.mean_1ms"]
    assert 0.0 < peak.error < 0.05 * peak.value


def test_a_run_that_stops_has_no_values(tmp_path):
    scene = Scene(revolutions=0.05, solver={"max_steps": 5})
    row = observe({"scene": scene.to_dict(), "save": str(tmp_path / "run.nc")})
    assert row["status"] != "completed" and row["reason"]
    assert row["values"] == {} and (tmp_path / "run.nc").exists()
