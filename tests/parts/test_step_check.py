"""Damaged STEP files are refused in one line; the process that reads them may crash or hang."""

import shutil
from pathlib import Path

import pytest

import exu_press
from fe_models.errors import InputError
from fe_models.geometry import StepFile
from fe_models.step_check import check_step

pytest.importorskip("ngsolve")

ROD = Path(exu_press.__file__).parent / "scenes" / "six_bar_rod.step"


def test_a_sound_file_is_read():
    check_step(ROD)


@pytest.mark.parametrize("name", ["ROD.STEP", "rod.stp", "Rod.Stp"])
def test_a_file_is_read_however_its_name_ends(name, tmp_path):
    path = tmp_path / name
    shutil.copy(ROD, path)
    solid, original = StepFile(path).build(), StepFile(ROD).build()
    assert solid.mass == pytest.approx(original.mass, rel=1e-12)


@pytest.mark.parametrize(
    "change",
    [
        lambda text: text[: len(text) // 2],
        lambda text: text.replace("CARTESIAN_POINT", "CARTESIAN_PINT"),
        lambda text: text.replace("DATA;", "DATA"),
    ],
    ids=["half", "misspelt", "no section"],
)
def test_a_damaged_one_is_refused(tmp_path, change):
    path = tmp_path / "rod.step"
    path.write_text(change(ROD.read_text()))
    with pytest.raises(InputError, match=r"rod\.step"):
        StepFile(path).build()


def test_a_reader_that_crashes_or_hangs_ends_nothing(tmp_path, monkeypatch):
    path = tmp_path / "rod.step"
    shutil.copy(ROD, path)
    monkeypatch.setattr("fe_models.step_check.LONGEST", 0.01)
    with pytest.raises(InputError, match=r"takes more than 0\.01 s"):
        check_step(path)
