"""Results open in the tools that people have: xarray and pandas."""

import sys

import numpy as np
import pytest

from exu_press import Scene, simulate
from exu_press.errors import InputError

xarray = pytest.importorskip("xarray")


@pytest.fixture(scope="module")
def result():
    return simulate(Scene(revolutions=0.05))


@pytest.fixture(scope="module")
def data(result, tmp_path_factory):
    path = tmp_path_factory.mktemp("run") / "run.nc"
    result.save(path)
    with xarray.open_dataset(path, engine="scipy") as opened:
        yield opened.load()


def test_every_channel_with_its_values_unit_and_name(result, data):
    for name, channel in result.channels.items():
        assert np.array_equal(data[name].values, channel.values), name
        assert data[name].attrs.pop("checksum")
        assert data[name].attrs == {"units": channel.unit, "long_name": channel.long_name}


def test_time_is_a_coordinate(result, data):
    assert data["slider_position"].dims == ("time",)
    middle = float(result.time[len(result.time) // 2])
    there = data["crank_pin_force"].sel(time=middle, method="nearest")
    assert there.dims == ("plane",)
    assert np.array_equal(there.values, result["crank_pin_force"][len(result.time) // 2])


def test_the_dataset_in_memory_is_that_of_the_file(result, data):
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


def test_without_xarray_it_says_so(result, monkeypatch):
    monkeypatch.setitem(sys.modules, "xarray", None)
    with pytest.raises(InputError, match="needs the package xarray"):
        result.to_xarray()
