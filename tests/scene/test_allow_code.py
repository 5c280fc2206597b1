"""Attacks: a scene, a study or a result that names code; none runs before the user allows it."""

import site
import subprocess
import sys
from pathlib import Path

import pytest

from exu_press import InputError, Result, Scene, simulate
from exu_press.cli import main
from exu_press.scene import CustomLoad
from exu_press.scene.custom import CustomJoint, UnresolvedJoint

KIND = """
from dataclasses import dataclass
from pathlib import Path
from exu_press.joints.interface import FunctionInterface
from exu_press.scene import CustomJoint, key

Path(r"{mark}").open("a").write("ran ")

@dataclass(frozen=True)
class Spring(CustomJoint):
    stiffness: float = key(1e8, "radial", "N/m", above=0)

    def interfaces(self):
        k = self.stiffness

        def law(e, e_dot, v_t, omega_j, omega_b):
            return (-k * e, 0.0, -k, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)

        return [FunctionInterface(law, self.clearance, lambda e: (0.5 * k * e * e, k * e))]
"""

SCENE = """
mechanism = "slider_crank"
revolutions = 0.02
[joints.crank_pin]
kind = "{kind}"
clearance = 1e-4
"""

STUDY = """
scene = "scene.toml"
[keys]
speed_rpm = [100.0, 110.0]
"""


@pytest.fixture
def mark(tmp_path, monkeypatch):
    """Return the file in which the code `hostile:Spring` says that it ran; Python finds it."""
    mark = tmp_path / "mark"
    (tmp_path / "hostile.py").write_text(KIND.format(mark=mark))
    (tmp_path / "scene.toml").write_text(SCENE.format(kind="hostile:Spring"))
    (tmp_path / "study.toml").write_text(STUDY)
    monkeypatch.syspath_prepend(tmp_path)
    monkeypatch.chdir(tmp_path)
    yield mark
    forget("hostile")


def forget(module):
    """Let no class of a module be known any more, as in a new process."""
    sys.modules.pop(module, None)
    for kind in (*CustomJoint.__subclasses__(), *CustomLoad.__subclasses__()):
        if kind.__module__ == module:
            kind.__module__, kind.registered_name = "forgotten", ""


@pytest.mark.parametrize(
    "command",
    [
        ["run", "scene.toml"],
        ["compare", "scene.toml"],
        ["compare", "scene.toml", "press"],
        ["attractor", "scene.toml"],
        ["precision", "scene.toml"],
        ["stability", "scene.toml"],
        ["run", "slider_crank", "--set", "joints.crank_pin=hostile:Spring"],
        *([name, "study.toml"] for name in ("sweep", "bifurcation", "sensitivity", "optimise")),
    ],
    ids=" ".join,
)
def test_no_command_imports_what_a_file_names(command, mark, capsys):
    assert main([*command, "--out", "out"]) == 2
    said = capsys.readouterr().err
    assert not mark.exists()
    if command[0] in ("run", "compare", "attractor", "precision", "stability", "sweep"):
        assert "'hostile:Spring': names code, the module 'hostile'" in said
        assert "--allow-code" in said and said.count("\n") == 1


@pytest.mark.parametrize("more", [[], ["--allow-code"]])
def test_drawing_imports_nothing_and_needs_no_permission(more, mark):
    assert main(["draw", "scene.toml", "--save", "drawing.png", *more]) == 0
    assert not mark.exists()


@pytest.mark.parametrize("command", ["run", "sweep"])
def test_with_permission_it_runs_here_and_in_workers(command, mark, processes):
    file = {"run": "scene.toml", "sweep": "study.toml"}[command]
    more = ["--allow-code", "--quiet", "--no-pictures", "--out", "out"]
    assert main([command, file, *more]) == 0
    assert mark.read_text().startswith("ran")
    if command == "sweep":  # resumed, it needs the permission again
        forget("hostile")
        rows = Path("out/runs.jsonl").read_text()
        assert main([command, file, *more[1:]]) == 2
        assert main([command, file, *more]) == 0
        assert Path("out/runs.jsonl").read_text() == rows


def test_a_result_imports_nothing_and_shows_the_kind(mark, capsys):
    main(["run", "scene.toml", "--allow-code", "--quiet", "--no-pictures", "--out", "out"])
    forget("hostile")
    mark.unlink()
    result = Result.load("out/run.nc")
    joint = result.scene.joints["crank_pin"]
    assert isinstance(joint, UnresolvedJoint) and result.scene.has_unresolved_kinds
    assert (joint.kind, joint.clearance) == ("hostile:Spring", 1e-4)
    assert dict(joint.keys) == {"clearance": 1e-4, "stiffness": 1e8}
    assert result.quantity("joints.crank_pin.peak_force").value > 0.0
    assert result.scene.to_dict()["joints"]["crank_pin"]["kind"] == "hostile:Spring"
    shorter = result.scene.replace({"revolutions": 0.01, "joints.crank_pin.stiffness": 2e8})
    assert shorter.joints["crank_pin"].keys["stiffness"] == 2e8
    shorter.save("again.toml")
    for command in (
        ["report", "out"],
        ["spectrum", "out/run.nc"],
        ["view", "out", "--save", "a.png"],
    ):
        main(command)
    plain = 'mechanism = "slider_crank"\nrevolutions = 0.02\njoints = {}\n'
    Path("plain.toml").write_text(plain)
    more = ["--no-pictures", "--no-error", "--out", "both"]
    assert main(["compare", "out/run.nc", "plain.toml", *more]) == 0
    assert "hostile:Spring" in capsys.readouterr().out
    assert "hostile:Spring" in Path("out/report.html").read_text()
    assert not mark.exists()
    with pytest.raises(InputError, match="names code, the module 'hostile'"):
        simulate(shorter)
    with pytest.raises(InputError, match="names code"):
        Scene.load("again.toml")
    assert not mark.exists()
    assert simulate(Scene.load("again.toml", allow_code=True)).completed


def test_a_load_of_a_result_is_shown_likewise(mark, tmp_path, capsys):
    (tmp_path / "hostile.py").write_text(
        f"open({str(mark)!r}, 'a').write('ran ')\n"
        "from dataclasses import dataclass\n"
        "from exu_press.laws.load_curve import LoadCurve\n"
        "from exu_press.scene import CustomLoad, key\n"
        "@dataclass(frozen=True)\n"
        "class Ramp(CustomLoad):\n"
        "    force: float = key(None, 'at the bottom', 'N', above=0)\n"
        "    def curve(self, angular_speed):\n"
        "        return LoadCurve([0.0, 0.1], [self.force, 0.0])\n"
    )
    Path("scene.toml").write_text(
        'mechanism = "slider_crank"\nrevolutions = 0.6\njoints = {}\n'
        '[load.ramp]\nkind = "hostile:Ramp"\nforce = 1e4\n'
    )
    assert main(["run", "scene.toml", "--quiet", "--out", "out"]) == 2 and not mark.exists()
    more = ["--allow-code", "--quiet", "--no-pictures", "--out", "out"]
    assert main(["run", "scene.toml", *more]) == 0
    forget("hostile")
    mark.unlink()
    result = Result.load("out/run.nc")
    assert result.scene.load["ramp"].kind == "hostile:Ramp" and result.scene.has_unresolved_kinds
    assert result.quantity("loads.ramp.peak_force").value == pytest.approx(1e4, rel=1e-3)
    result.scene.save("again.toml")
    assert "force = 10000.0" in Path("again.toml").read_text()
    assert main(["report", "out"]) == 0 and main(["view", "out", "--save", "a.png"]) in (0, 2)
    assert "hostile:Ramp" in Path("out/report.html").read_text() and not mark.exists()
    with pytest.raises(InputError, match=r"load\.ramp\.kind = 'hostile:Ramp': names code"):
        simulate(result.scene)
    assert simulate(Scene.load("again.toml", allow_code=True)).completed


def test_a_result_whose_scene_is_forged_runs_nothing(mark, monkeypatch):
    """Whatever it names, and in whatever form; no attribute of a module is asked for either."""
    result = simulate(Scene(mechanism="slider_crank", joints={}, revolutions=0.01))
    honest = result.scene.to_dict()
    ours = ("exu_press.scene.custom:UnresolvedJoint", "exu_press.scene:CustomJoint")
    for kind in ("hostile:Spring", "this:x", "os:system", "exu_press:cell", "hostile", *ours):
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


@pytest.mark.parametrize("text", ["raise SystemExit(0)", "import sys; sys.exit('bye')"])
def test_an_import_that_would_end_the_program_is_an_error(text, mark, tmp_path, capsys):
    (tmp_path / "quits.py").write_text(text)
    Path("scene.toml").write_text(SCENE.format(kind="quits:Spring"))
    assert main(["run", "scene.toml", "--allow-code"]) == 2
    assert "quits.py, line 1: SystemExit" in capsys.readouterr().err


def test_a_class_of_ones_own_script_needs_no_permission():
    class Local(CustomJoint):
        def interfaces(self):
            raise InputError("as good as none")

    with pytest.raises(InputError, match="as good as none"):
        Scene(mechanism="slider_crank", joints={"crank_pin": Local(1e-4)})


@pytest.fixture
def installed(tmp_path, monkeypatch, mark):
    """Return what puts a distribution with a kind "spring" into a folder."""

    def install(folder, module="installed_kinds"):
        info = folder / f"{folder.name}-1.0.dist-info"
        info.mkdir(parents=True)
        (info / "METADATA").write_text(
            f"Metadata-Version: 2.1\nName: {folder.name}\nVersion: 1.0\n"
        )
        (info / "entry_points.txt").write_text(f"[exu_press.kinds]\nspring = {module}:Spring\n")
        (folder / f"{module}.py").write_text(KIND.format(mark=mark))
        return folder

    packages = tmp_path / "site-packages"
    packages.mkdir()
    monkeypatch.setattr(site, "getsitepackages", lambda: [str(packages)])
    monkeypatch.setattr(site, "ENABLE_USER_SITE", False)
    Path("scene.toml").write_text(SCENE.format(kind="spring"))
    yield install
    forget("installed_kinds")


def test_a_registered_kind_needs_no_permission(installed, mark, tmp_path, monkeypatch):
    monkeypatch.syspath_prepend(installed(tmp_path / "site-packages" / "mine"))
    (tmp_path / "site-packages" / "mine.pth").write_text("mine\n")
    scene = Scene.load("scene.toml")
    assert scene.joints["crank_pin"].kind == "spring" and mark.exists()
    assert scene.to_dict()["joints"]["crank_pin"]["kind"] == "spring"
    simulate(scene).save("run.nc")
    forget("installed_kinds")
    mark.unlink()
    assert (
        Result.load("run.nc").scene.has_unresolved_kinds and not mark.exists()
    )  # reading imports nothing


def test_what_pythonpath_brings_registers_nothing(installed, mark, tmp_path, monkeypatch):
    monkeypatch.syspath_prepend(installed(tmp_path / "elsewhere"))
    with pytest.raises(InputError, match="kind = 'spring': allowed is one of"):
        Scene.load("scene.toml")
    assert not mark.exists()


def test_the_working_folder_does_not_stand_for_an_installed_module(
    installed, mark, tmp_path, monkeypatch
):
    """Its module of the same name comes first in Python's search, and is not imported."""
    monkeypatch.syspath_prepend(installed(tmp_path / "site-packages" / "mine"))
    (tmp_path / "site-packages" / "mine.pth").write_text("mine\n")
    (tmp_path / "installed_kinds.py").write_text(KIND.format(mark=mark))
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
