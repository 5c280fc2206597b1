"""Laws, a joint and a load that come from outside the package: named, refused, run and stored."""

import gc
import site
import sys
from pathlib import Path

import pytest

from exu_press import InputError, Result, Scene, simulate
from exu_press.cli import main
from exu_press.scene.assumptions import keys_of
from exu_press.schema.kinds import CustomKind, custom_modules, subclasses_of
from exu_press.schema.toml import toml_text

KINDS = """
from dataclasses import dataclass
from exu_press.joints.interface import FunctionInterface
from exu_press.laws.contact import NormalContact
from exu_press.laws.film import short
from exu_press.laws.friction import coulomb
from exu_press.laws.load_curve import LoadCurve
from exu_press.scene import ContactDamping, CustomJoint, CustomLoad, FilmLaw, FrictionLaw, key

open({mark!r}, "a").write("ran ")

@dataclass(frozen=True)
class Viscous(ContactDamping):
    constant: float = key(1e4, "of the damper", "N s/m", at_least=0, source="drawn by lot")

    def normal_contact(self, stiffness, *, tension, usual_slowest):
        c = self.constant
        return NormalContact(stiffness, lambda d, rate, *_: (c * rate, 0.0, c), False, tension)

@dataclass(frozen=True)
class Graded(FrictionLaw):
    coefficient: float = key(0.05, "of friction", above=0, at_most=1)
    grade: float = key(2.0, "of the surface", above=0)

    def friction(self):
        return coulomb(self.coefficient * self.grade, 1e-3)

@dataclass(frozen=True)
class Thin(FilmLaw):
    factor: float = key(1.0, "of the force", above=0)

    def film(self, length_to_diameter):
        law, factor = short(length_to_diameter), self.factor
        return lambda *speeds: tuple(factor * value for value in law(*speeds))

@dataclass(frozen=True)
class Bushing(CustomJoint):
    stiffness: float = key(1e8, "radial", "N/m", above=0)

    def interfaces(self):
        k = self.stiffness

        def law(e, e_dot, v_t, omega_j, omega_b):
            return (-k * e, 0.0, -k, *[0.0] * 9)

        return [FunctionInterface(law, self.clearance, lambda e: (0.5 * k * e * e, k * e))]

@dataclass(frozen=True)
class Ramp(CustomLoad):
    top: float = key(None, "largest force", "N", above=0)

    def curve(self, angular_speed):
        return LoadCurve([0.0, 0.1], [self.top, 0.0])
"""
NAMES = {"viscous": "Viscous", "graded": "Graded", "thin": "Thin", "bushing": "Bushing",
         "ramp": "Ramp"}  # fmt: skip
DRY = {"kind": "dry", "clearance": 5e-5, "radius": 0.03}


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
        "load": {"ramp": {"kind": name("ramp"), "top": 1e3}},
    }  # fmt: skip


def forget():
    """Let no class of the modules be known any more, as in a new process."""
    for module in ("own_kinds", "installed_kinds"):
        sys.modules.pop(module, None)
        for kind in subclasses_of(CustomKind):
            if kind.__module__ == module:
                kind.__module__, kind.registered_name = "forgotten", ""
    gc.collect()


@pytest.fixture
def mark(tmp_path, monkeypatch):
    """Return the file in which the module says that it ran; Python finds the module."""
    mark = tmp_path / "mark"
    (tmp_path / "own_kinds.py").write_text(KINDS.format(mark=str(mark)))
    monkeypatch.syspath_prepend(tmp_path)
    monkeypatch.chdir(tmp_path)
    yield mark
    forget()


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
        ("load.ramp.kind", "ramp"),
        ("joints.shaft", "bushing"),
    ],
)
def test_a_file_never_imports_what_it_names(key, value, mark, capsys):
    assert main(["run", "press", "--set", f"{key}={own(value)}", "--out", "out"]) == 2
    said = capsys.readouterr().err
    assert "'own_kinds:" in said and "names code, the module 'own_kinds'" in said
    assert "--allow-code" in said and said.count("\n") == 1
    assert not mark.exists()


def test_with_permission_they_run_and_are_stored(mark, capsys):
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
    stored = Result.load("run.nc").scene
    assert stored.has_unresolved_kinds and stored.to_dict() == complete
    assert stored.joints["ball_left"].contact.damping.constant == 2e4
    assert stored.replace({"revolutions": 0.01}).to_dict()["contact"] == complete["contact"]
    for command in (
        ["report", "run.nc"],
        ["spectrum", "run.nc"],
        ["view", "run.nc", "--save", "a"],
    ):
        main(command)
    capsys.readouterr()
    with pytest.raises(InputError, match="names code"):
        simulate(stored)
    assert not mark.exists()


def test_their_keys_are_checked_and_explained(mark):
    saved(own)
    scene = Scene.load("scene.toml", allow_code=True)
    with pytest.raises(InputError, match=r"contact\.constant = -1\.0: allowed is a number >= 0"):
        scene.replace({"contact.constant": -1.0})
    with pytest.raises(InputError, match=r"contact\.constnt = 1\.0: .*mean 'constant'"):
        scene.replace({"contact.constnt": 1.0})
    with pytest.raises(InputError, match=r"restitution = 0\.5: not used .*belongs to 'hunt_cross"):
        scene.replace({"contact.restitution": 0.5})
    with pytest.raises(InputError, match=r"contact\.damping = 'own_kinds:Graded': allowed is a "):
        scene.replace({"contact.damping": own("graded")})
    assert scene.replace({"contact.damping": "flores"}).contact.keys() >= {"restitution"}


@pytest.mark.parametrize("name", ["Restitution", "ContactDamping", "PointContact", "HuGuo"])
def test_classes_of_the_package_are_called_by_their_names_alone(name):
    with pytest.raises(InputError, match="names code"):
        Scene(mechanism="slider_crank", contact={"damping": f"exu_press.scene.contact:{name}"})


def test_a_distribution_registers_them(mark, tmp_path, monkeypatch):
    """One of each, by the entry point `exu_press.kinds`: they need no permission."""
    packages = tmp_path / "site-packages"
    info = packages / "mine-1.0.dist-info"
    info.mkdir(parents=True)
    (info / "METADATA").write_text("Metadata-Version: 2.1\nName: mine\nVersion: 1.0\n")
    lines = [f"{name} = installed_kinds:{kind}" for name, kind in NAMES.items()]
    (info / "entry_points.txt").write_text("\n".join(["[exu_press.kinds]", *lines, ""]))
    (packages / "installed_kinds.py").write_text(KINDS.format(mark=str(mark)))
    monkeypatch.setattr(site, "getsitepackages", lambda: [str(packages)])
    monkeypatch.setattr(site, "ENABLE_USER_SITE", False)
    monkeypatch.syspath_prepend(packages)
    saved(str)
    scene = Scene.load("scene.toml")
    assert scene.contact["damping"] == "viscous" and scene.contact["constant"] == 2e4
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
