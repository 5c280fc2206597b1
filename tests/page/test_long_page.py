"""A long run: thinned, without a lost peak."""

import numpy as np
import pytest
from browser import opened

from exu_press.page.thinning import MOST_VALUES, Thinning
from exu_press.report.html import page

pytest.importorskip("bokeh")

from exu_press.page.viewer import viewer


def repeated(result, times):
    """Return a run that does the same so many times."""
    span, turn = result.time[-1], result["crank_angle"][-1]
    values = {}
    for name in result:
        add = {"time": span, "crank_angle": turn}.get(name, 0.0)
        parts = [result[name][1:] + k * add for k in range(times)]
        values[name] = np.concatenate([result[name][:1], *parts])
    return result.with_values(values)


@pytest.mark.long
def test_a_long_run_is_thinned(press, tmp_path, browser):
    run = repeated(press, 150)
    assert len(run.time) > 200_000
    live = viewer({"": run})
    page_file = tmp_path / "page.html"
    page_file.write_text(page("long", "", [("In motion", live)]), encoding="utf-8")
    with opened(browser, page_file) as shown:
        drawn = np.array(
            shown.evaluate("Array.from(Bokeh.documents[0].get_model_by_name('curve-2-0').data.y)")
        )
        assert len(drawn) < MOST_VALUES / 25 < len(run.time)  # a press has more than 25 curves
        assert drawn.max() == pytest.approx(run["slider_acceleration"].max(), rel=1e-6)
        assert drawn.min() == pytest.approx(run["slider_acceleration"].min(), rel=1e-6)
        assert "no peak is lost" in shown.inner_text("#thinned")


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
