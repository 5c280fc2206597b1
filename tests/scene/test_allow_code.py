"""Attacks: a scene, a study or a result that names code; none runs before the user allows it."""

import subprocess
import sys
from pathlib import Path

import pytest
from user_kinds import forget

from exu_press import InputError, Result, Scene, simulate
from exu_press.cli import main
from exu_press.scene.joint import CustomJoint

SCENE = """
mechanism = "slider_crank"
revolutions = 0.02
[joints.crank_pin]
kind = "{kind}"
clearance = 1e-4
stiffness = 1e8
"""

STUDY = """
scene = "scene.toml"
[keys]
speed_rpm = [100.0, 110.0]
"""


@pytest.fixture
def hostile(mark):
    """Return the file in which the code that scene and study name says that it ran."""
    Path("scene.toml").write_text(SCENE.format(kind="own_kinds:Bushing"))
    Path("study.toml").write_text(STUDY)
    return mark


@pytest.mark.parametrize(
    "command",
    [
        ["run", "scene.toml"],
        ["compare", "scene.toml"],
        ["compare", "scene.toml", "press"],
        ["attractor", "scene.toml"],
        ["precision", "scene.toml"],
        ["stability", "scene.toml"],
        *([name, "study.toml"] for name in ("sweep", "bifurcation", "sensitivity", "optimise")),
    ],
    ids=" ".join,
)
def test_no_command_imports_what_a_file_names(command, hostile, capsys):
    assert main([*command, "--out", "out"]) == 2
    said = capsys.readouterr().err
    assert not hostile.exists()
    if command[0] in ("run", "compare", "attractor", "precision", "stability", "sweep"):
        assert "'own_kinds:Bushing': names code, the module 'own_kinds'" in said
        assert "--allow-code" in said and said.count("\n") == 1


def test_drawing_imports_nothing_and_needs_no_permission(hostile):
    for more in ([], ["--allow-code"]):
        assert main(["draw", "scene.toml", *more]) == 0
        assert not hostile.exists()


@pytest.mark.parametrize("command", ["run", "sweep"])
def test_with_permission_it_runs_here_and_in_workers(command, hostile, processes):
    file = {"run": "scene.toml", "sweep": "study.toml"}[command]
    more = ["--allow-code", "--quiet", "--no-pictures", "--out", "out"]
    assert main([command, file, *more, *["--once"] * (command == "run")]) == 0
    assert hostile.read_text().startswith("ran")
    if command == "sweep":  # resumed, it needs the permission again
        forget()
        rows = Path("out/runs.jsonl").read_text()
        assert main([command, file, *more[1:]]) == 2
        assert main([command, file, *more]) == 0
        assert Path("out/runs.jsonl").read_text() == rows


def test_a_repeated_run_needs_permission_and_the_code_that_it_had(hostile, capsys):
    more = ["--allow-code", "--no-error", "--quiet", "--no-pictures", "--out", "out"]
    assert main(["run", "scene.toml", *more]) == 0
    assert Result.load("out/run.nc").info["provenance"]["code"].keys() == {"own_kinds"}
    assert main(["rerun", "out", "--allow-code", "--quiet"]) == 0
    forget()
    hostile.unlink()
    assert main(["rerun", "out"]) == 2
    assert "names code, the module 'own_kinds'" in capsys.readouterr().err
    assert not hostile.exists()
    assert main(["rerun", "out", "--allow-code", "--quiet"]) == 0
    forget()
    hostile.unlink()
    code = Path("own_kinds.py")
    code.write_text(code.read_text() + "# edited\n")
    assert main(["rerun", "out", "--allow-code"]) == 2
    assert "own_kinds (changed)" in capsys.readouterr().err and not hostile.exists()


def test_a_result_whose_scene_is_forged_runs_nothing(mark, monkeypatch):
    """Whatever it names, and in whatever form; no attribute of a module is asked for either."""
    result = simulate(Scene(mechanism="slider_crank", joints={}, revolutions=0.01))
    honest = result.scene.to_dict()
    ours = ("exu_press.scene.joint:CustomJoint", "exu_press.scene:CustomJoint")
    for kind in ("own_kinds:Bushing", "this:x", "os:system", "exu_press:cell", "own_kinds", *ours):
        for joints in ({"crank_pin": kind}, {"crank_pin": {"kind": kind, "clearance": "x"}}):
            with pytest.raises(InputError):
                result.scene.replace({"joints": joints})
            with monkeypatch.context() as forging:
                forging.setattr(Scene, "to_dict", lambda _, j=joints: {**honest, "joints": j})
                result.save("run.nc")
            with pytest.raises(InputError, match="not a result of exu_press, or damaged"):
                Result.load("run.nc")  # it has no channels of a joint with clearance
            assert main(["report", "run.nc"]) == 2
    assert "this" not in sys.modules and not mark.exists()


@pytest.mark.parametrize(
    "kind",
    [
        *("this:x", "antigravity:x", "os:system", "idlelib.idle:x", "__main__:Spring"),
        *("pytest.__main__:x", "exu_press.__main__:main", "subprocess:Popen"),
    ],
)
def test_no_module_of_pythons_or_of_a_program_is_ever_imported(kind, tmp_path, capsys):
    before = set(sys.modules)
    (tmp_path / "scene.toml").write_text(SCENE.format(kind=kind))
    assert main(["run", str(tmp_path / "scene.toml"), "--allow-code"]) == 2
    assert "allowed is a module of your own" in capsys.readouterr().err
    assert kind.partition(":")[0] in before or kind.partition(":")[0] not in sys.modules


def test_an_import_that_would_end_the_program_is_an_error(mark, tmp_path, capsys):
    (tmp_path / "quits.py").write_text("import sys; sys.exit('bye')")
    Path("scene.toml").write_text(SCENE.format(kind="quits:Spring"))
    assert main(["run", "scene.toml", "--allow-code"]) == 2
    assert "quits.py, line 1: SystemExit" in capsys.readouterr().err


def test_a_class_of_ones_own_script_needs_no_permission():
    class Local(CustomJoint):
        def interfaces(self):
            raise InputError("as good as none")

    with pytest.raises(InputError, match="as good as none"):
        Scene(mechanism="slider_crank", joints={"crank_pin": Local(1e-4)})


def test_what_pythonpath_brings_registers_nothing(install, mark, tmp_path):
    install(tmp_path / "elsewhere")
    Path("scene.toml").write_text(SCENE.format(kind="bushing"))
    with pytest.raises(InputError, match="kind = 'bushing': allowed is one of"):
        Scene.load("scene.toml")
    assert not mark.exists()


def test_the_working_folder_does_not_stand_for_an_installed_module(
    install, mark, tmp_path, monkeypatch
):
    """Its module of the same name comes first in Python's search, and is not imported."""
    install(tmp_path / "site-packages" / "mine")
    Path("scene.toml").write_text(SCENE.format(kind="bushing"))
    Path("own_kinds.py").rename("installed_kinds.py")
    monkeypatch.syspath_prepend(tmp_path)
    with pytest.raises(InputError, match="allowed is the one that is installed"):
        Scene.load("scene.toml")
    assert not mark.exists()


def test_a_module_named_json_where_one_works_runs_in_no_child(tmp_path):
    """Errors of a run are found in children; the command itself is started elsewhere."""
    (tmp_path / "json.py").write_text("open('ran', 'a').write('x')\nraise ImportError\n")
    code = (
        "import sys; sys.path = [entry for entry in sys.path if entry]\n"
        "import json, threading\n"
        "threading.Thread(target=threading.Event().wait, daemon=True).start()\n"  # no copies
        "sys.path.insert(0, '')\n"
        "from exu_press import Scene, simulate\n"
        "scene = Scene(mechanism='slider_crank', revolutions=0.02)\n"
        "print(simulate(scene, errors=True).quantity('peak_velocity').error)"
    )
    done = subprocess.run(
        [sys.executable, "-c", code], cwd=tmp_path, capture_output=True, text=True
    )
    assert done.returncode == 0, done.stderr
    assert float(done.stdout) > 0.0 and not (tmp_path / "ran").exists()
