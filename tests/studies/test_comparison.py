"""Runs beside each other in one table, with the keys in which their scenes differ."""

import itertools
import tomllib
from dataclasses import make_dataclass, replace
from importlib.resources import files

import numpy as np
import pytest
from coarse_parts import COARSE

from exu_press import InputError, Scene, simulate
from exu_press.cli.options import scene_path, shipped_names
from exu_press.quantities.reading import Reading
from exu_press.quantities.value import values_of
from exu_press.studies import compare, equal_windows
from exu_press.studies.compare import different_keys, variants
from exu_press.studies.comparison import Comparison
from exu_press.studies.equal_windows import require_common_window

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


def with_all_rows(result):
    """Return a run with its steps spread over 2.5 revolutions: it has means, strokes, all rows."""
    turns = np.linspace(0.0, 2.5, len(result.time))
    angle = result.scene.start_angle + 2.0 * np.pi * turns
    return result.with_values({"time": turns * 60.0 / result.scene.speed_rpm, "crank_angle": angle})


ROD = str(scene_path("six_bar_rod").with_suffix(".step"))
ROWS = {"dead centres differ by", "drive power, mean", "per stroke", "mean over 1 ms"}
FLEXIBLE = {
    "press": COARSE,
    "six_bar_rod": {"rod": {"flexible": ROD, "modes": 2, "mesh_size": 0.1}},
}


@pytest.mark.usefixtures("sound_files")
@pytest.mark.parametrize("name", shipped_names())
def test_five_variants_of_every_shipped_scene_fit_100_columns(name):
    """With errors of all sizes; every cell is whole, headings too."""
    scene = Scene.load(scene_path(name)).replace({"revolutions": 0.002, "settle": 0.0})
    if name in FLEXIBLE:
        pytest.importorskip("ngsolve")
        scene = scene.replace({"bodies": FLEXIBLE[name]})
    runs = [with_all_rows(simulate(variant)) for variant in variants(scene)[0].values()]
    labels = ["ideal", "rigid dry", "rigid lubricated", "flexible dry", "flexible lubricated"]
    results = {
        label: with_made_up_errors(run, k)
        for k, (label, run) in enumerate(zip(labels, itertools.cycle(runs), strict=False))
    }
    comparison = Comparison(results)
    lines = comparison.lines()
    assert max(map(len, lines)) <= 100
    cells = comparison.cells(wide=False)
    rows = [row for group in cells.values() for row in group]
    shown = [line.split() for line in lines]
    for title, *values in rows:
        assert max(map(len, values)) <= 11 and [*title.split(), *values] in shown
    expected = ROWS | ({"von Mises stress, max"} if name in FLEXIBLE else set())
    titles = {title.strip() for title, *_ in rows}
    assert all(any(title.startswith(row) for title in titles) for row in expected)
    assert set(cells) <= set(lines)


def test_long_names_are_headings_and_above_stands_only_what_all_share():
    """Kinds of single variants stood there, in nine lines, and headings were numbers of notes."""
    name = "pin_of_the_long_connecting_rod_at_the_crank"
    drawing = files("exu_press.mechanism.files").joinpath("two_point_press.toml").read_text()
    pin = {"kind": "lubricated", "clearance": 5e-5, "radius": 0.05}
    scene = Scene(
        mechanism=tomllib.loads(drawing.replace("crank_pin", name)),
        joints=dict.fromkeys([f"{name}s", "wrist_pins", "shaft", "second_shaft"], pin),
        film={"length": 0.1, "viscosity": 0.1},
        speed_rpm=40.0,
        revolutions=0.002,
    )
    results = {label: simulate(variant) for label, variant in variants(scene)[0].items()}
    comparison = Comparison(results)
    above = " ".join(comparison.lines()).partition("ideal")[0]
    assert "second shaft radial clearance 0.05 mm" in above
    assert "dry" not in above and "lubricated" not in above
    assert f"joint {name.replace('_', ' ')}s (alike to 1 %)" in comparison.lines()
    assert str(results["dry"].compare(results["dry"])).count(" dry, clearance 0.05 mm") == 1


@pytest.fixture(scope="module")
def scene():
    return Scene(mechanism="slider_crank", joints={"crank_pin": "dry"}, revolutions=0.02)


@pytest.fixture(scope="module")
def result(scene):
    return simulate(scene)


@pytest.fixture(scope="module")
def turn(scene):
    return simulate(scene.replace({"revolutions": 1.0, "joints.crank_pin": "ideal"}))


def test_windows_without_a_common_part_are_refused(scene, result, turn):
    """Equally long ones, too, alone and beside a run of both."""
    second = simulate(turn.scene, start=turn.info["state"])
    later = simulate(scene, start=result.info["state"])
    both = simulate(turn.scene.replace({"revolutions": 2.0, "settle": 0.0}))
    for runs in ((result, later), (turn, second), (turn, second, both)):
        with pytest.raises(InputError, match="no revolutions in common"):
            str(runs[0].compare(*runs[1:]))
    with pytest.raises(InputError, match="a is read from 0 to 1, b is read from 1 to 2"):
        require_common_window(
            {"a": turn, "b": turn.scene.replace({"revolutions": 2.0, "settle": 1.0})}
        )


def test_a_crank_that_lags_is_read_from_the_revolutions_that_all_have():
    """The run that is cut loses its errors, the other one keeps them."""
    scene = Scene(
        mechanism="slider_crank",
        joints={},
        revolutions=3.0,
        settle=1.0,
        load={"press": {"kind": "blanking", "force": 2e3}},
        drive={"rated_torque": 100.0, "inertia": 5.0},
    )
    fast, slow = (
        with_made_up_errors(simulate(variant), 1)
        for variant in (scene, scene.replace({"drive.rated_torque": 300.0}))
    )
    (warning,) = slow.summary()["warnings"]
    assert "whole revolutions asked for 2, read 1; try revolutions = 3.01" in warning
    assert not fast.summary()["warnings"]
    windows, text = fast.compare(slow, labels=("fast", "slow")).common_window
    assert "read from revolutions 1 to 2" in text and "Errors of fast are not known" in text
    assert windows["slow"] is slow and "errors" not in windows["fast"].info
    assert [Reading(run).span for run in windows.values()] == [(1.0, 2.0)] * 2


def test_runs_beside_films_that_settle_get_their_further_revolutions(monkeypatch):
    """All variants of a scene are read from the same revolutions, with errors."""
    shop = Scene.load(scene_path("drag_link_shop")).replace({"revolutions": 4.0, "settle": None})
    scenes = variants(shop)[0]
    assert {scene.settle_revolutions for scene in scenes.values()} == {3.0}
    scenes["thin"] = scenes["lubricated"]
    settled_in, stand_in = {"lubricated": 5, "thin": 4}, make_dataclass("Run", ["scene", "info"])

    def settled(scenes, **_):
        for label, scene in scenes.items():
            added = max(settled_in.get(label, 0) - int(scene.settle_revolutions), 0)
            changes = {"settle": 3.0 + added, "revolutions": 4.0 + added} if added else {}
            yield label, stand_in(scene.replace(changes), {"added_revolutions": added})

    monkeypatch.setattr(equal_windows, "simulate_side_by_side", settled)
    with pytest.warns(UserWarning, match="ideal, dry, thin: 2 revolutions more than asked for"):
        runs = dict(equal_windows.simulate_equal_windows(scenes))
    asked = {(run.scene.settle_revolutions, run.scene.revolutions) for run in runs.values()}
    assert runs.keys() == scenes.keys() and asked == {(5.0, 6.0)}


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
