"""Kinds of a user's own: a module that says when it runs, and a distribution that registers it."""

import gc
import site
import sys
from pathlib import Path

import pytest

from exu_press.schema.kinds import CustomKind, subclasses_of

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
    stiffness: float = key(None, "radial", "N/m", above=0)
    damping: float = key(0.0, "radial and transverse", "N s/m", at_least=0)

    def interfaces(self):
        k, d = self.stiffness, self.damping

        def law(e, e_dot, v_t, omega_j, omega_b):
            turning = 0.5 * (omega_j + omega_b)
            of_t = d * turning, 0.0, -d, 0.5 * d * e, 0.5 * d * e
            return -k * e - d * e_dot, -d * (v_t - e * turning), -k, -d, 0.0, 0.0, 0.0, *of_t

        return [FunctionInterface(law, self.clearance, lambda e: (0.5 * k * e * e, k * e))]

@dataclass(frozen=True)
class Cushion(CustomLoad):
    over = "height"
    stiffness: float = key(None, "of the cushion", "N/m", above=0)
    height: float = key(2e-2, "above bottom dead centre, where it is met", "m", above=0)

    def curve(self, angular_speed):
        return LoadCurve([0.0, self.height], [self.stiffness * self.height, 0.0])

class Unfinished(CustomJoint):
    pass

@dataclass(frozen=True)
class Empty(Bushing):
    def interfaces(self):
        return []

class NoKind:
    pass

@dataclass(frozen=True)
class NoCurve(Cushion):
    def curve(self, angular_speed):
        return 7.0

@dataclass(frozen=True)
class Sideways(Cushion):
    over = "width"
"""
NAMES = {"viscous": "Viscous", "graded": "Graded", "thin": "Thin", "bushing": "Bushing",
         "cushion": "Cushion"}  # fmt: skip
"""Name that a distribution registers -> class."""


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
    """Return the file in which the module `own_kinds` says that it ran; Python finds it."""
    mark = tmp_path / "mark"
    (tmp_path / "own_kinds.py").write_text(KINDS.format(mark=str(mark)))
    monkeypatch.syspath_prepend(tmp_path)
    monkeypatch.chdir(tmp_path)
    yield mark
    forget()


@pytest.fixture
def install(tmp_path, monkeypatch, mark):
    """Return what puts a distribution with the kinds into a folder in which Python looks."""

    def install(folder):
        info = folder / f"{folder.name}-1.0.dist-info"
        info.mkdir(parents=True)
        name = f"Metadata-Version: 2.1\nName: {folder.name}\nVersion: 1.0\n"
        (info / "METADATA").write_text(name)
        lines = [f"{name} = installed_kinds:{kind}" for name, kind in NAMES.items()]
        (info / "entry_points.txt").write_text("\n".join(["[exu_press.kinds]", *lines, ""]))
        (folder / "installed_kinds.py").write_text(KINDS.format(mark=str(mark)))
        if folder.parent == packages:
            Path(packages, f"{folder.name}.pth").write_text(f"{folder.name}\n")
        monkeypatch.syspath_prepend(folder)

    packages = tmp_path / "site-packages"
    packages.mkdir()
    monkeypatch.setattr(site, "getsitepackages", lambda: [str(packages)])
    monkeypatch.setattr(site, "ENABLE_USER_SITE", False)
    return install
