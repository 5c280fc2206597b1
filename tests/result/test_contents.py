"""Files that are damaged, hostile or lack something: refused, with what is wrong where."""

import json
import random
import struct
import warnings

import numpy as np
import pytest
from scipy.io import netcdf_file
from stored_results import rewritten, text_of

from exu_press import InputError, Result, Scene, simulate
from exu_press.result.netcdf import is_whole


@pytest.fixture(scope="module")
def content(tmp_path_factory):
    path = tmp_path_factory.mktemp("run") / "run.nc"
    scene = Scene(mechanism="slider_crank", joints={"crank_pin": "dry"}, revolutions=0.01)
    simulate(scene).save(path)
    return path.read_bytes()


@pytest.fixture
def path(tmp_path):
    return tmp_path / "run.nc"


@pytest.fixture
def changed(content, path):
    """Return what writes a copy with other texts and variables."""

    def write(texts=None, variables=None):
        path.write_bytes(rewritten(content, texts, variables))
        return path

    return write


INFO = [
    ({"status": None}, "info: has no status"),
    ({"versions": [1]}, r"info.versions = \[1\]: allowed is a table"),
    ({"status": "fine"}, "info.status = 'fine': allowed is one of 'completed', 'under-resolved'"),
    ({"steps": 10**400}, "info.steps = .*: allowed is a whole number"),
    ({"colour": "red"}, "info.colour: unknown key; allowed are status, reason"),
]


@pytest.mark.parametrize(("change", "message"), INFO)
def test_metadata_of_another_kind(content, changed, change, message):
    info = {**text_of(content, "info"), **change}
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
def test_channels(changed, name, change, message):
    change = dict(change)
    with netcdf_file(changed(), mmap=False) as file:
        shape = file.variables[name].shape + (2,) * ("dimensions" in change)
    if "values" in change or "dimensions" in change:
        change["values"] = np.broadcast_to(change.get("values", np.zeros(1)), shape).copy()
    with pytest.raises(InputError, match=message):
        Result.load(changed(None, {name: change}))


def same(first, second):
    return (
        first.scene == second.scene
        and first.info == second.info
        and list(first) == list(second)
        and all(np.array_equal(first[name], second[name]) for name in first)
        and first.units == second.units
    )


def test_every_bit_of_a_sample_matters_or_is_not_read(content, path):
    """No flip of a bit gives another result: 60 within the header, 60 anywhere."""
    path.write_bytes(content)
    original = Result.load(path)
    by, refused = random.Random(69), 0
    for number in range(120):
        damaged = bytearray(content)
        place = by.randrange(12_000 if number % 2 else len(content))
        damaged[place] ^= 1 << by.randrange(8)
        path.write_bytes(damaged)
        try:
            with warnings.catch_warnings():
                warnings.simplefilter("error")
                assert same(Result.load(path), original), place
        except InputError as error:
            refused += 1
            assert str(error).startswith(f"{path}: not a result of exu_press, or damaged: ")
    assert refused > 110  # padding, 5 % of the header, and the number of records are not read


@pytest.mark.parametrize("name", ["time", "crank_pin_force", "slider_position"])
def test_a_changed_number_is_refused_by_its_channel(content, path, name):
    path.write_bytes(content)
    with netcdf_file(path, "a", mmap=False) as file:
        file.variables[name][-1] *= 1.0 + 1e-15
    with pytest.raises(InputError, match=f"channel '{name}': its values are damaged"):
        Result.load(path)
    assert is_whole(path)  # its header is


@pytest.mark.parametrize(
    "change",
    [
        lambda file: setattr(file, "format", b"exu_press result 1"),
        lambda file: setattr(file.variables["time"], "units", b"h"),
        lambda file: file.variables["time"]._attributes.pop("checksum"),
        lambda file: file._attributes.pop("checksum"),
        lambda file: file.variables.update(other=file.variables.pop("slider_tilt")),
    ],
)
def test_a_changed_header_is_refused(content, path, change):
    path.write_bytes(content)
    with netcdf_file(path, "a", mmap=False) as file:
        change(file)
    with pytest.raises(InputError, match=r"header is damaged|has no format"):
        Result.load(path)
    assert not is_whole(path)


@pytest.mark.parametrize("kept", [0, 3, 4, 40, 150, -1])
def test_a_file_that_ends_too_early(content, path, kept):
    path.write_bytes(content[:kept])
    with pytest.raises(InputError, match="not a whole NetCDF file of the classic format"):
        Result.load(path)
    assert not is_whole(path)


def test_variables_that_share_their_bytes(path):
    """They would let a small file ask for any amount of memory."""
    with netcdf_file(path, "w") as file:
        file.createDimension("long", 50)
        file.createVariable("one", "d", ("long",))[:] = np.arange(50.0)
    content = path.read_bytes()
    count = content.index(struct.pack(">ii", 11, 1)) + 4
    first = count + 4
    once = content[first : content.index(np.arange(50.0, dtype=">f8").tobytes())]
    path.write_bytes(content[:count] + struct.pack(">i", 9) + 9 * once + 500 * bytes(8))
    with pytest.raises(InputError, match="damaged"):
        Result.load(path)
