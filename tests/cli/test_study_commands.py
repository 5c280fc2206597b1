"""Commands of studies: what they print, write and draw, and what they refuse in one line."""

import json
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from exu_press import Scene
from exu_press.cli import main
from exu_press.parallel import cluster
from exu_press.studies.precision import timing

CRANK = """
[scene]
mechanism = "slider_crank"
joints.crank_pin = "ideal"
"""
WRIST = "joints.wrist_pin.peak_force"
STUDIES = {
    "fit": f"""
{CRANK}
revolutions = 0.02
[keys]
slider_crank.slider_mass = {{low = 800.0, high = 2000.0, log = true}}
slider_crank.rod_inertia = {{low = 2.0, high = 3.0}}
[[measured]]
quantity = "{WRIST}"
value = 27000.0
uncertainty = 300.0
[[measured]]
quantity = "joints.shaft.peak_force"
value = 31300.0
uncertainty = 3000.0
[fit]
starts = 1
""",
    "sensitivity": f"""
{CRANK}
revolutions = 0.02
[keys]
slider_crank.crank_radius = {{mean = 0.03, deviation = 1e-5}}
slider_crank.slider_mass = {{low = 1300.0, high = 1400.0}}
[sensitivity]
quantities = ["peak_velocity", "{WRIST}"]
samples = 8
""",
    "optimise": f"""
{CRANK}
revolutions = 0.3
[keys]
slider_crank.rod_length = {{low = 0.2, high = 0.6}}
slider_crank.slider_mass = {{low = 800.0, high = 2000.0, log = true}}
[[objective]]
quantity = "{WRIST}"
[[objective]]
quantity = "energy.stored"
sense = "largest"
[[limit]]
quantity = "peak_acceleration.resolved"
below = 20.0
[optimise]
trials = 16
""",
    "sweep": """
[scene]
joints = {}
revolutions = 0.01
[keys]
speed_rpm = [200.0, 300.0]
""",
    "precision": 'mechanism = "slider_crank"\njoints = {}\nrevolutions = 0.01\n',
    "stability": 'mechanism = "slider_crank"\njoints.crank_pin = "dry"\nrevolutions = 0.01\n',
    "attractor": 'mechanism = "slider_crank"\n',
}
MORE = {
    "precision": ["--quick", "--set", "speed_rpm=300"],
    "stability": ["--key", "contact.modulus"],
}
ONE = STUDIES["optimise"].replace(
    '[[objective]]\nquantity = "energy.stored"\nsense = "largest"\n', ""
)
COMMAND = str(Path(sys.executable).with_name("exu-press"))


@pytest.fixture
def given(tmp_path):
    """Function of a command, the text of its file and further arguments that gives all of them."""

    def arguments(name, text=None, *more):
        (tmp_path / "mine.toml").write_text(text or STUDIES[name])
        serial = name in ("attractor", "precision") or "--dask" in more
        workers = [] if serial else ["--workers", "1"]
        own = MORE.get(name, [])
        return [name, str(tmp_path / "mine.toml"), "--out", str(tmp_path / "out"), *own, *workers,
                *more]  # fmt: skip

    return arguments


@pytest.mark.parametrize(
    ("name", "said", "written", "pictures"),
    [
        (
            "fit",
            ("slider_crank.slider_mass, kg", "not determined: slider_crank.rod_inertia"),
            "fit.json, fitted.toml, fit.png, profiles.png",
            ("fit", "profiles"),
        ),
        (
            "sensitivity",
            ("of the presses built no more than", "slider_crank.slider_mass"),
            "sensitivity.json, samples.csv, sensitivity.png",
            ("sensitivity",),
        ),
        (
            "sweep",
            ("drive.peak_torque, kN m", "2 runs: 2 completed\n"),
            "table.csv, table.nc, sweep.png",
            ("sweep",),
        ),
        ("stability", ("6 cases: ",), "stability.json", ("stability",)),
        ("precision", ("mine: Scene",), "precision.json", ("precision_mine",)),
    ],
)
def test_lines_files_and_pictures(name, said, written, pictures, given, tmp_path, capsys):
    assert main(given(name)) == 0
    printed = capsys.readouterr().out
    assert all(part in printed for part in said)
    assert "nothing is left to judge" not in printed
    assert f"\nwritten: {written}" in printed and printed.rstrip().endswith(f"in {tmp_path}/out")
    for picture in pictures:
        assert (tmp_path / "out" / f"{picture}.png").stat().st_size > 10_000
    if name in WRITTEN:
        WRITTEN[name](tmp_path / "out")


def sample_and_page(out):
    assert (out / "samples.csv").read_text().count("\n") == 1 + 16
    assert main(["report", str(out), "--quiet"]) == 0
    page = (out / "report.html").read_text(encoding="utf-8")
    assert "Shares: peak_velocity" in page and "Presses of the sample" in page


def cases_of_one_key(out):
    report = json.loads((out / "stability.json").read_text())
    assert report["counts"]["wrong"] == 0 and report["counts"]["right"] >= 1
    assert report["cases"][0].keys() >= {
        "name", "axis", "value", "parameters", "verdict", "reason", "checks", "wall_time",
        "residual", "status", "steps",
    }  # fmt: skip
    pushed = [case["parameters"]["contact"]["modulus"] for case in report["cases"]]
    assert len(pushed) == 6 and min(pushed) < 1e9 < 1e13 < max(pushed)


def rows_of_a_machine(out):
    report = json.loads((out / "precision.json").read_text())
    assert report["cases"]["mine"]["duration"] == pytest.approx(0.002)
    columns = {
        "case", "solver", "setting", "error_position", "error_velocity", "error_peak_acceleration",
        "wall_time", "cpu_time", "steps", "rejected_steps", "newton_iterations", "law_evaluations",
        "status",
    }  # fmt: skip
    assert all(row.keys() >= columns for row in report["rows"])
    assert report["machine"]["processor"] and report["machine"]["versions"]["exudyn"]


WRITTEN = {
    "sensitivity": sample_and_page,
    "stability": cases_of_one_key,
    "precision": rows_of_a_machine,
}


@pytest.mark.parametrize(
    ("name", "arguments", "said"),
    [
        ("attractor", ["--set", "revolutions=200"],
         "--set revolutions: attractor has its own; allowed is --"),
        ("attractor", ["--set", "settle=2"],
         "--set settle: attractor has its own; allowed is --skip N"),
        ("attractor", ["--skip", "0"], "--skip 0: allowed is a whole number >= 1"),
        ("attractor", ["--revolutions", "30"],
         "--revolutions 30: allowed are at least 48, for periods up to 16"),
        ("attractor", ["--set", "joints.crank_pin=ideal"], "joints: none has clearance"),
        ("attractor", ["--format", ".bmp"], "--format .bmp: allowed are png"),
        ("stability", ["--key", "nothing"], "--key nothing: allowed are"),
        ("stability", ["--set", 'output.channels=["nothing"]'],
         "output.channels: 'nothing' is no channel of this scene"),
        ("precision", ["--set", 'output.channels=["nothing"]'],
         "output.channels: 'nothing' is no channel of this scene"),
        ("sweep", ["--workers", "0"], "workers = 0"),
        ("sweep", ["--over", "film.length"], "--over film.length: allowed are speed_rpm"),
        ("sweep", ["--dask", "nonsense"], "dask = nonsense"),
        ("sweep", ["--dask", "tcp://127.0.0.1:1"],
         "dask = tcp://127.0.0.1:1: no scheduler answers"),
        ("sweep", ["--show", "nothing"], "--show nothing: allowed are"),
    ],
)  # fmt: skip
def test_wrong_arguments(name, arguments, said, given, tmp_path, capsys, monkeypatch):
    """In one line, before anything runs."""
    if said.endswith("answers"):
        pytest.importorskip("distributed")
    monkeypatch.setattr(cluster, "SECONDS_TO_ANSWER", 0.5)
    monkeypatch.setattr(timing, "build", None)  # the runs of `precision`
    assert main(given(name, None, *arguments)) == 2
    error = capsys.readouterr().err
    assert said in error and error.count("\n") == 1
    assert {file.name for file in tmp_path.glob("out/*")} <= {".lock", "runs.jsonl", "study.json"}


LONG = pytest.mark.long


@pytest.mark.parametrize(
    ("name", "old", "new", "said"),
    [
        ("fit", "[scene]", "[scene]\nsolver.max_steps = 2", "0 gave numbers"),
        ("optimise", "below = 20.0", "", "allowed are one of them, or above < below"),
        ("optimise", "energy.stored", WRIST, "two are of one quantity"),
        ("optimise", "trials = 16", 'method = "nelder_mead"', "with 2 objectives allowed are"),
        ("optimise", "low = 0.2, high = 0.6", "mean = 0.4, deviation = 0.01",
         "file for exu-press optimise"),
        pytest.param("optimise", "below = 20.0", "below = 1.0", "no run keeps the limits",
                     marks=LONG),
        pytest.param("optimise", "energy.stored", "energy.dissipated", "in each of 16 runs",
                     marks=LONG),
    ],
)  # fmt: skip
def test_files_that_are_refused(name, old, new, said, given, capsys):
    assert main(given(name, STUDIES[name].replace(old, new, 1))) == 2
    assert said in capsys.readouterr().err.splitlines()[-1]


@pytest.mark.long
def test_a_number_that_no_values_give_is_told(given, tmp_path, capsys):
    """As many keys as numbers: chi-square has no degree of freedom, and is not small."""
    study = STUDIES["fit"]
    of_rod, of_shaft = study.index("slider_crank.rod_inertia"), study.rindex("[[measured]]")
    text = study[:of_rod] + study[study.index("[[measured]]") : of_shaft]
    reached = text.replace("27000.0", "12000.0") + "[fit]\nstarts = 1\n"
    assert main(given("fit", reached, "--no-pictures")) == 0
    assert "no values of the keys" not in capsys.readouterr().out
    missed = reached.replace("value = 12000.0", "value = 90000.0")
    assert main(given("fit", missed, "--no-pictures", "--out", str(tmp_path / "missed"))) == 0
    said = capsys.readouterr().out
    assert "nothing is left to judge the scene by" in said
    assert "no values of the keys within their ranges give the measured numbers" in said


@pytest.mark.long
def test_several_objectives(given, tmp_path, capsys):
    assert main(given("optimise")) == 0
    printed = capsys.readouterr().out
    assert "method: tpe (advised for 16 trials)" in printed
    assert f"chosen, at a tenth of the tolerance: {WRIST}" in printed
    out = tmp_path / "out"
    told = json.loads((out / "optimise.json").read_text())
    assert len(told["front"]) == len(list((out / "front").glob("*.toml")))
    keys = told["front"][told["chosen"]]["keys"]
    scene = Scene.load(out / "chosen.toml")
    assert scene.slider_crank.rod_length == keys["slider_crank.rod_length"]
    assert (out / "front.png").stat().st_size > 10_000
    assert len((out / "trials.csv").read_text().splitlines()) == 17


def test_one_objective_that_a_solver_of_scipy_finds(given, tmp_path, capsys):
    """The lightest slider loads the wrist pin least; the limit keeps the rod from its shortest."""
    text = ONE.replace("trials = 16", "trials = 40")
    assert main(given("optimise", text, "--no-pictures")) == 0
    said = capsys.readouterr().out
    assert "method: nelder_mead (a run's error is" in said
    assert "chosen: slider_crank.slider_mass lies on the end of its range" in said
    keys = Scene.load(tmp_path / "out" / "chosen.toml").slider_crank
    assert keys.slider_mass == pytest.approx(800.0, rel=0.02)


def test_runs_too_short_for_the_objective_end_the_search(given, capsys):
    short = ONE.replace("trials = 16", "trials = 60").replace(WRIST, "drive.mean_power")
    assert main(given("optimise", short)) == 2
    said = capsys.readouterr().err.splitlines()
    assert not any("warning" in line for line in said)
    assert said[-1].endswith("9 x too short to have drive.mean_power: nothing to choose from")


def test_quiet_prints_nothing_and_the_second_time_runs_nothing(given, tmp_path, capsys):
    arguments, out = given("sweep", None, "--quiet", "--no-pictures"), tmp_path / "out"
    out.mkdir()
    (out / "sweep.png").write_text("of an earlier time")
    assert main(arguments) == 0
    before = (out / "table.csv").read_bytes()
    assert main(arguments) == 0
    assert (out / "table.csv").read_bytes() == before  # the times too
    shown = capsys.readouterr()
    assert shown.out == shown.err == ""
    assert not (out / "sweep.png").exists()


def test_a_study_whose_runs_all_stop_early_fails(given, capsys):
    text = STUDIES["sweep"].replace("joints = {}", "joints = {}\nsolver.max_steps = 2")
    assert main(given("sweep", text, "--no-pictures")) == 3
    assert "no run reached its end" in capsys.readouterr().err


@pytest.mark.long
def test_ctrl_c_keeps_what_is_finished(given, tmp_path):
    speeds = str([100.0 + n for n in range(200)])
    text = STUDIES["sweep"].replace("[200.0, 300.0]", speeds).replace("0.01", "0.1")
    process = subprocess.Popen([COMMAND, *given("sweep", text)], stderr=subprocess.PIPE, text=True)
    runs = tmp_path / "out" / "runs.jsonl"
    end = time.monotonic() + 30.0
    while not runs.exists() or not runs.read_text().count("\n") > 2:
        assert time.monotonic() < end
        time.sleep(0.01)
    process.send_signal(signal.SIGINT)
    _, errors = process.communicate(timeout=20)
    assert process.returncode == 3
    assert errors.splitlines()[-1].startswith("exu-press: interrupted: finished runs are kept in")
    assert "Traceback" not in errors
    assert 2 < runs.read_text().count("\n") < 200
