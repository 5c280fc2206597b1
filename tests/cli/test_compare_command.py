"""exu-press compare: scenes and finished runs side by side."""

import itertools
import json
import re
from dataclasses import replace

import pytest

from exu_press import Result, Scene, simulate
from exu_press.cli import compare, main, options
from exu_press.files.output_directory import folder_name
from exu_press.report.comparison import comparison_report

QUICK = ["--set", "revolutions=0.01", "--no-pictures", "--no-error"]


@pytest.fixture
def mine(tmp_path):
    path = tmp_path / "mine.toml"
    path.write_text('mechanism = "slider_crank"\nrevolutions = 0.01\njoints.wrist_pin = "dry"\n')
    return path


def test_scenes_and_a_result(mine, tmp_path, capsys):
    """Another mechanism, a result as it was, and the same name twice."""
    first = tmp_path / "first"
    assert main(["run", "press", *QUICK, "--out", str(first)]) == 0
    capsys.readouterr()
    out, was = tmp_path / "out", (first / "run.nc").read_bytes()
    given = [str(mine), "press", str(first / "run.nc"), str(first)]
    assert main(["compare", *given, *QUICK, "--out", str(out)]) == 0
    captured = capsys.readouterr()
    head, mechanism = (
        next(line for line in captured.out.splitlines() if re.match(start, line))
        for start in (" +mine", "  mechanism ")
    )
    assert re.split("  +", head.strip()) == ["mine", "press", "first", "first 2"]
    number = mechanism.split()[1]
    assert mechanism.split() == ["mechanism", number, *["press"] * 3]
    assert f"{number} slider_crank" in captured.out, "it is too long for its column"
    comparison = json.loads((out / "comparison.json").read_text())
    assert list(comparison) == ["mine", "press", "first", "first 2"]
    assert comparison["mine"]["scene"]["joints"]["wrist_pin"]["kind"] == "dry"
    assert (first / "run.nc").read_bytes() == was
    assert Result.load(out / "mine" / "run.nc").scene == Scene.load(mine)


def test_variants_of_the_joints_that_a_scene_has(mine, tmp_path, capsys):
    tmp_path, table = tmp_path / "new", tmp_path / "new" / "table.csv"
    assert main(["compare", str(mine), *QUICK, "--out", str(tmp_path), "--csv", str(table)]) == 0
    assert "ideal" in table.read_text()
    shown = capsys.readouterr()
    assert "flexible: left out" in shown.err
    assert ["ideal", "dry", "lubricated"] in [line.split() for line in shown.out.splitlines()]
    comparison = json.loads((tmp_path / "comparison.json").read_text())
    kinds = {
        label: {name: joint["kind"] for name, joint in run["scene"]["joints"].items()}
        for label, run in comparison.items()
    }
    loose = {"dry": {"wrist_pin": "dry"}, "lubricated": {"wrist_pin": "lubricated"}}
    assert kinds == {"ideal": {}, **loose}


def test_a_warning_names_its_runs_and_the_file_of_those_that_are_not_printed(
    mine, tmp_path, capsys, monkeypatch
):
    wide = ["--set", "joints.wrist_pin.clearance=2e-3", "--set", "speed_rpm=3e4"]
    command = ["compare", str(mine), str(mine), *wide, *QUICK, "--out", str(tmp_path / "out")]
    assert main(command) == 0
    shown = capsys.readouterr().err
    assert "warning: mine, mine 2: joints.wrist_pin.clearance" in shown
    monkeypatch.setattr(options, "MOST_WARNINGS", 0)
    assert main(command) == 0
    (text,) = re.findall("warning: (.*)", capsys.readouterr().err.replace("\n  ", " "))
    file = tmp_path / "out" / "comparison.json"
    count = len(json.loads(file.read_text())["mine"]["warnings"])
    assert text == f"{count} more like these in {file}"


def speeds(out):
    """Return the speed of each variant in the file of the comparison and in the variant's run."""
    comparison = json.loads((out / "comparison.json").read_text())
    return [
        (
            run["scene"]["speed_rpm"],
            Result.load(out / folder_name(label) / "run.nc").scene.speed_rpm,
        )
        for label, run in comparison.items()
    ]


@pytest.mark.parametrize(
    "names",
    [
        ("a/my press.toml", "b/my press.toml", "a/my press.toml"),
        ("my press.toml", "my_press.toml", "MY PRESS.toml"),
        ("x.toml", "x 2.toml", "b/x.toml"),
        ("...toml", "comparison.json.toml", "measured.json.toml"),
        ("..toml", "_..toml", "a/..toml"),
    ],
)
def test_no_variant_is_dropped_or_overwritten(names, mine, tmp_path, monkeypatch):
    """Each has a name and a folder of its own inside --out, whatever its file is called."""
    monkeypatch.chdir(tmp_path)
    for number, name in enumerate(dict.fromkeys(names)):
        (tmp_path / name).parent.mkdir(exist_ok=True)
        (tmp_path / name).write_text(f"speed_rpm = {100 + number}\n{mine.read_text()}")
    before = sorted(path.name for path in tmp_path.iterdir())
    run = simulate(Scene.load(mine))
    monkeypatch.setattr(
        compare,
        "simulate_equal_windows",
        lambda scenes, **_: ((name, replace(run, scene=s)) for name, s in scenes.items()),
    )
    assert main(["compare", *names, *QUICK, "--quiet", "--out", "inside"]) == 0
    expected = [100.0 + [*dict.fromkeys(names)].index(name) for name in names]
    assert speeds(tmp_path / "inside") == [(speed, speed) for speed in expected]
    assert sorted(path.name for path in tmp_path.iterdir()) == sorted([*before, "inside"])
    assert main(["run", names[0], *QUICK, "--quiet"]) == 0  # without --out it is inside out
    assert sorted(path.name for path in tmp_path.iterdir()) == sorted([*before, "inside", "out"])


def test_a_kill_loses_only_the_run_that_is_under_way(mine, tmp_path, monkeypatch):
    """What was finished is there, and a page shows it."""

    def killed_at_the_third(scenes, **options):
        yield from itertools.islice(simulated(scenes, **options), 2)
        raise KeyboardInterrupt

    simulated = compare.simulate_equal_windows
    monkeypatch.setattr(compare, "simulate_equal_windows", killed_at_the_third)
    monkeypatch.setattr(compare, "_label", lambda name, labels: str(len(labels)))
    monkeypatch.setattr("exu_press.report.comparison.save_comparison", lambda *_: [])
    out = tmp_path / "out"
    assert main(["compare", *3 * [str(mine)], *QUICK, "--quiet", "--out", str(out)]) == 130
    finished = list(json.loads((out / "comparison.json").read_text()))
    assert [Result.load(out / name / "run.nc").completed for name in finished] == [True, True]
    assert "Comparison" in comparison_report(out / "comparison.json")


def test_a_measurement_beside_runs(mine, tmp_path, capsys, monkeypatch):
    """What is measured is a run that is 2 % larger, in other units, over a part of it."""
    first, out = tmp_path / "first", tmp_path / "out"
    assert main(["run", str(mine), *QUICK, "--out", str(first)]) == 0
    run, measured = Result.load(first / "run.nc"), tmp_path / "press_a.csv"
    half, velocity = 1e3 * run.time[:-1:2], 1.02e3 * run["slider_velocity"][:-1:2]
    lines = [f"{time:.17g},{value:.17g}\n" for time, value in zip(half, velocity, strict=True)]
    measured.write_text("time (ms),slider_velocity (mm/s)\n" + "".join(lines))
    capsys.readouterr()
    arguments = [*QUICK[:2], "--no-error", "--out", str(out)]
    assert main(["compare", str(mine), str(first), str(measured), *arguments]) == 0
    told = capsys.readouterr().out
    assert "measured: press_a, m/s" in told
    assert (out / "compare_measured.png").stat().st_size > 10_000
    found = json.loads((out / "measured.json").read_text())["press_a"]
    assert list(found) == ["mine", "first"]
    assert found["first"]["rms_difference"] == pytest.approx(
        0.02 / 1.02 * found["first"]["rms_measured"]
    )
    assert found["first"]["largest_measured"] == pytest.approx(
        1.02 * found["first"]["largest_computed"]
    )
    monkeypatch.setattr("exu_press.report.comparison.save_comparison", lambda *_: [])
    page = comparison_report(out / "comparison.json")
    assert f"{found['first']['rms_difference']:.3g}" in page and "Measured curves" in page
    again = ["compare", str(first), str(measured), "--no-pictures", "--quiet", "--out", str(out)]
    assert main(again) == 0
    assert list(json.loads((out / "measured.json").read_text())["press_a"]) == ["first"]


@pytest.mark.parametrize(
    ("head", "last", "said"),
    [
        ("time (s),slider_speed (m/s)", 1e-5, "'slider_speed': this run has none"),
        ("time (s),slider_velocity (N)", 1e-5, "in N: allowed is m/s"),
        ("time (s),crank_pin_force (N)", 1e-5, "a column of it: crank_pin_force.x, crank_pin_f"),
        ("time (s),crank_pin_force.y (kN)", 1.0, "allowed is a part of the run, from 0 to 0.0025"),
        ("time (s),slider_velocity (m/s)", 1.0, "allowed is a part of the run, from 0 to 0.0025"),
    ],
)
def test_a_measurement_that_fits_no_run_is_refused_before_others(
    head, last, said, mine, tmp_path, capsys
):
    first, measured = tmp_path / "first", tmp_path / "measured.csv"
    assert main(["run", str(mine), *QUICK, "--out", str(first)]) == 0
    places = [0.0, 1e-6, 2e-6, last]
    measured.write_text("\n".join([head, *(f"{place},1.0" for place in places)]))
    given = [str(first), str(mine), str(measured)]
    assert main(["compare", *given, *QUICK, "--out", str(tmp_path / "out")]) == 2
    told = capsys.readouterr().err
    assert told.startswith(f"exu-press: first: {measured}: ") and said in told
    assert not (tmp_path / "out").exists()


def test_a_result_without_the_channels_of_pictures_is_refused_before_runs(mine, tmp_path, capsys):
    kept = tmp_path / "kept"
    assert main(["run", str(mine), *QUICK, "--set", "output.channels=[]", "--out", str(kept)]) == 0
    capsys.readouterr()
    asked = ["compare", str(kept), str(mine), "--no-error", "--out", str(tmp_path / "out")]
    assert main(asked) == 2
    said = capsys.readouterr().err
    assert "channel 'slider_position': was not kept" in said
    assert not (tmp_path / "out").exists()
    assert main([*asked, "--no-pictures"]) == 0, "the table needs none"


def test_wrong_input_is_refused_before_anything_is_run(mine, tmp_path, capsys):
    out = tmp_path / "out"
    result = tmp_path / "one"
    assert main(["run", str(mine), *QUICK, "--quiet", "--out", str(result)]) == 0
    curve = tmp_path / "measured.csv"
    curve.write_text("time (s),slider_velocity (m/s)\n0,0\n1,1\n2,2\n3,3\n")
    ideal = tmp_path / "ideal.toml"
    ideal.write_text('mechanism = "four_bar"\n')
    for arguments, message in (
        ([str(ideal)], "joints: none has clearance, and so the scene has no variants"),
        (["press", "no_such_file.toml"], "no_such_file.toml: cannot be read"),
        (["press", str(tmp_path)], "has none of run.nc; allowed is a directory that has one"),
        (["press", str(tmp_path / "none.nc")], "none.nc: cannot be read"),
        (["press", str(result / "summary.json")], "summary.json: allowed is a scene (.toml), a r"),
        ([str(result)], "a result alone; allowed are two or more, or a scene alone"),
        ([str(curve)], "a measurement alone; allowed are scenes or results beside it"),
        ([str(result)] * 2 + ["--set", "gravity=0"], "--set gravity=0: changes scenes, and none"),
        (["press", "--csv", str(tmp_path / "no" / "a.csv")], "no; make it first"),
        (["press", str(curve), "--csv", str(curve)], "measured.csv: is one of the files to"),
        (["press", "--csv", str(result / "run.nc")], "run.nc: allowed is a name that ends in .csv"),
        (["press", "drag_link_shop"], "press is read from 0 to 2, drag_link_shop is read from 3"),
    ):
        assert main(["compare", *arguments, "--out", str(out)]) == 2
        error = capsys.readouterr().err
        assert message in error and error.count("\n") == 1
        assert not out.exists()


def test_no_run_is_replaced_but_that_of_an_earlier_comparison(mine, tmp_path, capsys):
    """Neither one that is compared nor one that has a label's name by chance."""
    first, other = tmp_path / "a" / "sc", tmp_path / "b" / "sc"
    for out in (first, other):
        assert main(["run", str(mine), *QUICK, "--quiet", "--out", str(out)]) == 0
    command = ["compare", str(first), str(other), *QUICK[2:3], "--quiet", "--out"]
    compared = tmp_path / "both"
    assert main([*command, str(compared)]) == main([*command, str(compared)]) == 0
    assert main(["run", str(mine), *QUICK, "--quiet", "--out", str(compared / "sc_2")]) == 0
    again = [str(compared / "sc"), str(mine)]
    capsys.readouterr()
    for arguments, kept, reason in (
        ([*command, str(tmp_path / "b")], other, "it is one of the runs to compare"),
        ([*command, str(compared)], compared / "sc_2", "no comparison wrote it"),
        (["compare", *again, "--out", str(compared)], compared / "sc", "it is one of the runs"),
    ):
        was = (kept / "run.nc").read_bytes()
        assert main(arguments) == 2
        error = capsys.readouterr().err
        assert f"{kept / 'run.nc'}: would be replaced, and {reason}" in error
        assert error.count("\n") == 1 and (kept / "run.nc").read_bytes() == was
