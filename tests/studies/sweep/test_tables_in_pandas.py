"""The tables of sweep, compare and precision open as frames."""

import json

import pytest

from exu_press import Scene, simulate
from exu_press.files.output_directory import write_json
from exu_press.studies.compare import variants
from exu_press.studies.precision import case_of, precision
from exu_press.studies.sweep import Sweep, sweep

pandas = pytest.importorskip("pandas")
xarray = pytest.importorskip("xarray")

SCENE = Scene.from_dict(
    {"mechanism": "slider_crank", "joints": {"crank_pin": "lubricated"}, "revolutions": 0.05}
)


def test_sweep_as_csv_and_as_netcdf(tmp_path):
    speeds = [200.0, 300.0]
    sweep(Sweep(scene=SCENE, keys={"speed_rpm": speeds}), tmp_path, workers=1, quiet=True)
    frame = pandas.read_csv(tmp_path / "table.csv")
    assert frame["speed_rpm"].tolist() == speeds
    assert (frame["status"] == "completed").all()
    with xarray.open_dataset(tmp_path / "table.nc", engine="scipy") as data:
        same = data["peak_velocity"].values
    assert frame["peak_velocity"].tolist() == pytest.approx(same.tolist())
    for speed, peak in zip(speeds, frame["peak_velocity"], strict=True):
        summary = simulate(SCENE.replace({"speed_rpm": speed})).summary()
        assert peak == pytest.approx(summary["quantities"]["peak_velocity"]["value"])


def test_comparison(tmp_path):
    summaries = {label: simulate(scene).summary() for label, scene in variants(SCENE).items()}
    write_json(tmp_path / "comparison.json", summaries)
    read = json.loads((tmp_path / "comparison.json").read_text(encoding="utf-8"))
    assert list(read) == ["ideal", "dry", "lubricated"]
    frame = pandas.DataFrame({label: one["quantities"] for label, one in read.items()})
    name = "peak_acceleration.resolved"
    peaks = {label: s["quantities"][name] for label, s in summaries.items()}
    assert frame.loc[name].to_dict() == peaks


def test_precision():
    report = precision((case_of("mine", SCENE.replace({"joints.crank_pin": "ideal"})),), quick=True)
    frame = pandas.DataFrame(report.to_dict()["rows"])
    fixed = frame[frame["solver"] == "fixed step"].sort_values("value")
    assert len(fixed) > 1
    assert fixed["error_position"].notna().all()
