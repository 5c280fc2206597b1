"""Runs beside each other in one table, with the keys in which their scenes differ."""

import itertools
from dataclasses import replace

import numpy as np
import pytest

from exu_press import InputError, Scene, simulate
from exu_press.cli.options import scene_path, shipped_names
from exu_press.quantities.value import values_of
from exu_press.studies import compare
from exu_press.studies.compare import different_keys, variants
from exu_press.studies.comparison import Comparison

SHARES = (1e-9, 3e-6, 2e-3, 0.04, 0.7, 5.0)
"""Errors over the figures that have them."""


def with_made_up_errors(result, first):
    """Return a run whose figures have errors of all sizes; every fourth is not determined."""
    entries = {}
    for k, (name, value) in enumerate(values_of(result).items(), start=first):
        if value.value is not None and not name.startswith("cost."):
            error = SHARES[k % len(SHARES)] * abs(value.value)
            low, high = value.value - error, value.value + error
            bounds = {"error": error, "low": low, "high": high}
            entries[name] = {"determined": k % 4 != 0, **bounds}
    return replace(result, info={**result.info, "errors": entries})


@pytest.mark.parametrize(
    "name",
    [n if "press" in n else pytest.param(n, marks=pytest.mark.long) for n in shipped_names()],
)
def test_five_variants_of_every_shipped_scene_fit_100_columns(name):
    """With errors of all sizes; every cell is whole."""
    scene = Scene.load(scene_path(name)).replace({"revolutions": 0.002, "settle": 0.0})
    rigid = {k: s for k, s in variants(scene)[0].items() if not s.bodies}
    runs = [simulate(variant) for variant in rigid.values()]
    labels = ["ideal", "rigid dry", "rigid lubricated", "flexible dry", "flexible lubricated"]
    results = {
        label: with_made_up_errors(run, k)
        for k, (label, run) in enumerate(zip(labels, itertools.cycle(runs), strict=False))
    }
    comparison = Comparison(results)
    lines = comparison.lines()
    assert max(map(len, lines)) <= 100
    rows = [row for group in comparison.cells(wide=False).values() for row in group]
    shown = [line.split() for line in lines]
    for title, *cells in rows:
        assert max(map(len, cells)) <= 11 and [*title.split(), *cells] in shown


@pytest.fixture(scope="module")
def scene():
    return Scene(mechanism="slider_crank", joints={"crank_pin": "dry"}, revolutions=0.02)


@pytest.fixture(scope="module")
def result(scene):
    return simulate(scene)


def test_a_run_beside_its_continuation_says_which_revolutions_are_read(scene):
    turn = scene.replace({"revolutions": 1.0, "joints.crank_pin": "ideal"})
    first = simulate(turn)
    second = simulate(turn, start=first.info["state"])
    comparison = first.compare(second)
    assert comparison.differences == [["read from revolutions", "0 to 1", "1 to 2"]]
    assert comparison.common_window == (comparison.results, "")


def test_windows_without_a_common_part_are_refused(scene, result):
    later = simulate(scene, start=result.info["state"])
    with pytest.raises(InputError, match="no revolutions in common"):
        str(result.compare(later))


def test_runs_are_labelled_by_what_they_are(result):
    comparison = result.compare(result)
    assert list(comparison.results) == ["rigid dry 1", "rigid dry 2"]
    with pytest.raises(InputError, match="labels"):
        result.compare(result, labels=("a",))
    with pytest.raises(InputError, match="compare: 5 is no run; allowed are results, as simulate"):
        result.compare(5)


def test_energies_per_stroke_are_those_of_whole_revolutions(scene):
    lubricated = {"revolutions": 2.0, "settle": 0.0, "joints.crank_pin": "lubricated"}
    run = simulate(scene.replace(lubricated))
    for name in ("energy.input", "energy.dissipated", "joints.crank_pin.dissipated"):
        total = run.quantity(name).value
        assert 2.0 * run.quantity(f"{name}_per_stroke").value == pytest.approx(total, rel=1e-9)


def test_windows_that_are_cut_end_between_steps(scene):
    """At the revolution that all have, not at the step before it."""
    long, short = (
        simulate(scene.replace({"revolutions": turns, "solver": {"step": 7e-4}}))
        for turns in (0.9, 0.5)
    )
    windows, text = long.compare(short, labels=("a", "b")).common_window
    assert "read from revolutions 0 to 0.5" in text
    ends = [run["crank_angle"][-1] / (2.0 * np.pi) for run in windows.values()]
    assert ends == pytest.approx([0.5, 0.5], abs=1e-9)
    velocity = windows["a"].quantity("peak_velocity")
    assert velocity.value == np.abs(windows["a"]["slider_velocity"]).max()


def rows(scenes):
    head, *lines = different_keys(scenes)
    assert head[1:] == list(scenes)
    return {line[0]: line[1:] for line in lines}


def test_a_changed_number_and_a_table_that_one_scene_has():
    base = Scene()
    other = base.replace(
        {
            "speed_rpm": 300.0,
            "joints.crank_pin.clearance": 5e-5,
            "guide": {"lateral_stiffness": 1e9},
        }
    )
    loaded = other.replace({"load.punch": {"kind": "blanking", "force": 1e4}})
    found = rows({"a": base, "b": loaded})
    assert found["speed_rpm"] == ["240", "300"]
    assert found["joints.crank_pin.clearance"] == ["0.0001", "5e-05"]
    assert found["[guide]"] == ["-", "given"] == found["[load.punch]"]
    assert len(found) == 4


def test_a_long_table_ends_with_the_number_of_further_keys(monkeypatch):
    monkeypatch.setattr(compare, "MOST_KEYS", 2)
    changes = dict.fromkeys(("revolutions", "gravity", "start_angle_deg", "speed_rpm"), 1.0)
    _, *lines = different_keys({"a": Scene(), "b": Scene().replace(changes)})
    assert len(lines) == 3 and lines[-1][0] == "2 more keys"


def test_solids_of_other_dimensions_are_left_out():
    """So are those on which a load would press at a point; a counterweight is no part of them."""
    press = Scene()
    assert "flexible dry" in variants(press.replace({"press.counterweight": False}))[0]
    load = {"load.a": {"kind": "blanking", "force": 1e4, "body": "crank"}}
    for change, reason in (({"press.crank_radius": 0.04}, "other dimensions"), (load, "dent")):
        scenes, (left_out,) = variants(press.replace(change))
        assert list(scenes) == ["ideal", "dry", "lubricated"]
        assert left_out.startswith("flexible: left out") and reason in left_out


def test_drawings_of_the_same_name_differ_in_their_keys():
    shipped = Scene(mechanism="six_bar", joints={}, speed_rpm=60.0)
    heavy = shipped.replace({"mechanism.bodies.ram.mass": 1.5e3})
    drawing = heavy.to_dict()["mechanism"]
    spring = {"between": ["ram", "frame"], "at": [[0, 0], [0, 1]], "stiffness": 1e3, "preload": 0.0}
    sprung = heavy.replace({"mechanism": {**drawing, "springs": {"counterbalance": spring}}})
    found = rows({"shipped": shipped, "heavy": heavy, "sprung": sprung})
    assert found["mechanism.bodies.ram.mass"][1:] == ["1500", "1500"]
    assert found["[mechanism.springs.counterbalance]"] == ["-", "-", "given"]
    assert len(found) == 2
