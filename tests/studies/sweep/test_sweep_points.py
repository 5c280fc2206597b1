"""Grids, lists and Latin hypercubes."""

import numpy as np
import pytest

from exu_press import InputError
from exu_press.studies.sweep.points import flat, grid, listed, sample


def test_a_grid_has_every_combination_the_last_key_fastest():
    points = grid({"a": [1, 2], "b": ["x", "y", "z"]})
    assert [tuple(p.values()) for p in points] == [
        (1, "x"), (1, "y"), (1, "z"), (2, "x"), (2, "y"), (2, "z"),
    ]  # fmt: skip


def test_a_list_goes_side_by_side():
    assert listed({"a": [1, 2], "b": ["x", "y"]}) == ({"a": 1, "b": "x"}, {"a": 2, "b": "y"})


def test_a_latin_hypercube_has_one_point_in_every_slice():
    points = sample({"n": 20, "seed": 3, "a": [0.0, 1.0], "b": [10, 30]})
    for name, low, high in (("a", 0.0, 1.0), ("b", 10.0, 30.0)):
        slices = [int(20 * (point[name] - low) / (high - low)) for point in points]
        assert sorted(slices) == list(range(20))
    again = sample({"n": 20, "seed": 3, "a": [0.0, 1.0], "b": [10, 30]})
    assert points == again
    other = sample({"n": 20, "seed": 4, "a": [0.0, 1.0], "b": [10, 30]})
    assert not np.allclose([p["a"] for p in points], [p["a"] for p in other])


def test_nested_tables_are_names_with_dots():
    assert flat({"a": {"b": 1, "c": {"d": 2}}, "a.e": 3}) == {"a.b": 1, "a.c.d": 2, "a.e": 3}
    with pytest.raises(InputError, match=r"a\.b: given twice"):
        flat({"a": {"b": 1}, "a.b": 2})


@pytest.mark.parametrize(
    ("way", "table", "message"),
    [
        (grid, {}, r"\[grid\]: empty"),
        (grid, {"a": []}, r"grid\.a = \[\]: allowed is a list with at least one value"),
        (grid, {"a": 1.0}, r"grid\.a = 1\.0"),
        (grid, {"a": "dry"}, r"grid\.a = 'dry'"),
        (grid, {str(n): [0] * 10 for n in range(30)}, "runs; allowed are at most"),
        (listed, {}, r"\[list\]: empty"),
        (listed, {"a": [1, 2], "b": [1]}, "a has 2, b has 1; allowed are lists of one length"),
        (sample, {"n": 3, "seed": 1}, r"\[sample\]: empty"),
        (sample, {"seed": 1, "a": [0, 1]}, r"sample\.n = None: allowed is a whole number >= 1"),
        (sample, {"n": 0, "seed": 1, "a": [0, 1]}, r"sample\.n = 0"),
        (sample, {"n": True, "seed": 1, "a": [0, 1]}, r"sample\.n = True"),
        (sample, {"n": 10**9, "seed": 1, "a": [0, 1]}, "runs; allowed are at most"),
        (sample, {"n": 3, "a": [0, 1]}, r"sample\.seed = None"),
        (sample, {"n": 3, "seed": -1, "a": [0, 1]}, r"sample\.seed = -1"),
        (sample, {"n": 3, "seed": 1, "a": [1, 1]}, r"sample\.a = \[1, 1\]: allowed is \[low, high"),
        (sample, {"n": 3, "seed": 1, "a": [0, 1, 2]}, r"sample\.a"),
        (sample, {"n": 3, "seed": 1, "a": ["dry", "ideal"]}, r"sample\.a"),
        (sample, {"n": 3, "seed": 1, "a": [0.0, float("nan")]}, r"sample\.a"),
    ],
)
def test_what_is_refused(way, table, message):
    with pytest.raises(InputError, match=message):
        way(table)
