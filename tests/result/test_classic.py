"""Headers that ask for what is not there; SciPy writes the files."""

import struct

import numpy as np
import pytest
from scipy.io import netcdf_file

from exu_press import InputError
from exu_press.result.classic import checksum, open_classic


@pytest.fixture(params=[1, 2])
def path(request, tmp_path):
    with netcdf_file(tmp_path / "file.nc", "w", version=request.param) as file:
        file.words = "some"
        file.number = 3.0
        file.createDimension("long", 50)
        file.createDimension("wide", 2)
        for name, kind in (("one", "d"), ("two", "f"), ("three", "i")):
            variable = file.createVariable(name, kind, ("long", "wide"))
            variable[:] = np.arange(100).reshape(50, 2)
            variable.units = "m"
            variable.checksum = f"{checksum(variable.data):08x}"
    return tmp_path / "file.nc"


def test_it_reads_what_scipy_writes(path):
    file = open_classic(path)
    assert file.attributes == {"words": b"some", "number": b""}
    for name, dtype in (("one", np.float64), ("two", np.float32), ("three", np.int32)):
        variable = file.variables[name]
        assert variable.dimensions == {"long": 50, "wide": 2}
        assert variable.attributes["units"] == b"m"
        values = variable.values(dtype)
        assert values.dtype == dtype and values.dtype.isnative
        assert np.array_equal(values, np.arange(100).reshape(50, 2))
    with pytest.raises(InputError, match="type int32; allowed is float64"):
        file.variables["three"].values(np.float64)


@pytest.mark.parametrize("kept", [0, 3, 4, 40, 150, -1])
def test_a_file_that_ends_too_early(path, kept):
    path.write_bytes(path.read_bytes()[:kept])
    with pytest.raises(InputError):
        open_classic(path)


@pytest.mark.parametrize("number", [-1, 0, 2, 2**31 - 1])
def test_no_number_of_the_header_asks_for_more_than_the_file_has(path, number):
    """Every four bytes of it in turn; a variable that begins elsewhere is a variable."""
    content = path.read_bytes()
    for place in range(0, len(content) - 1600, 4):
        path.write_bytes(content[:place] + struct.pack(">i", number) + content[place + 4 :])
        try:
            file = open_classic(path)
        except InputError as error:
            assert str(error).isprintable()
        else:
            assert sum(each.stored.nbytes for each in file.variables.values()) <= len(content)


def test_variables_that_share_their_bytes(path):
    """They would let a small file ask for any amount of memory."""
    content = path.read_bytes()
    count = content.index(struct.pack(">ii", 11, 3)) + 4
    first, second, _ = sorted(content.index(name) - 4 for name in (b"one", b"two", b"three"))
    once = content[first:second]
    path.write_bytes(content[:count] + struct.pack(">i", 9) + 9 * once + 100 * bytes(8))
    with pytest.raises(InputError, match="does not lie within the file"):
        open_classic(path)


def test_what_is_no_file(tmp_path):
    with pytest.raises(OSError, match="not a file"):
        open_classic(tmp_path)
