"""Two keys make a map of periods; a study's points as a dataset, a table and a picture."""

import numpy as np
import pytest
from slider_cranks import FILM

from exu_press.studies.bifurcation import Bifurcation, BifurcationReport, Branch
from exu_press.studies.bifurcation.figure import period_map_figure

SHORT = {"skip": 1, "revolutions": 20, "longest": 2}
KEYS = {"joints.crank_pin.clearance": [5e-5, 1e-4, 2e-4], "speed_rpm": [200.0, 240.0]}


def row(period, told=True, value=0.25):
    words = "undecided (why)" if not told else f"{period} revolutions"
    return {
        "status": "completed", "reason": "", "points": np.full((20, 4), value).tolist(),
        "period": period, "decided": told, "in_words": words, "error": 1e-3,
        "exponent": [-1.0, None, -0.5], "motion": "regular", "state": {},
    }  # fmt: skip


@pytest.fixture
def report():
    """A map with one run of each kind: periods 1 and 2, none, not told, and a failed one."""
    study = Bifurcation(scene=FILM, keys=KEYS, bifurcation={**SHORT, "way": "down"})
    values = study.values[::-1]
    lower = [row(1, value=0.1), row(2), {"status": "failed", "reason": "why not"}]
    upper = [row(None), row(None, told=False), row(1)]
    branches = [Branch("down", values, lower, 200.0), Branch("down", values, upper, 240.0)]
    return BifurcationReport(study, branches)


def test_every_point_has_both_keys(report):
    told = report.to_dict()
    assert (told["key"], told["second_key"]) == tuple(KEYS)
    places = [(one["value"], one["second"]) for one in told["branches"]["down"]]
    assert places == [(x, y) for y in (200.0, 240.0) for x in (2e-4, 1e-4, 5e-5)]
    assert "state" not in told["branches"]["down"][0]
    lines = report.lines()
    assert lines[0].split()[:4] == ["joints.crank_pin.clearance,", "m", "speed_rpm", "way"]
    assert len(lines) == 7
    assert "why not" in lines[3]


def test_the_dataset_finds_a_point_by_its_keys(report):
    pytest.importorskip("xarray")
    found = report.to_xarray()
    clearances, speeds = KEYS.values()
    assert found["points"].shape == (1, 3, 2, 20, 4)
    first = found.sel({"way": "down", "joints.crank_pin.clearance": 2e-4, "speed_rpm": 200.0})
    assert float(first["points"][0, 0]) == 0.1
    assert found["period"].sel(way="down").values.tolist() == [
        [pytest.approx(np.nan, nan_ok=True), 1.0],
        [2.0, pytest.approx(np.nan, nan_ok=True)],
        [1.0, 0.0],
    ]
    assert found["joints.crank_pin.clearance"].values.tolist() == clearances
    assert found["speed_rpm"].values.tolist() == speeds
    assert found["joints.crank_pin.clearance"].attrs["units"] == "m"
    assert np.isnan(first["exponent_low"])
    assert float(first["exponent_high"]) == -0.5
    assert found["revolution"].values[[0, -1]].tolist() == [2, 21]


def test_the_map_shows_each_cell(report):
    periods, exponents, _ = period_map_figure(report).axes
    drawn = {text.get_position(): text.get_text() for text in periods.texts}
    assert drawn == {
        (0, 0): "x", (1, 0): "2", (2, 0): "1", (0, 1): "1", (1, 1): "?", (2, 1): "-"
    }  # fmt: skip
    assert [label.get_text() for label in periods.get_xticklabels()] == ["50", "100", "200"]
    legend = [text.get_text() for text in periods.get_legend().get_texts()]
    assert legend == ["1", "2", "-: none up to 2", "?: undecided", "x: failed"]
    assert np.isnan(np.ma.filled(exponents.images[0].get_array(), np.nan)[0, 0])
