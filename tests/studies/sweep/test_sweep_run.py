"""Sweeps of real scenes: left alone, taken up again, in another's directory."""

import json
import shutil
import subprocess
import sys

import pytest

from exu_press import InputError, Result, Scene, simulate
from exu_press.studies.sweep import Sweep, sweep
from exu_press.studies.sweep.report import RUN_TIMES

LIST = {"way": "list"}
IDEAL = Scene(joints={"crank_pin": "ideal", "balls": "ideal"}, revolutions=0.01)
ONE = Sweep(scene=IDEAL, keys={"speed_rpm": [200.0]})
LUBRICATED = Scene(joints={"crank_pin": "lubricated", "balls": "ideal"}, revolutions=0.05)


@pytest.fixture(scope="module")
def done(tmp_path_factory):
    """The directory of a study that is done."""
    directory = tmp_path_factory.mktemp("done")
    sweep(ONE, directory, workers=1)
    return directory


def without_times(table):
    return {name: values for name, values in table.columns.items() if name not in RUN_TIMES}


def test_the_table_holds_the_summaries(tmp_path):
    study = Sweep(scene=IDEAL, save_runs=True, keys={"speed_rpm": [200.0, 300.0]})
    table = sweep(study, tmp_path, workers=1)
    assert table["file"] == ("runs/1.nc", "runs/2.nc")
    for run, scene in enumerate(study.scenes):
        result = simulate(scene)
        assert table["status"][run] == "completed"
        for name in ("bottom_dead_centre", "energy.input", "peak_acceleration.resolved"):
            assert table[name][run] == result.quantity(name).value
        assert Result.load(tmp_path / table["file"][run]).scene == scene
    assert {path.name for path in tmp_path.iterdir()} >= {"table.csv", "table.nc", "study.json"}


def test_a_study_may_ask_for_errors(tmp_path):
    study = Sweep(scene=LUBRICATED, errors=True, keys={"speed_rpm": [300.0]})
    table = sweep(study, tmp_path, workers=1)
    assert table["errors.peak_acceleration.resolved.error"][0] > 0.0
    assert table["errors.peak_acceleration.resolved.determined"][0] is True


def test_a_file_that_is_gone_or_torn_is_made_again(tmp_path):
    study = Sweep(scene=IDEAL, save_runs=True, keys={"speed_rpm": [200.0, 300.0, 400.0]})
    first = sweep(study, tmp_path, workers=1)
    gone, torn, left = (tmp_path / "runs" / f"{n}.nc" for n in (1, 2, 3))
    made = left.stat().st_mtime_ns
    gone.unlink()
    torn.write_bytes(torn.read_bytes()[:-100])
    second = sweep(study, tmp_path, workers=1)
    assert without_times(first) == without_times(second)
    assert [Result.load(path).scene for path in (gone, torn, left)] == list(study.scenes)
    assert left.stat().st_mtime_ns == made


@pytest.mark.parametrize(
    ("row", "message"),
    [
        ({"status": 5}, "line 1: not a row of a batch"),
        ({"a b": 1.0}, "not rows of a sweep: 'a b': allowed is the name of a column"),
        ({"x": {"\u03c9/": 1.0}}, "not rows of a sweep: 'x.\u03c9/': allowed is the name"),
        ({"energy": {"input": 1.0}, "energy.input": 2.0}, "energy.input: given twice"),
    ],
)
def test_foreign_rows_of_a_resumed_directory_are_refused(done, tmp_path, row, message):
    shutil.copytree(done, tmp_path, dirs_exist_ok=True)
    record = json.loads((tmp_path / "runs.jsonl").read_text())
    record["row"] |= row
    (tmp_path / "runs.jsonl").write_text(json.dumps(record) + "\n")
    with pytest.raises(InputError, match=message) as caught:
        sweep(ONE, tmp_path, workers=1)
    assert "runs.jsonl" in str(caught.value)


def test_a_damaged_study_beside_the_rows_is_another_one(tmp_path):
    (tmp_path / "study.json").write_text("[" * 100_000)
    with pytest.raises(InputError, match="belongs to another study"):
        sweep(ONE, tmp_path)


def test_a_directory_of_another_study_is_refused(done, tmp_path):
    shutil.copytree(done, tmp_path, dirs_exist_ok=True)
    before = {path: path.read_bytes() for path in tmp_path.iterdir() if path.is_file()}
    other = Sweep(scene=IDEAL, keys={"speed_rpm": [300.0]})
    with pytest.raises(InputError, match=r"another study \(study.json differs in keys\)"):
        sweep(other, tmp_path, workers=1)
    assert before == {path: path.read_bytes() for path in tmp_path.iterdir() if path.is_file()}
    longer = Sweep(scene=IDEAL, keys={"speed_rpm": [200.0]}, time_limit=100.0)
    sweep(longer, tmp_path, workers=1)  # the same study


@pytest.mark.parametrize("name", ["runs.jsonl", "table.csv", "table.nc"])
def test_a_directory_with_files_of_something_else_is_refused(name, tmp_path):
    (tmp_path / name).write_text("mine")
    with pytest.raises(InputError, match=rf"{name}.*(delete|belong)"):
        sweep(ONE, tmp_path, workers=1)
    assert (tmp_path / name).read_text() == "mine"


def test_a_lost_study_json_is_written_again_and_its_runs_are_kept(done, tmp_path):
    shutil.copytree(done, tmp_path, dirs_exist_ok=True)
    before = sweep(ONE, tmp_path, workers=1)
    for name in ("study.json", "table.csv", "table.nc"):
        (tmp_path / name).unlink()
    assert sweep(ONE, tmp_path, workers=1).columns == before.columns  # the times too


@pytest.mark.long
@pytest.mark.parametrize("runs", [80, 1000])
def test_real_runs_hold_a_workers_memory_flat(runs):
    """What Exudyn kept of every model would be half a megabyte a run."""
    code = MEMORY.format(scene=IDEAL.to_dict(), runs=runs)
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=600)
    assert done.returncode == 0, done.stderr
    early, late = map(float, done.stdout.split())
    assert late - early < 5.0  # MB


MEMORY = """
from pathlib import Path
from exu_press.studies.base import run_scene
def megabytes():
    return int(Path("/proc/self/statm").read_text().split()[1]) * 4096e-6
for run in range({runs}):
    run_scene({{"scene": {scene!r}}})
    if run == 30:
        early = megabytes()
print(early, megabytes())
"""
