"""Files with something missing, of another type or hostile: refused, with what is wrong where."""

import json

import numpy as np
import pytest
from scipy.io import netcdf_file
from stored_results import rewritten, text_of

from exu_press import InputError, Result, Scene, simulate


@pytest.fixture(scope="module")
def original(tmp_path_factory):
    path = tmp_path_factory.mktemp("run") / "run.nc"
    simulate(Scene(mechanism="slider_crank", joints={"crank_pin": "dry"}, revolutions=0.05)).save(
        path
    )
    return path


@pytest.fixture
def changed(original, tmp_path):
    """Return what writes a copy with other texts and variables."""

    def write(texts=None, variables=None):
        target = tmp_path / "run.nc"
        target.write_bytes(rewritten(original.read_bytes(), texts, variables))
        return target

    return write


INFO = [
    ({"status": None}, "info: has no status"),
    ({"versions": [1]}, r"info.versions = \[1\]: allowed is a table"),
    ({"status": "fine"}, "info.status = 'fine': allowed is one of 'completed', 'under-resolved'"),
    ({"steps": 10**400}, "info.steps = .*: allowed is a whole number"),
    ({"colour": "red"}, "info.colour: unknown key; allowed are status, reason"),
]


@pytest.mark.parametrize(("change", "message"), INFO)
def test_metadata_of_another_kind(original, changed, change, message):
    info = {**text_of(original.read_bytes(), "info"), **change}
    text = json.dumps({name: value for name, value in info.items() if value is not None})
    with pytest.raises(InputError, match=message):
        Result.load(changed({"info": text}))


@pytest.mark.parametrize(
    ("texts", "message"),
    [
        ({"info": "[1]"}, r"info = \[1\]: allowed is a table"),
        ({"info": "[" * 100_000}, "info = .*: allowed is JSON"),
        ({"info": None}, "has no info"),
        ({"info": b"\xff"}, "info = .*: allowed is UTF-8"),
        ({"scene": "5"}, "scene = 5: allowed is a table"),
        ({"scene": '{"speed_rpm": -1}'}, "speed_rpm = -1.0: allowed is a number > 0"),
        ({"scene": "{}"}, "bodies = .*: allowed are the scene's, crank, linkage"),
        ({"bodies": "[]"}, r"bodies = \(\): allowed are the scene's, crank, rod, slider"),
    ],
)
def test_texts_of_the_file(changed, texts, message):
    with pytest.raises(InputError, match=message) as caught:
        Result.load(changed(texts))
    assert len(str(caught.value)) < 700


@pytest.mark.parametrize(
    ("name", "change", "message"),
    [
        ("time", {"name": None}, "channel time: missing"),
        ("crank_pin_force", {"name": None}, "channel crank_pin_force: missing"),
        ("guide_moment", {"name": "x_eccentricity"}, "x_eccentricity: the scene has no such"),
        ("guide_force", {"dimensions": ("time", "plane")}, "columns are 'plane'; allowed is ''"),
        ("slider_tilt", {"units": None}, "channel 'slider_tilt': has no units"),
        ("slider_tilt", {"long_name": b"\xff"}, "channel 'slider_tilt': long_name = .*: allowed"),
        ("slider_tilt", {"values": np.full(1, 1e200)}, "slider_tilt.*: allowed are numbers below"),
        ("slider_tilt", {"values": np.zeros(1, np.float32)}, "type float32; allowed is float64"),
        ("time", {"values": np.zeros(1)}, "channel time: allowed are increasing instants"),
    ],
)
def test_channels(original, changed, name, change, message):
    change = dict(change)
    with netcdf_file(original, mmap=False) as file:
        shape = file.variables[name].shape + (2,) * ("dimensions" in change)
    if "values" in change or "dimensions" in change:
        change["values"] = np.broadcast_to(change.get("values", np.zeros(1)), shape).copy()
    with pytest.raises(InputError, match=message):
        Result.load(changed(None, {name: change}))
