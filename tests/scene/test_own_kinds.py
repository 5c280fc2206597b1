"""Laws, a joint and a load that come from outside the package: named, refused, run and stored."""

from pathlib import Path

import pytest
from user_kinds import NAMES, forget

from exu_press import InputError, Result, Scene, simulate
from exu_press.cli import main
from exu_press.scene.assumptions import keys_of
from exu_press.scene.provenance import provenance_of
from exu_press.schema.kinds import custom_modules, import_kinds
from exu_press.schema.toml import toml_text

DRY = {"kind": "dry", "clearance": 5e-5, "radius": 0.03}
BUSHING = {"kind": "own_kinds:Bushing", "clearance": 1e-4, "stiffness": 2e8, "damping": 5e3}
CUSHION = {"kind": "own_kinds:Cushion", "stiffness": 1e6}


def data(name):
    """Return a scene with one of each kind; `name` gives what the scene calls it."""
    return {
        "mechanism": "eccentric_press",
        "revolutions": 0.02,
        "joints": {
            "crank_pin": {
                **DRY, "kind": "lubricated", "film": {"law": name("thin"), "factor": 2.0},
            },
            "shaft": {"kind": name("bushing"), "clearance": 1e-4, "stiffness": 2e8},
            "balls": DRY,
        },
        "contact": {"damping": name("viscous"), "constant": 2e4},
        "friction": {"law": name("graded"), "grade": 3.0},
        "film": {"viscosity": 0.1, "length": 0.02},
        "guide": {"friction": name("graded")},
        "load": {"cushion": {"kind": name("cushion"), "stiffness": 1e6}},
    }  # fmt: skip


def saved(name, path="scene.toml"):
    """Write a scene file that names the kinds."""
    lines = [f"{key} = {toml_text(value)}" for key, value in data(name).items()]
    Path(path).write_text("\n".join(lines))


def own(kind):
    return f"own_kinds:{NAMES[kind]}"


@pytest.mark.parametrize(
    ("key", "value"),
    [
        ("contact.damping", "viscous"),
        ("friction.law", "graded"),
        ("guide.friction", "graded"),
        ("film.law", "thin"),
        ("joints.crank_pin.film.law", "thin"),
        ("joints.balls.contact.damping", "viscous"),
        ("load.cushion.kind", "cushion"),
        ("joints.shaft", "bushing"),
    ],
)
def test_a_file_never_imports_what_it_names(key, value, mark, capsys):
    assert main(["run", "press", "--set", f"{key}={own(value)}", "--out", "out"]) == 2
    said = capsys.readouterr().err
    assert "'own_kinds:" in said and "names code, the module 'own_kinds'" in said
    assert "--allow-code" in said and said.count("\n") == 1
    assert not mark.exists()


def test_with_permission_they_run_are_stored_and_shown_without_being_imported(
    mark, capsys, monkeypatch
):
    saved(own)
    with pytest.raises(InputError, match="names code, the module 'own_kinds'"):
        Scene.load("scene.toml")
    assert not mark.exists()
    scene = Scene.load("scene.toml", allow_code=True)
    assert mark.read_text().startswith("ran")
    assert scene.contact == {"shape": "cylindrical", "damping": own("viscous"), "constant": 2e4,
                             "exponent": 1.5, "modulus": 1.1538e11, "tension": False}  # fmt: skip
    assert scene.joints["crank_pin"].film.law.factor == 2.0
    assert scene.friction == {"law": own("graded"), "coefficient": 0.05, "grade": 3.0}
    assert Scene.from_dict(scene.to_dict()) == scene
    assert keys_of(scene)["contact.constant"].unit == "N s/m"
    assert custom_modules(scene.to_dict()) == ("own_kinds",)
    scene.save("again.toml", comments=True)
    assert Scene.load("again.toml") == scene
    result = simulate(scene)
    assert result.completed
    result.save("run.nc")
    complete = scene.to_dict()
    forget()
    mark.unlink()
    result = Result.load("run.nc")
    stored = result.scene
    assert stored.has_unresolved_kinds and stored.to_dict() == complete
    assert not stored.joints["shaft"].resolved
    assert stored.joints["shaft"].stiffness == 2e8
    assert keys_of(stored)["joints.shaft.kind"].default == "ideal"
    assert stored.joints["ball_left"].contact.damping.constant == 2e4
    assert result.quantity("joints.shaft.peak_force").value > 0.0
    shorter = stored.replace({"revolutions": 0.01, "joints.shaft.stiffness": 3e8})
    assert "shaft" in stored.replace({"joints.shaft": "ideal"}).joints.ideal
    assert shorter.joints["shaft"].stiffness == 3e8
    assert shorter.to_dict()["contact"] == complete["contact"]
    shorter.save("shorter.toml")
    more = ["--no-pictures", "--no-error", "--out", "both"]
    Scene(mechanism="eccentric_press", revolutions=0.02, joints={}).save("plain.toml")
    assert main(["compare", "run.nc", "plain.toml", *more]) == 0
    assert own("bushing") in capsys.readouterr().out
    monkeypatch.setattr("exu_press.report.pictures.save_pictures", lambda *_: [])
    assert main(["report", "run.nc"]) == 0
    page = Path("report.html").read_text()
    assert own("bushing") in page and own("cushion") in page
    for command in (["spectrum", "run.nc", "--no-pictures"], ["view", "run.nc", "--save", "a.png"]):
        main(command)
    for refused in (lambda: simulate(shorter), lambda: Scene.load("shorter.toml")):
        with pytest.raises(InputError, match="names code, the module 'own_kinds'"):
            refused()
    assert not mark.exists()
    assert simulate(Scene.load("shorter.toml", allow_code=True)).completed
    assert Scene.from_dict(complete) == Scene.from_dict(stored.to_dict())  # loaded now


@pytest.mark.parametrize(
    ("guide", "modules"),
    [
        ({"slider": {"friction": own("graded")}}, {"own_kinds"}),
        ({"clearance": 1e-4}, set()),
    ],
)
def test_the_law_of_a_guide_is_among_the_code_that_a_result_comes_from(guide, modules, mark):
    scene = {"mechanism": "slider_crank", "joints": {}, "guide": guide}
    import_kinds(scene)
    assert provenance_of(Scene.from_dict(scene))["code"].keys() == modules


@pytest.mark.parametrize("name", ["Restitution", "ContactDamping", "PointContact", "HuGuo"])
def test_classes_of_the_package_are_called_by_their_names_alone(name):
    with pytest.raises(InputError, match="names code"):
        Scene(mechanism="slider_crank", contact={"damping": f"exu_press.scene.contact:{name}"})


def test_a_distribution_registers_them(install, mark, tmp_path):
    """One of each, by the entry point `exu_press.kinds`: they need no permission."""
    install(tmp_path / "site-packages" / "mine")
    saved(str)
    scene = Scene.load("scene.toml")
    assert scene.contact["damping"] == "viscous" and scene.contact["constant"] == 2e4
    assert scene.to_dict()["joints"]["shaft"]["kind"] == "bushing"
    result = simulate(scene)
    assert result.completed
    result.save("run.nc")
    forget()
    mark.unlink()
    assert Result.load("run.nc").scene.has_unresolved_kinds and not mark.exists()


@pytest.mark.parametrize(
    ("module", "line"),
    [("fails_late", "return lambda speed: 1 / 0"), ("fails_early", "raise ValueError('no law')")],
)
def test_an_error_of_a_users_law_names_its_line(module, line, tmp_path, monkeypatch, capsys):
    file = tmp_path / f"{module}.py"
    file.write_text(
        "from dataclasses import dataclass\nfrom exu_press.scene import FrictionLaw\n"
        "@dataclass(frozen=True)\nclass Bad(FrictionLaw):\n"
        f"    def friction(self):\n        {line}\n"
    )
    monkeypatch.syspath_prepend(tmp_path)
    words = "run slider_crank --set revolutions=0.02 --no-error --no-pictures --allow-code"
    out = ["--set", f"friction.law={module}:Bad", "--out", str(tmp_path / "out")]
    assert main([*words.split(), *out]) == 2
    (message,) = capsys.readouterr().err.splitlines()
    assert message.startswith(f"exu-press: {file}, line 6: ")


def crank(keys):
    import_kinds({"joints": {"crank_pin": keys}})
    return Scene(mechanism="slider_crank", joints={"crank_pin": keys})


def cushioned(keys):
    import_kinds({"load": {"cushion": keys}})
    return Scene(mechanism="slider_crank", joints={}, load={"cushion": keys}, revolutions=1.0)


@pytest.mark.parametrize(
    ("lines", "told"),
    [
        ("a = 1\nb = (\n", r"broken.py, line 2: SyntaxError: '\(' was never closed; allowed"),
        ("import no_such_package\n", "broken.py, line 1: No module named 'no_such_package'"),
        ("def f():\n    return 1 / 0\nf()\n", "broken.py, line 2: ZeroDivisionError: division"),
    ],
)
def test_a_module_that_does_not_load_is_named_with_its_line(lines, told, tmp_path, monkeypatch):
    monkeypatch.syspath_prepend(tmp_path)
    (tmp_path / "broken.py").write_text(lines)
    with pytest.raises(InputError, match=told):
        crank({**BUSHING, "kind": "broken:Bushing"})


@pytest.mark.parametrize(
    ("scene_of", "keys", "changes", "told"),
    [
        (crank, BUSHING, {"kind": "no_such_module:Bushing"}, "No module named 'no_such_module'"),
        (crank, BUSHING, {"kind": "own_kinds:Ring"}, "has no attribute 'Ring'"),
        (crank, BUSHING, {"kind": "own_kinds:NoKind"}, "derived from CustomJoint"),
        (crank, BUSHING, {"kind": "own_kinds:Unfinished"}, "no interfaces, which CustomJoint asks"),
        (crank, BUSHING, {"kind": "own_kinds:Empty"}, r"Empty.interfaces\(\) returns \[\]: allowe"),
        (crank, BUSHING, {"stifness": 1.0}, "did you mean 'stiffness'"),
        (crank, BUSHING, {"film": {}}, "film"),
        (cushioned, CUSHION, {"stiffness": None}, "needs stiffness"),
        (cushioned, CUSHION, {"kind": "own_kinds:NoCurve"}, "returns 7.0: allowed is a LoadCurve"),
        (cushioned, CUSHION, {"kind": "own_kinds:Sideways"}, "over = 'width': allowed is one of"),
        (cushioned, CUSHION, {"kind": "own_kinds:Bushing"}, "derived from CustomLoad"),
        (cushioned, CUSHION, {"kind": "no_module:Load"}, "No module named 'no_module'"),
    ],
)
def test_what_is_no_such_kind_is_refused(scene_of, keys, changes, told, mark):
    keys = {key: value for key, value in {**keys, **changes}.items() if value is not None}
    with pytest.raises(InputError, match=told):
        scene_of(keys)


def test_a_load_gives_back_what_it_takes(mark):
    """As the table of the same curve does: a spring has no work in a revolution."""
    own = simulate(cushioned(CUSHION))
    table = {"kind": "table", "height": [0.0, 2e-2], "force": [2e4, 0.0], "acts": "both"}
    same = simulate(cushioned(table))
    assert own.quantity("loads.cushion.peak_force").value == pytest.approx(2e4, rel=1e-9)
    assert own["load_cushion_force"] == pytest.approx(same["load_cushion_force"], abs=1e-6)
    assert abs(own.quantity("loads.cushion.work").value) < 1e-3 * 0.5 * 1e6 * 2e-2**2
