"""Curves, marks and blocks against the run and its quantities."""

import numpy as np
import pytest

from exu_press.page.curves import PEAKS, curves_of
from exu_press.page.marks import impacts, peaks, values_on
from exu_press.page.thinning import Thinning
from exu_press.quantities.catalogue import find_quantity


def test_peaks_are_on_their_curves(press):
    """Those that quantities read between the steps are beyond the steps by little.

    Curves are of the steps' samples, peaks without what alternates from step to step.
    """
    curves = {curve.name: curve for curve in curves_of(press)}
    assert {each.channel for each in curves.values()} == set(press) - {"time", "crank_angle"}
    assert all(find_quantity(each.full_name("crank_pin")) is not None for each in PEAKS.values())
    found = peaks(press, curves.values())
    assert {"slider_acceleration", "crank_pin_force", "crank_pin:gap", "drive_torque"} <= set(found)
    for name, peak in found.items():
        values = values_on(press, curves[name], as_read=True)
        value = np.interp(peak["at"], press.time, values)
        assert value == pytest.approx(peak["value"], rel=1e-3, abs=1e-12), name


def test_impacts_are_those_that_are_counted(press):
    found, more = impacts(press)
    assert more == 0
    for name in ("ball_left", "ball_right"):
        count = press.quantity(f"joints.{name}.impacts").value
        mine = [one for one in found if one["joint"] == name]
        assert len(mine) == count
        largest = max(one["force"] for one in mine)
        assert largest == pytest.approx(press.quantity(f"joints.{name}.peak_force").value)
    assert all(one["from"] <= one["peak"] <= one["to"] for one in found)


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
