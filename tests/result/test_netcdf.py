"""A result as a file: complete, readable by others, never half written."""

import errno

import numpy as np
import pytest
from scipy.io import netcdf_file

from exu_press import InputError, Result, Scene, simulate


@pytest.fixture(scope="module")
def result():
    scene = {
        "mechanism": "press",
        "joints": {"crank_pin": "dry", "balls": "dry"},
        "revolutions": 0.02,
        "friction": {"law": "lugre"},
        "solver": {"step": 2e-5},
    }
    return simulate(Scene.from_dict(scene))


@pytest.fixture
def path(tmp_path):
    return tmp_path / "run.nc"


def assert_equal(first, second):
    assert set(first.channels) == set(second.channels)
    for name, channel in first.channels.items():
        other = second.channels[name]
        assert np.array_equal(channel.values, other.values), name
        assert (channel.unit, channel.long_name, channel.axis) == (
            other.unit,
            other.long_name,
            other.axis,
        ), name


def test_round_trip(result, path):
    result.save(path)
    loaded = Result.load(path)
    assert_equal(result, loaded)
    assert loaded.scene == result.scene
    assert loaded.info == result.info
    assert loaded.bodies == result.bodies
    assert loaded.summary() == result.summary()


@pytest.mark.parametrize("moment", ["while writing", "when closing", "when renaming"])
@pytest.mark.parametrize("kind", [OSError, KeyboardInterrupt])
def test_a_write_that_fails_leaves_the_old_file_and_no_half_one(
    result, path, monkeypatch, moment, kind
):
    """A full disk or Ctrl-C: what was there stays, nothing else is left."""
    path.write_bytes(b"what was there")

    def fail(*arguments, **options):
        raise OSError(errno.ENOSPC, "No space left on device") if kind is OSError else kind

    if moment == "while writing":
        monkeypatch.setattr(netcdf_file, "createVariable", fail)
    elif moment == "when closing":
        monkeypatch.setattr(netcdf_file, "flush", fail)
    else:
        monkeypatch.setattr(type(path), "replace", fail)
    expected = InputError if kind is OSError else kind
    with pytest.raises(expected) as caught:
        result.save(path)
    monkeypatch.undo()
    if kind is OSError:
        assert str(caught.value) == f"{path}: cannot be written (No space left on device)"
    assert path.read_bytes() == b"what was there"
    assert [entry.name for entry in path.parent.iterdir()] == ["run.nc"]


def test_files_that_are_not_there_are_refused(result, tmp_path):
    with pytest.raises(InputError, match=r"run\.nc: cannot be written \(No such file"):
        result.save(tmp_path / "nowhere" / "run.nc")
    with pytest.raises(InputError, match=r"run\.nc: cannot be read \(No such file"):
        Result.load(tmp_path / "run.nc")
    with pytest.raises(InputError, match="cannot be read"):
        Result.load(tmp_path)


def test_the_dataset_in_memory_is_that_of_the_file(result, path):
    xarray = pytest.importorskip("xarray")
    result.save(path)
    with xarray.open_dataset(path, engine="scipy") as opened:
        data = opened.load()
    made = result.to_xarray()
    assert set(made.data_vars) == set(data.data_vars)
    for name, variable in made.variables.items():
        if name in data.variables:
            assert variable.dims == data[name].dims
            assert np.array_equal(variable.values, data[name].values), name
            assert data[name].attrs.items() >= variable.attrs.items()
    assert made.attrs["scene"] == data.attrs["scene"]
    assert made["crank_pin_force"].sel(plane="y").values[-1] == result["crank_pin_force"][-1, 1]
    slider = made["body_position"].sel(body="slider", pose="y")
    index = result.bodies.index("slider")
    assert np.array_equal(slider.values, result["body_position"][:, index, 1])
