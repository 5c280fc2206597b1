"""A long run: thinned, without a lost peak."""

import numpy as np
import pytest

from exu_press.page.thinning import Thinning

pytest.importorskip("bokeh")


def test_thinning_keeps_extremes_and_vectors():
    rng = np.random.default_rng(0)
    thinned = Thinning(1003, 10)
    values, vectors = rng.normal(size=1003), rng.normal(size=(1003, 2))
    found = thinned.extremes(values)
    assert len(found) == len(thinned.steps) == 202
    for block in range(101):
        part = values[10 * block : 10 * block + 10]
        assert set(found[2 * block : 2 * block + 2]) == {part.min(), part.max()}
    size = np.linalg.norm(vectors, axis=1)
    assert np.linalg.norm(thinned.vectors(vectors), axis=1).max() == size.max()
    assert (np.diff(thinned.steps) >= 0).all() and thinned.steps[-1] == 1002
