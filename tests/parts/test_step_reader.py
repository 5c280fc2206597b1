"""Attacks: damaged STEP files are refused in one line, and never opened in this process."""

import json
import re
import shutil
import subprocess
import sys
from importlib.util import find_spec
from pathlib import Path

import pytest

import exu_press
from fe_models import CRANK_STEEL, Axis, Interface, Part, Reduction, reduced_part
from fe_models.errors import InputError
from fe_models.geometry import StepFile
from fe_models.step_text import faulty_entity

if find_spec("ngsolve") is None:
    pytest.skip("needs NGSolve", allow_module_level=True)

ROD = Path(exu_press.__file__).parent / "scenes" / "six_bar_rod.step"
MILLI = 1e-3
LONG = pytest.mark.long

CRASH = "#594 = AXIS2_PLACEMENT_3D(", "#594 = DEFINITIONAL_REPRESENTATION2_PLACEMENT_3D("
"""Of a placement: the mesher ends its process by it."""


def rod(path, **limits):
    """Return the part of a rod with its two bores."""
    axes = {"big": Axis((0.015, 0.232), hole=True), "small": Axis((0.043, -0.595), hole=True)}
    step = StepFile(path, MILLI, axes=axes, **limits)
    return Part("rod", step, CRANK_STEEL, (Interface("big"), Interface("small")), 0.05)


def test_a_file_is_read_however_its_name_ends(tmp_path):
    mass = StepFile(ROD).build().mass
    for name in ("ROD.STEP", "rod.stp", "Rod.Stp"):
        shutil.copy(ROD, tmp_path / name)
        assert StepFile(tmp_path / name).build().mass == pytest.approx(mass, rel=1e-12)


@pytest.mark.parametrize(
    ("damage", "named"),
    [
        (lambda text: text[: len(text) // 2], "netgen cannot read it|may be damaged"),
        pytest.param(lambda text: text.replace("DATA;", "DATA"), "rod", marks=LONG),
        (lambda text: text.replace(*CRASH), r"may be damaged \(killed by SIG.*: #594 = DEFINITION"),
        (lambda _: "", "is not one"),
        (lambda _: "ISO-10303-21;\n", "cannot (be )?read|holds 0 solids"),
    ],
    ids=["half", "no section", "crash", "empty", "head"],
)
def test_a_damaged_one_is_refused(damage, named, tmp_path):
    path = tmp_path / "rod.step"
    path.write_text(damage(ROD.read_text()))
    with pytest.raises(InputError, match=named) as told:
        reduced_part(rod(path), Reduction(2), folder=tmp_path / "cache")
    assert f"STEP file {path}" in str(told.value) and "\n" not in str(told.value)


def test_limits_of_time_and_memory(tmp_path):
    with pytest.raises(InputError, match=r"rod.step: takes more than 0\.01 s; allowed is"):
        reduced_part(rod(ROD, time_limit=0.01), Reduction(2), folder=tmp_path)
    with pytest.raises(InputError, match=r"rod.step: (needs more than 0\.2 GB|.*damaged)"):
        reduced_part(rod(ROD, memory_limit=0.2e9, time_limit=20.0), Reduction(2), folder=tmp_path)


READS = """
import sys, json
from pathlib import Path
sys.path.insert(0, {here!r})
from test_step_reader import ROD, rod
from fe_models import Reduction, reduced_part
made = reduced_part(rod(ROD), Reduction(2), folder={folder!r})
again = reduced_part(rod(ROD), Reduction(2), folder={folder!r})
same = (made.modes == again.modes).all()
print(json.dumps([made.mass, bool(same), "netgen" in sys.modules, "ngsolve" in sys.modules]))
"""


@pytest.mark.parametrize("cache", ["folder", pytest.param("read-only", marks=LONG)])
def test_this_process_loads_no_kernel_of_solids(cache, tmp_path):
    """Nor does it need a cache that can be written; a warning says that it has none."""
    folder = tmp_path / "cache"
    if cache == "read-only":
        folder.write_text("a file where the folder would be")
    code = READS.format(here=str(Path(__file__).parent), folder=str(folder))
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    assert ("npz: cannot be written (" in done.stderr) == (cache == "read-only")
    mass, same, netgen, ngsolve = json.loads(done.stdout.splitlines()[-1])
    assert same and not netgen and not ngsolve
    assert mass == pytest.approx(7850.0 * 1e-9 * StepFile(ROD).build().mass, rel=1e-6)


@pytest.mark.parametrize(
    ("damage", "named"),
    [
        (lambda text: text, ""),
        (lambda text: text.replace(*CRASH), "#594 = DEFINITIONAL.* that no reader knows"),
        (lambda text: text.replace("#595 = ", "#99595 = "), "refers to #595, which is not there"),
        (lambda text: text.replace("#595 = ", "#596 = "), "#596 = .* is there twice"),
        (lambda text: text.replace("(15.,232.,30.)", "(1.#QNAN,2.,3.)"), "a number that is none"),
        (lambda text: text.replace("(15.,232.,30.))", "(15.,232.,30."), "#595 = .* is cut off"),
    ],
    ids=["sound", "type", "reference", "twice", "nan", "cut"],
)
def test_the_entity_at_fault_is_named(damage, named, tmp_path):
    path = tmp_path / "rod.step"
    path.write_text(damage(ROD.read_text()))
    if not named:
        assert faulty_entity(path) == ""
    else:
        assert re.search(named, faulty_entity(path)), faulty_entity(path)


def test_no_text_keeps_the_search_for_an_entity_busy(tmp_path):
    """Texts without an end, and statements without one, are looked at once."""
    path = tmp_path / "rod.step"
    for text in ("'" * 200_001, "#1=" * 100_000, "/*" * 100_000, "#1=A(" * 100_000, "(" * 300_000):
        path.write_text(f"ISO-10303-21;{text}")
        faulty_entity(path)
