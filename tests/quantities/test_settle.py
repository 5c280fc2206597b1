"""Quantities are read from whole revolutions after the start has settled."""

import numpy as np
import pytest

from exu_press import InputError, Scene, simulate
from exu_press.quantities.dead_centre import behind_cut_centre

PIN = {"wrist_pin": {"kind": "dry", "clearance": 1e-4}}


def crank(**keys):
    return Scene(mechanism="slider_crank", joints=PIN, **keys)


def test_one_revolution_where_a_run_has_two_and_none_in_the_paper_s_press():
    assert crank(revolutions=2.0).settle_revolutions == 1.0
    assert crank(revolutions=1.9).settle_revolutions == 0.0
    assert crank(revolutions=1.9, settle=0.5).settle_revolutions == 0.5
    assert Scene(revolutions=5.0).settle_revolutions == 0.0
    with pytest.raises(InputError, match=r"settle = 2: allowed is a number < revolutions = 1"):
        crank(revolutions=1.0, settle=2.0)


@pytest.fixture(scope="module")
def run():
    return simulate(crank(revolutions=2.1, start_angle_deg=30.0, solver={"tolerance": 1e-2}))


def test_peaks_and_energies_are_of_the_second_revolution(run):
    turns = (run["crank_angle"] - run["crank_angle"][0]) / (2.0 * np.pi)
    inside = (turns >= 1.0) & (turns <= 2.0)
    assert run.summary()["read_from"] == pytest.approx({"from": 1.0, "to": 2.0}, abs=1e-6)
    largest = np.abs(run["slider_acceleration"][inside]).max()
    assert run.quantity("peak_acceleration.resolved").value == pytest.approx(largest)
    lost = run["energy_dissipated"]
    expected = np.interp(2.0, turns, lost) - np.interp(1.0, turns, lost)
    assert run.quantity("energy.dissipated").value == pytest.approx(expected, rel=1e-6)
    power = run.quantity("drive.mean_power").value
    assert power == pytest.approx(run.quantity("energy.input").value / 0.25, rel=1e-3)


@pytest.mark.parametrize(
    ("begin", "end", "first"),
    [(180.0, 540.0, 270.0), (177.0, 560.0, 270.0), (185.0, 540.0, 270.0), (100.0, 460.0, 100.0),
     (90.0, 450.0, 90.0), (0.0, 720.0, 0.0), (180.0, 530.0, 180.0)],
)  # fmt: skip
def test_where_whole_dead_centres_begin(begin, end, first):
    angle = np.radians(np.arange(begin, end + 0.5))
    index = behind_cut_centre(angle, np.pi)
    assert np.degrees(angle[index]) == pytest.approx(first, abs=1.0)
