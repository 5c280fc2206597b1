"""Latin hypercubes, and how many runs there may be. Grids and lists are in their doctests."""

import numpy as np
import pytest

from exu_press import InputError
from exu_press.studies.base.keys import keys_from
from exu_press.studies.sweep.report import flat
from exu_press.studies.sweep.study import grid, sample


def test_a_latin_hypercube_has_one_point_in_every_slice():
    ranges = {"a": {"low": 0.0, "high": 1.0}, "b": {"low": 10, "high": 1000, "log": True}}
    normal = {"c": {"mean": 5.0, "deviation": 2.0, "low": 0.0}}
    keys = keys_from(ranges | normal)
    points = sample(keys, 20, 3)
    for name, each in keys.items():
        shares = each.share(np.array([point[name] for point in points]))
        assert sorted((20 * shares).astype(int)) == list(range(20))
    assert points == sample(keys, 20, 3)
    assert not np.allclose([p["a"] for p in points], [p["a"] for p in sample(keys, 20, 4)])


def test_nested_tables_are_names_with_dots():
    assert flat({"a": {"b": 1, "c": {"d": 2}}, "a.e": 3}) == {"a.b": 1, "a.c.d": 2, "a.e": 3}
    with pytest.raises(InputError, match=r"a\.b: given twice"):
        flat({"a": {"b": 1}, "a.b": 2})


def test_too_many_runs_are_refused():
    with pytest.raises(InputError, match="runs; allowed are at most"):
        grid(keys_from({str(n): [0] * 10 for n in range(30)}))
    with pytest.raises(InputError, match="runs; allowed are at most"):
        sample(keys_from({"a": {"low": 0, "high": 1}}), 10**9, 1)
